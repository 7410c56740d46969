//! OpenStreetMap's PBF (*PBF Format*, OpenStreetMap wiki): ways and the areas of relations.
//!
//! A way with tags is a line, or a polygon where it is closed and its tags say so (`area`). A relation of the type `multipolygon`
//! or `boundary` is the polygons of the rings that its ways make (`multipolygon`). Features are the ways in file order, then the
//! relations. Tags are columns of attributes; a value that is a plain number is one; `osm_id` and `osm_type` (`way`, `relation`) are
//! columns, too. Nodes with tags are points, and not drawn.
//!
//! The file is read three times, a blob at a time: which nodes are used, where these are and what relations need of ways, and the ways.
//! So memory is taken for nodes that are used alone, 16 bytes each, beside the features. Everything is held against the bytes of its
//! blob; no count of the file is believed.

mod area;
mod assemble;
mod blob;
mod block;
mod multipolygon;
mod nodes;
mod protobuf;

use super::collector::Collector;
use crate::crs::Crs;
use crate::error::Result;
use crate::scene::Attribute;
use crate::space::Plan;
use area::is_area;
use blob::{Blobs, Place};
use block::{Block, Way};
use multipolygon::Areas;
use nodes::Nodes;
use std::collections::BTreeSet;
use std::io::{Read, Seek};

/// The columns of what is no tag: they are an element's, whatever tags of these names it has.
const ID: &str = "osm_id";
const TYPE: &str = "osm_type";

/// Reads ways and relations, and of their tags what is wanted.
pub(super) fn read(input: impl Read + Seek, mut found: Collector) -> Result<Collector> {
    let mut blobs = Blobs::open(input)?;
    found.crs = Crs::crs84().ok();
    let Uses { mut nodes, mut areas, with_nodes, with_ways } = uses(&mut blobs)?;
    let mut points = 0;
    for place in with_nodes {
        points += nodes.find(&Block::of(&blobs.unpacked(place)?)?)?;
    }
    if !areas.is_empty() {
        for place in &with_ways {
            Block::of(&blobs.unpacked(*place)?)?.ways(|way| {
                areas.see(&way);
                Ok(())
            })?;
        }
    }
    if points > 0 {
        let plural = if points == 1 { "" } else { "s" };
        found.notes.push(format!("{points} point{plural} left out: nodes with tags are not drawn"));
    }
    let made = areas.made(&nodes);
    let mut ways = Ways { nodes, given: made.given, cut: 0 };
    for place in with_ways {
        Block::of(&blobs.unpacked(place)?)?.ways(|way| ways.draw(&way, &mut found))?;
    }
    for area in made.areas {
        let tags = area.tags.iter().map(|(key, value)| (key.as_str(), value.as_str()));
        put_attributes((area.id, "relation"), tags, &mut found);
        found.add_polygons(area.members)?;
        found.next_feature();
    }
    if ways.cut > 0 {
        let what = "ways lack nodes that the file does not hold: lines end there, areas are left out";
        found.notes.push(format!("{} {what}", ways.cut));
    }
    found.notes.extend(made.notes);
    found.finish();
    Ok(found)
}

/// What is used of a file, and where it is.
struct Uses {
    nodes: Nodes,
    areas: Areas,
    with_nodes: Vec<Place>,
    with_ways: Vec<Place>,
}

/// The nodes of all ways, and the relations that are areas.
fn uses<R: Read + Seek>(blobs: &mut Blobs<R>) -> Result<Uses> {
    let (mut ids, mut areas) = (Vec::new(), Areas::default());
    let (mut with_nodes, mut with_ways) = (Vec::new(), Vec::new());
    for place in blobs.data.clone() {
        let content = blobs.unpacked(place)?;
        let block = Block::of(&content)?;
        let (has_nodes, has_ways) = block.kinds();
        with_nodes.extend(has_nodes.then_some(place));
        with_ways.extend(has_ways.then_some(place));
        block.ways(|way| {
            ids.extend(way.nodes);
            Ok(())
        })?;
        block.relations(|relation| {
            areas.add(&relation);
            Ok(())
        })?;
    }
    Ok(Uses { nodes: Nodes::used(ids), areas, with_nodes, with_ways })
}

/// The ways, as they are met.
struct Ways {
    nodes: Nodes,
    /// Those that have given their tags to an area.
    given: BTreeSet<i64>,
    /// How many lack nodes.
    cut: usize,
}

impl Ways {
    fn draw(&mut self, way: &Way<'_>, found: &mut Collector) -> Result<()> {
        let Way { id, tags, nodes } = way;
        if tags.is_empty() || self.given.contains(id) {
            return Ok(());
        }
        let places: Vec<Option<Plan>> = nodes.iter().map(|id| self.nodes.place(*id)).collect();
        let parts: Vec<Vec<Plan>> =
            places.split(Option::is_none).map(|part| part.iter().flatten().copied().collect()).collect();
        let is_whole = places.iter().all(Option::is_some);
        self.cut += usize::from(!is_whole);
        let is_closed = nodes.len() > 3 && nodes.first() == nodes.last();
        put_attributes((*id, "way"), tags.iter().copied(), found);
        match (is_closed && is_area(tags), is_whole) {
            (true, true) => found.add_polygon(parts)?,
            (true, false) => {}
            (false, _) => found.add_line(parts)?,
        }
        found.next_feature();
        Ok(())
    }
}

/// What is known of the current feature: the element's id and type, and its tags.
fn put_attributes<'a>(
    (id, kind): (i64, &str),
    tags: impl Iterator<Item = (&'a str, &'a str)>,
    found: &mut Collector,
) {
    if !found.attributes.are_read() {
        return;
    }
    let index = found.current();
    let mut put = |key: &str, value: &dyn Fn() -> Attribute| {
        let column = found.attributes.column(key);
        if found.attributes.reads(column) {
            found.attributes.put(column, index, value());
        }
    };
    put(ID, &|| Attribute::Integer(id));
    put(TYPE, &|| Attribute::Text(kind.to_owned()));
    for (key, value) in tags.filter(|(key, _)| !matches!(*key, ID | TYPE)) {
        put(key, &|| attribute(value));
    }
}

/// A text, or the number that it is when a number is written that way.
fn attribute(text: &str) -> Attribute {
    let whole = text.parse().ok().filter(|number: &i64| number.to_string() == text);
    let number = || text.parse().ok().filter(|number: &f64| number.is_finite() && number.to_string() == text);
    match whole.map(Attribute::Integer).or_else(|| number().map(Attribute::of_number)) {
        Some(number) => number,
        None => Attribute::Text(text.to_owned()),
    }
}
