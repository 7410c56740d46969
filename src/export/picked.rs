//! Which items buffers name, and what is told of them.

use crate::buffer::{Plane, PlaneKind, Values, picked};
use crate::draw_list::{NO_FEATURE, Role};
use crate::output::{ByName, ItemResult, PickedItem, PickedRun};
use crate::scene::{Attribute, Column};
use crate::stage::Stage;
use crate::truth::PixelCoverage;
use serde_json::Value;
use std::collections::BTreeSet;

/// No item, in the buffers.
const NO_ITEM: u32 = u32::MAX;

/// The items that the buffers of a picture's runs name, and those at a pixel of it.
pub(super) struct Picked<'a> {
    stage: &'a Stage,
    /// The columns of each layer; a layer may have none.
    attributes: &'a [Vec<Column>],
    pixel: Option<[usize; 2]>,
    /// Whether the buffers are kept, so that all items in them are told of.
    keeps_buffers: bool,
    named: BTreeSet<u32>,
    runs: Vec<PickedRun>,
}

impl<'a> Picked<'a> {
    pub(super) fn new(
        stage: &'a Stage,
        attributes: &'a [Vec<Column>],
        (pixel, keeps_buffers): (Option<[usize; 2]>, bool),
    ) -> Self {
        Self { stage, attributes, pixel, keeps_buffers, named: BTreeSet::new(), runs: Vec::new() }
    }

    /// Takes what the buffers of a run say; the truth also tells how much of the pixel each item covers.
    pub(super) fn take(&mut self, technique: &str, planes: &[Plane], coverage: Option<&PixelCoverage>) {
        if self.keeps_buffers {
            self.named.extend(planes.iter().flat_map(items_in));
        }
        let Some(pixel) = self.pixel else { return };
        let found = picked(planes, pixel);
        let covered = |item: u32| {
            let entry = coverage?.items.iter().find(|entry| entry.item == item)?;
            Some([entry.low, entry.high])
        };
        self.named.extend(found.iter().flat_map(|(_, items)| *items));
        let (topmost, items) = found.map_or((None, None), |(topmost, items)| (topmost, Some(items)));
        let items =
            items.map(|items| items.iter().map(|item| PickedItem { item: *item, coverage: covered(*item) }));
        self.runs.push(PickedRun {
            technique: technique.into(),
            topmost,
            items: items.map(Iterator::collect),
        });
    }

    /// What there is at the pixel by each run, and what is told of all items that were named.
    pub(super) fn told(self) -> (Vec<PickedRun>, Vec<ItemResult>) {
        let items = self.named.iter().map(|item| self.item(*item)).collect();
        (self.runs, items)
    }

    fn item(&self, item: u32) -> ItemResult {
        let (list, layers) = (&self.stage.draw_list, &self.stage.scene.layers);
        let of = &list.items()[item as usize];
        let style = list.style_of(item);
        let part = match style.role {
            Role::Fill if style.swath.is_some() => "stroke",
            Role::Fill => "fill",
            Role::Outside => "outside",
            Role::Outline => "outline",
            Role::Line => "line",
            Role::Point => "point",
        };
        let known = |number: u32| (number != NO_FEATURE).then_some(number);
        let columns = self.attributes.get(of.layer as usize).map_or(&[][..], Vec::as_slice);
        let columns = if known(of.number).is_some() { columns } else { &[] };
        let value = |column: &Column| value(column.value(of.number as usize));
        let name = columns.iter().find(|column| column.name.eq_ignore_ascii_case("name"));
        ItemResult {
            item,
            layer: of.layer,
            layer_name: layers[of.layer as usize].name.clone(),
            feature: known(of.feature),
            number: known(of.number),
            part: part.into(),
            name: name.and_then(|column| column.value(of.number as usize).text().map(str::to_owned)),
            attributes: ByName::from_pairs(columns.iter().map(|column| (&column.name[..], value(column)))),
        }
    }
}

/// The items that a buffer names.
fn items_in(plane: &Plane) -> impl Iterator<Item = u32> {
    let names_items = [PlaneKind::ID, PlaneKind::IDS].iter().any(|kind| kind.name == plane.name);
    let items: &[u32] = match &plane.values {
        Values::U32(items) if names_items => items,
        _ => &[],
    };
    items.iter().copied().filter(|item| *item != NO_ITEM)
}

/// An attribute as JSON has it.
pub(super) fn value(attribute: &Attribute) -> Value {
    match attribute {
        Attribute::Null => Value::Null,
        Attribute::Boolean(flag) => (*flag).into(),
        Attribute::Integer(number) => (*number).into(),
        Attribute::Number(number) => (*number).into(),
        Attribute::Text(text) => text.as_str().into(),
    }
}
