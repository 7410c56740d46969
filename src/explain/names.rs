//! What items are called: their layer, their feature's number and name.

use crate::draw_list::{DrawList, Item, NO_FEATURE, Role};
use crate::scene::{Attribute, Column, Scene};

/// Columns that a feature's name is looked for in, the best first.
const NAMING: [&str; 6] = ["name", "label", "title", "ref", "osm_id", "id"];

/// The layers of a scene and what their features are called.
#[derive(Debug)]
pub(super) struct Names<'a> {
    layers: Vec<&'a str>,
    /// The columns of attributes of each layer; may be empty.
    attributes: &'a [Vec<Column>],
}

impl<'a> Names<'a> {
    /// Those of a scene; `attributes` are the columns of each of its layers, as far as they are known.
    pub(super) fn new(scene: &'a Scene, attributes: &'a [Vec<Column>]) -> Self {
        Self { layers: scene.layers.iter().map(|layer| layer.name.as_str()).collect(), attributes }
    }

    /// An item in words: `roads 12 "A1" (line)`.
    pub(super) fn of_item(&self, list: &DrawList, number: u32) -> String {
        let item = &list.items()[number as usize];
        let role = match list.style_of(number).role {
            Role::Fill if list.style_of(number).swath.is_some() => "stroke",
            Role::Fill => "fill",
            Role::Outside => "outside",
            Role::Outline => "outline",
            Role::Line => "line",
            Role::Point => "point",
        };
        format!("{} ({role})", self.of_feature(item))
    }

    /// A feature in words: `roads 12 "A1"`.
    fn of_feature(&self, item: &Item) -> String {
        let layer = self.layers.get(item.layer as usize).unwrap_or(&"layer");
        if item.number == NO_FEATURE {
            return (*layer).to_owned();
        }
        match self.name_of(item.layer as usize, item.number as usize) {
            Some(name) => format!("{layer} {} {name}", item.number),
            None => format!("{layer} {}", item.number),
        }
    }

    /// The names of the layers.
    pub(super) fn layers(&self) -> &[&'a str] {
        &self.layers
    }

    /// The columns of a layer's attributes.
    pub(super) fn columns(&self, layer: usize) -> &'a [Column] {
        self.attributes.get(layer).map_or(&[], Vec::as_slice)
    }

    /// Whether a layer's source has any feature of these numbers, as far as is known.
    pub(super) fn has_any(&self, layer: usize, numbers: &[usize]) -> bool {
        let rows = self.columns(layer).iter().map(|column| column.values.len()).max().unwrap_or(0);
        numbers.iter().any(|number| *number < rows)
    }

    /// The texts of a layer's naming columns.
    pub(super) fn texts(&self, layer: usize) -> impl Iterator<Item = &'a str> {
        let is_naming = |name: &str| NAMING.iter().any(|known| name.eq_ignore_ascii_case(known));
        let columns = self.columns(layer).iter().filter(move |column| is_naming(&column.name));
        columns.flat_map(|column| &column.values).filter_map(Attribute::text)
    }

    /// What a feature's naming column says.
    fn name_of(&self, layer: usize, number: usize) -> Option<&'a Attribute> {
        let columns = self.columns(layer);
        let of = |name: &&str| columns.iter().find(|column| column.name.eq_ignore_ascii_case(name));
        let mut values = NAMING.iter().filter_map(of).map(|column| column.value(number));
        values.find(|value| !value.is_null() && value.text() != Some(""))
    }
}
