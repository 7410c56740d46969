//! Relations that are areas: `multipolygon` and `boundary`, as members with their holes.
//!
//! By the wiki's *Relation:multipolygon*. The rings say what is a hole, by how they lie in one another; where roles are right that is what
//! they say, and where they are not a note tells. A relation without tags of its own has those of its outer ways, the custom of old.

use super::area::is_area;
use super::assemble::{self, Role};
use super::block::{Relation, Way};
use super::nodes::Nodes;
use crate::source::vector::rings::{members, owners_by_nesting, signed_area};
use crate::space::Plan;
use std::collections::{BTreeMap, BTreeSet};

/// Tags that say nothing of what a thing is.
const NO_TAGS: [&str; 6] = ["type", "created_by", "source", "note", "fixme", "FIXME"];
/// How many relations a note names.
const MOST_NAMED: usize = 3;

/// Tags that are kept.
pub(super) type OwnTags = Vec<(String, String)>;

/// The relations that are areas, and what is known of their ways.
#[derive(Default)]
pub(super) struct Areas {
    areas: Vec<Area>,
    ways: BTreeMap<i64, Member>,
}

struct Area {
    id: i64,
    /// Its own; none where its ways have them.
    tags: OwnTags,
    ways: Vec<(i64, Role)>,
}

/// A way of relations.
#[derive(Default)]
struct Member {
    nodes: Option<Vec<i64>>,
    /// Kept where a relation has none of its own.
    tags: Option<OwnTags>,
}

/// An area that the file holds whole.
pub(super) struct Whole {
    pub(super) id: i64,
    pub(super) tags: OwnTags,
    /// Outer rings against the clock, each with its holes, which turn the other way.
    pub(super) members: Vec<Vec<Vec<Plan>>>,
}

/// What relations come to.
pub(super) struct Made {
    pub(super) areas: Vec<Whole>,
    /// The ways whose tags are those of an area, and that are nothing themselves.
    pub(super) given: BTreeSet<i64>,
    pub(super) notes: Vec<String>,
}

impl Areas {
    /// Takes a relation, if it is an area.
    pub(super) fn add(&mut self, relation: &Relation<'_>) {
        let kind = relation.tags.iter().find(|(key, _)| *key == "type").map_or("", |(_, value)| *value);
        let own = relation.tags.iter().filter(|(key, _)| *key != "type");
        let says = |(key, _): &(&str, &str)| !NO_TAGS.contains(key);
        let (tags, says_what) = (owned(own), relation.tags.iter().any(says));
        if !(kind == "multipolygon" || kind == "boundary" && says_what) {
            return;
        }
        let mut ways: Vec<(i64, Role)> = Vec::new();
        for (id, role) in &relation.ways {
            let role = match *role {
                b"outer" => Role::Outer,
                b"inner" => Role::Inner,
                b"" => Role::Unknown,
                // A boundary's other ways (`subarea`, `label`) are none of its border.
                _ => continue,
            };
            let member = self.ways.entry(*id).or_default();
            if !says_what {
                member.tags = Some(Vec::new());
            }
            ways.push((*id, role));
        }
        // A way that is listed twice bounds the area once.
        let mut listed = BTreeSet::new();
        ways.retain(|(id, _)| listed.insert(*id));
        self.areas.push(Area { id: relation.id, tags: if says_what { tags } else { Vec::new() }, ways });
    }

    /// Whether there is none.
    pub(super) fn is_empty(&self) -> bool {
        self.areas.is_empty()
    }

    /// Takes of a way what relations need of it.
    pub(super) fn see(&mut self, way: &Way<'_>) {
        if let Some(member) = self.ways.get_mut(&way.id) {
            member.nodes = Some(way.nodes.clone());
            if let Some(tags) = &mut member.tags {
                *tags = owned(way.tags.iter());
            }
        }
    }

    /// Puts the areas together, when all ways have been seen and all nodes found.
    pub(super) fn made(self, nodes: &Nodes) -> Made {
        let mut made = Made { areas: Vec::new(), given: BTreeSet::new(), notes: Vec::new() };
        let [mut cut, mut open, mut contradicted] = [const { Vec::new() }; 3];
        for area in &self.areas {
            let (tags, given) = match area.tags.is_empty() {
                false => (area.tags.clone(), Vec::new()),
                true => match self.tags_of_ways(area) {
                    Some(found) => found,
                    None => continue,
                },
            };
            let Some(ways) = self.ways_of(area, nodes) else {
                cut.push(area.id);
                continue;
            };
            let known = |id: i64| nodes.position(id).unwrap_or_default();
            let Some(rings) = assemble::rings(&ways, &known).filter(|rings| !rings.is_empty()) else {
                open.push(area.id);
                continue;
            };
            let have_roles = ways.iter().all(|way| way.1 != Role::Unknown);
            let (members, are_right) = by_members(rings, have_roles, nodes);
            if !are_right {
                contradicted.push(area.id);
            }
            made.given.extend(given);
            made.areas.push(Whole { id: area.id, tags, members });
        }
        for (ids, fate) in [
            (cut, "lacking ways or nodes that the file does not hold, left out"),
            (open, "whose ways do not close to rings, left out"),
            (
                contradicted,
                "with roles that are not how the rings lie in one another: the rings are followed",
            ),
        ] {
            made.notes.extend(told(&ids, fate));
        }
        made
    }

    /// The nodes of an area's ways; `None` where the file lacks one.
    fn ways_of(&self, area: &Area, nodes: &Nodes) -> Option<Vec<(&[i64], Role)>> {
        let way = |(id, role): &(i64, Role)| {
            let own = self.ways.get(id)?.nodes.as_deref()?;
            own.iter().all(|node| nodes.position(*node).is_some()).then_some((own, *role))
        };
        area.ways.iter().map(way).collect()
    }

    /// The tags that all outer ways which have some of an area share, and the ways that have no others to say; `None` where those
    /// are not an area's. An inner way with the very tags is a hole and nothing else.
    fn tags_of_ways(&self, area: &Area) -> Option<(OwnTags, Vec<i64>)> {
        let tags = |id: &i64| self.ways.get(id).and_then(|member| member.tags.as_ref());
        let outer = area.ways.iter().filter(|(_, role)| *role != Role::Inner);
        let outer: Vec<(i64, &OwnTags)> =
            outer.filter_map(|(id, _)| Some((*id, tags(id).filter(|tags| is_area(tags))?))).collect();
        let mut shared = outer.first()?.1.clone();
        shared.retain(|tag| outer.iter().all(|(_, tags)| tags.contains(tag)));
        if !is_area(&shared) {
            return None;
        }
        let inner = area.ways.iter().filter(|(_, role)| *role == Role::Inner).map(|(id, _)| *id);
        let same = inner.filter(|id| tags(id) == Some(&shared));
        let given = outer.iter().map(|(id, _)| *id).chain(same).collect();
        Some((shared, given))
    }
}

/// Rings by members, outer ones against the clock and holes with it; and whether roles said so.
fn by_members(rings: Vec<(Vec<i64>, Role)>, have_roles: bool, nodes: &Nodes) -> (Vec<Vec<Vec<Plan>>>, bool) {
    let (mut places, mut roles) = (Vec::new(), Vec::new());
    for (ring, role) in rings {
        places.push(ring.into_iter().filter_map(|id| nodes.place(id)).collect::<Vec<Plan>>());
        roles.push(role);
    }
    let owners = owners_by_nesting(&places);
    let mut are_right = true;
    for (k, ring) in places.iter_mut().enumerate() {
        let is_outer = owners[k] == k;
        are_right &= match roles[k] {
            Role::Outer => is_outer,
            Role::Inner => !is_outer,
            Role::Unknown => !have_roles,
        };
        if (signed_area(ring) > 0.0) != is_outer {
            ring.reverse();
        }
    }
    (members(places, &owners), are_right)
}

fn owned<'a>(tags: impl Iterator<Item = &'a (&'a str, &'a str)>) -> OwnTags {
    tags.map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect()
}

/// A note on relations, some of them by their ids.
fn told(ids: &[i64], fate: &str) -> Option<String> {
    let named: Vec<String> = ids.iter().take(MOST_NAMED).map(i64::to_string).collect();
    let (areas, relations) = if ids.len() == 1 { ("area", "relation") } else { ("areas", "relations") };
    let more = if ids.len() > MOST_NAMED { ", ..." } else { "" };
    (!ids.is_empty())
        .then(|| format!("{} {areas} {fate} ({relations} {}{more})", ids.len(), named.join(", ")))
}
