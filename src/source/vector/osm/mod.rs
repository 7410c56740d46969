//! OpenStreetMap's PBF (*PBF Format*, OpenStreetMap wiki): ways and the areas of relations.
//!
//! A way with tags is a line, or a polygon where it is closed and its tags say so (`area`). A relation of the type `multipolygon`
//! or `boundary` with tags of its own is a polygon of the rings that its ways make. Features are the ways in file order, then the
//! relations. Tags are columns of attributes; a value that is a plain number is one. Nodes with tags are points, and not drawn.
//!
//! The file is read three times, a blob at a time: which nodes are used, where these are, and the ways. So memory is taken for
//! nodes that are used alone, 16 bytes each, beside the features. Everything is held against the bytes of its blob; no count of the
//! file is believed.

mod area;
mod assemble;
mod blob;
mod block;
mod protobuf;

use super::collector::Collector;
use crate::crs::Crs;
use crate::error::Result;
use crate::scene::Attribute;
use crate::space::Plan;
use area::is_area;
use blob::Blobs;
use block::{Block, Position, Tags, Way};
use std::collections::BTreeMap;
use std::io::{Read, Seek};

/// Reads ways and relations, and of their tags what is wanted.
pub(super) fn read(input: impl Read + Seek, mut found: Collector) -> Result<Collector> {
    let mut blobs = Blobs::open(input)?;
    found.crs = Crs::crs84().ok();
    let (mut nodes, areas) = uses(&mut blobs)?;
    let points = nodes.find(&mut blobs)?;
    if points > 0 {
        let plural = if points == 1 { "" } else { "s" };
        found.notes.push(format!("{points} point{plural} left out: nodes with tags are not drawn"));
    }
    let mut ways = Ways { nodes, members: BTreeMap::new(), cut: 0 };
    for area in &areas {
        ways.members.extend(area.ways.iter().map(|way| (*way, None)));
    }
    for place in blobs.data.clone() {
        let content = blobs.unpacked(place)?;
        Block::of(&content)?.ways(|way| ways.add(way, &mut found))?;
    }
    let mut open = 0;
    for area in &areas {
        match ways.rings_of(area) {
            Some(rings) => {
                put_tags(area.tags.iter().map(|(key, value)| (key.as_str(), value.as_str())), &mut found);
                found.add_polygon(rings)?;
                found.next_feature();
            }
            None => open += 1,
        }
    }
    for (count, what) in [
        (ways.cut, "ways lack nodes that the file does not hold: lines end there, areas are left out"),
        (
            open,
            "areas of relations lack ways or nodes that the file does not hold, or do not close: left out",
        ),
    ] {
        if count > 0 {
            found.notes.push(format!("{count} {what}"));
        }
    }
    found.finish();
    Ok(found)
}

/// A relation that is an area.
struct Area {
    tags: Vec<(String, String)>,
    ways: Vec<i64>,
}

/// The nodes of all ways, and the relations that are areas.
fn uses<R: Read + Seek>(blobs: &mut Blobs<R>) -> Result<(Nodes, Vec<Area>)> {
    let (mut ids, mut areas) = (Vec::new(), Vec::new());
    for place in blobs.data.clone() {
        let content = blobs.unpacked(place)?;
        let block = Block::of(&content)?;
        block.ways(|way| {
            ids.extend(way.nodes);
            Ok(())
        })?;
        block.relations(|relation| {
            let is_area = relation
                .tags
                .iter()
                .any(|(key, value)| *key == "type" && matches!(*value, "multipolygon" | "boundary"));
            let tags = relation.tags.iter().filter(|(key, _)| *key != "type");
            let tags: Vec<_> = tags.map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
            if is_area && !tags.is_empty() {
                // A boundary's other ways (`subarea`, `label`) are none of its border.
                let is_border = |role: &[u8]| matches!(role, b"outer" | b"inner" | b"");
                let ways = relation.ways.iter().filter(|(_, role)| is_border(role)).map(|(id, _)| *id);
                areas.push(Area { tags, ways: ways.collect() });
            }
            Ok(())
        })?;
    }
    ids.sort_unstable();
    ids.dedup();
    ids.shrink_to_fit();
    Ok((Nodes { places: vec![NOWHERE; ids.len()], ids }, areas))
}

/// The place of a node that has not been met.
const NOWHERE: Position = [i32::MAX; 2];

/// The nodes that are used, by their ids in ascending order.
struct Nodes {
    ids: Vec<i64>,
    places: Vec<Position>,
}

impl Nodes {
    /// Notes where the nodes are; how many nodes of the file have tags.
    fn find<R: Read + Seek>(&mut self, blobs: &mut Blobs<R>) -> Result<usize> {
        let (mut points, mut next) = (0, 0);
        for place in blobs.data.clone() {
            let content = blobs.unpacked(place)?;
            Block::of(&content)?.nodes(&mut |id, place, is_tagged| {
                points += usize::from(is_tagged);
                // Most files have them in this order.
                let at = if self.ids.get(next) == Some(&id) { Ok(next) } else { self.ids.binary_search(&id) };
                if let Ok(at) = at {
                    self.places[at] = place;
                    next = at + 1;
                }
            })?;
        }
        Ok(points)
    }

    fn place(&self, id: i64) -> Option<Plan> {
        let place = self.ids.binary_search(&id).ok().map(|at| self.places[at]);
        let [x, y] = place.filter(|place| *place != NOWHERE)?;
        Some(Plan::new(f64::from(x) / 1e7, f64::from(y) / 1e7))
    }
}

/// The ways, as they are met.
struct Ways {
    nodes: Nodes,
    /// Those that relations have, and their nodes once they have been met.
    members: BTreeMap<i64, Option<Vec<i64>>>,
    /// How many lack nodes.
    cut: usize,
}

impl Ways {
    fn add(&mut self, way: Way<'_>, found: &mut Collector) -> Result<()> {
        let Way { id, tags, nodes } = way;
        if !tags.is_empty() {
            self.draw(&tags, &nodes, found)?;
        }
        if let Some(member) = self.members.get_mut(&id) {
            *member = Some(nodes);
        }
        Ok(())
    }

    fn draw(&mut self, tags: &Tags<'_>, ids: &[i64], found: &mut Collector) -> Result<()> {
        let places: Vec<Option<Plan>> = ids.iter().map(|id| self.nodes.place(*id)).collect();
        let parts: Vec<Vec<Plan>> =
            places.split(Option::is_none).map(|part| part.iter().flatten().copied().collect()).collect();
        let is_whole = places.iter().all(Option::is_some);
        self.cut += usize::from(!is_whole);
        let is_closed = ids.len() > 3 && ids.first() == ids.last();
        put_tags(tags.iter().copied(), found);
        match (is_closed && is_area(tags), is_whole) {
            (true, true) => found.add_polygon(parts)?,
            (true, false) => {}
            (false, _) => found.add_line(parts)?,
        }
        found.next_feature();
        Ok(())
    }

    /// The rings of an area; `None` where something is missing.
    fn rings_of(&self, area: &Area) -> Option<Vec<Vec<Plan>>> {
        let nodes = |id: &i64| self.members.get(id)?.as_deref();
        let ways: Vec<&[i64]> = area.ways.iter().map(nodes).collect::<Option<_>>()?;
        let rings = assemble::rings(&ways).filter(|rings| !rings.is_empty())?;
        let ring = |ring: Vec<i64>| ring.into_iter().map(|id| self.nodes.place(id)).collect();
        rings.into_iter().map(ring).collect()
    }
}

/// The tags of the current feature.
fn put_tags<'a>(tags: impl Iterator<Item = (&'a str, &'a str)>, found: &mut Collector) {
    if !found.attributes.are_read() {
        return;
    }
    let index = found.current();
    for (key, value) in tags {
        let column = found.attributes.column(key);
        if found.attributes.reads(column) {
            found.attributes.put(column, index, attribute(value));
        }
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
