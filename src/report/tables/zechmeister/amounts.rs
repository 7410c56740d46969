//! How much a scene has, as Tables 5.1 to 5.3 of the thesis count it.

use crate::draw_list::{Chain, DrawList, Item, NO_FEATURE, Role};
use crate::stage::Stage;
use std::collections::{BTreeMap, BTreeSet};

/// Rings or lines, and all their vertices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize)]
pub struct Amount {
    /// Rings or lines.
    pub decals: usize,
    /// Their vertices.
    pub vertices: usize,
}

/// Tables 5.1 and 5.2.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize)]
pub struct Amounts {
    /// Outer rings of filled polygons.
    pub exterior: Amount,
    /// Their holes.
    pub interior: Amount,
    /// Lines, and the rings of outlines.
    pub lines: Amount,
}

/// Table 5.3: data groups (layers), and how many draw in individual colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize)]
pub struct Groups {
    /// Polygons with outlines.
    pub outlined: usize,
    /// Polygons alone.
    pub areas: usize,
    /// Lines alone, and outlines without a fill.
    pub lines: usize,
    /// Groups whose fills have more than one colour.
    pub colored_areas: usize,
    /// Groups whose lines or outlines have.
    pub colored_lines: usize,
}

impl Groups {
    /// Fills and strokes are drawn in calls of their own (5.1).
    pub const fn draw_calls(&self) -> usize {
        2 * self.outlined + self.areas + self.lines
    }
}

impl Amount {
    fn add(&mut self, vertices: usize) {
        self.decals += 1;
        self.vertices += vertices;
    }
}

/// Counts what a stage has. The first ring of each member of a polygon is taken as its outer one.
pub fn amounts(stage: &Stage) -> Amounts {
    let list = &stage.draw_list;
    let mut all = Amounts::default();
    for (number, item) in list.numbered() {
        for (chain, is_outer) in rings(list, item, list.style_of(number).role) {
            let amount = if is_outer { &mut all.exterior } else { &mut all.interior };
            amount.add(chain.count as usize);
        }
        match list.style_of(number).role {
            Role::Outline => list.strokes(item).iter().for_each(|chain| all.lines.add(chain.count as usize)),
            Role::Line => {
                list.strokes(item).iter().for_each(|chain| all.lines.add(list.path_of(chain).len()))
            }
            Role::Fill | Role::Outside | Role::Point => {}
        }
    }
    all
}

/// The rings of a fill, and whether each is an outer one; none of another item.
pub(super) fn rings<'a>(
    list: &'a DrawList,
    item: &'a Item,
    role: Role,
) -> impl Iterator<Item = (&'a Chain, bool)> {
    let area = if role == Role::Fill && item.feature != NO_FEATURE { list.area(item) } else { &[] };
    let is_outer = |k: usize| k == 0 || area[k - 1].member != area[k].member;
    area.iter().enumerate().map(move |(k, chain)| (chain, is_outer(k)))
}

/// Counts the data groups of a stage.
pub fn groups(stage: &Stage) -> Groups {
    let list = &stage.draw_list;
    let mut colors: BTreeMap<(u32, bool), BTreeSet<[u64; 4]>> = BTreeMap::new();
    for (number, item) in list.numbered() {
        let style = list.style_of(number);
        let is_area = match style.role {
            Role::Fill | Role::Outside => true,
            Role::Outline | Role::Line => false,
            Role::Point => continue,
        };
        colors.entry((item.layer, is_area)).or_default().insert(style.paint.0.map(f64::to_bits));
    }
    let mut groups = Groups::default();
    for layer in colors.keys().map(|(layer, _)| *layer).collect::<BTreeSet<u32>>() {
        let of = |is_area| colors.get(&(layer, is_area)).map_or(0, BTreeSet::len);
        match (of(true), of(false)) {
            (0, _) => groups.lines += 1,
            (_, 0) => groups.areas += 1,
            _ => groups.outlined += 1,
        }
        groups.colored_areas += usize::from(of(true) > 1);
        groups.colored_lines += usize::from(of(false) > 1);
    }
    groups
}
