//! Which samples a leaf of a cell's trees holds: a segment, a fill.

use super::cell::{Cell, FillLeaf, LineLeaf, NOTHING, RingPart, Turns};
use super::decals::Decals;
use super::hits::MOST_TOGETHER;
use super::packet::{LookupCounts, Packet, of, single};
use super::quadtree::{Counts as QuadtreeCounts, run_misses, south_east, turns_of_run};
use super::settings::Outlines;
use crate::draw_list::{Role, Side};
use crate::scene::Rule;
use crate::space::{Plan, PlanBox};

impl Decals<'_> {
    /// Which of the wanted samples a segment holds.
    #[inline]
    pub(super) fn held_by_line(
        &self,
        cell: &Cell,
        leaf: LineLeaf,
        packet: &Packet,
        wanted: u64,
        counts: &mut LookupCounts,
    ) -> u64 {
        counts.leaves += 1;
        let mut held = match self.is_single {
            false => self.source.segment(leaf).map_or(0, |segment| match packet.points {
                [only] => u64::from(segment.holds(*only)),
                _ => {
                    let (x, y) = packet.axes();
                    segment.mask_of(x, y) & wanted
                }
            }),
            true => {
                let segment = self.source.single_segment(leaf);
                segment.map_or(0, |segment| of(packet.points, wanted, |at| segment.holds(single(*at))))
            }
        };
        let style = self.list().style_of(leaf.item);
        if let Some(side) = style.cut
            && held != 0
        {
            held = match self.settings.outlines {
                Outlines::Side => {
                    let is_left_inside = self.sides.is_left_inside(&self.source, leaf.item, leaf.chain);
                    let Some(segment) = self.source.segment(leaf) else { return 0 };
                    let is_wanted = |at: &Plan| {
                        let turn = segment.side(*at);
                        // A point on the centre line lies on both sides.
                        turn == 0.0 || ((turn > 0.0) == is_left_inside) == (side == Side::Inside)
                    };
                    of(packet.points, held, is_wanted)
                }
                Outlines::Polygon => {
                    let owner = self.list().area_owner(leaf.item);
                    let area = (cell.area_of(owner), self.list().style_of(owner).rule);
                    let inside = self.held_by_area(cell, area, (packet, held), counts);
                    if side == Side::Inside { inside } else { held & !inside }
                }
            };
        }
        held
    }

    /// Which of the wanted samples a fill holds.
    #[inline]
    pub(super) fn held_by_fill(
        &self,
        cell: &Cell,
        leaf: FillLeaf,
        packet: &Packet,
        wanted: u64,
        counts: &mut LookupCounts,
    ) -> u64 {
        counts.leaves += 1;
        let style = &self.list().styles()[leaf.style as usize];
        let inside = self.held_by_area(cell, (leaf.area, style.rule), (packet, wanted), counts);
        if style.role == Role::Outside { wanted & !inside } else { inside }
    }

    /// Which of the wanted samples lie inside of any member of an area: the rule says which of the winding numbers of a member's rings, exterior
    /// and interior ones at any nesting, are inside.
    fn held_by_area(
        &self,
        cell: &Cell,
        (area, rule): (u32, Rule),
        (packet, wanted): (&Packet, u64),
        counts: &mut LookupCounts,
    ) -> u64 {
        if area == NOTHING {
            return 0;
        }
        let (mut inside, mut done) = (0, QuadtreeCounts::default());
        for member in cell.rings_of(area).chunk_by(|_, next| !next.opens_member) {
            let left = wanted & !inside;
            let is_alone = left & left.wrapping_sub(1) == 0;
            // A machine decides at each point anew.
            inside |= if is_alone || self.is_single {
                of(packet.points, left, |at| {
                    let turns = member.iter().map(|part| self.turns_around(cell, part, *at, &mut done));
                    rule.contains(turns.sum())
                })
            } else {
                self.held_by_member(cell, (member, rule), (packet, left), &mut done)
            };
        }
        counts.quadtree_nodes += done.nodes;
        counts.edges += done.edges;
        inside
    }

    /// How often a part of a member's rings turns around a point.
    #[inline(always)]
    fn turns_around(&self, cell: &Cell, part: &RingPart, at: Plan, done: &mut QuadtreeCounts) -> i32 {
        match part.turns {
            Turns::Throughout(turns) => turns,
            Turns::Own { corner, .. } => {
                let run = cell.run_of(&part.turns);
                done.edges += run.len() as u64 - 1;
                corner + turns_of_run(run, cell.corner, at)
            }
            Turns::Tree { ring, start } => {
                let (quadtree, vertices) = (self.source.quadtree(ring), self.list().vertices());
                match self.is_single {
                    false => quadtree.winding(vertices, start, at, done),
                    true => quadtree.winding_f32(vertices, start, single(at), done),
                }
            }
        }
    }

    /// Which of several samples lie inside of a member. Their box is asked as if it were a leaf of its own: how often the rings turn around its corner,
    /// and which edges meet it; as a rule none do.
    fn held_by_member(
        &self,
        cell: &Cell,
        (member, rule): (&[RingPart], Rule),
        (packet, wanted): (&Packet, u64),
        done: &mut QuadtreeCounts,
    ) -> u64 {
        let (mut throughout, mut apart, mut is_apart) = (0, [0; MOST_TOGETHER], false);
        let corner = south_east(&packet.plan);
        for part in member {
            match part.turns {
                Turns::Throughout(turns) => throughout += turns,
                Turns::Own { .. } => {
                    throughout += self.turns_around(cell, part, corner, done);
                    for edge in cell.run_of(&part.turns).windows(2) {
                        if !run_misses(edge, &packet.plan) {
                            done.edges += u64::from(wanted.count_ones());
                            is_apart = true;
                            add(&mut apart, (packet, wanted), |at| turns_of_run(edge, corner, at));
                        }
                    }
                }
                Turns::Tree { ring, start } => {
                    let (quadtree, vertices) = (self.source.quadtree(ring), self.list().vertices());
                    let at = (&packet.plan, packet.plan.min);
                    match quadtree.turns_throughout(vertices, start, at, done) {
                        Some(turns) => throughout += turns,
                        None => {
                            is_apart = true;
                            add(&mut apart, (packet, wanted), |at| {
                                quadtree.winding(vertices, start, at, done)
                            });
                        }
                    }
                }
            }
        }
        if !is_apart {
            return if rule.contains(throughout) { wanted } else { 0 };
        }
        let is_inside = |k: &usize| wanted >> k & 1 == 1 && rule.contains(throughout + apart[*k]);
        (0..packet.points.len()).filter(is_inside).fold(0, |all, k| all | 1 << k)
    }

    /// Whether a point lies inside of an area of its cell.
    pub(super) fn is_inside(&self, cell: &Cell, area: u32, at: Plan) -> bool {
        let Some(part) = cell.areas.get(area as usize) else { return false };
        let (points, rule) = ([at], self.list().style_of(part.owner).rule);
        let packet = Packet::new(&points, 1, &PlanBox::around(points));
        self.held_by_area(cell, (area, rule), (&packet, 1), &mut LookupCounts::default()) == 1
    }
}

/// Adds turns to those of each of the wanted samples.
#[inline(always)]
fn add(all: &mut [i32; MOST_TOGETHER], (packet, wanted): (&Packet, u64), mut turns: impl FnMut(Plan) -> i32) {
    for (k, (sum, at)) in all.iter_mut().zip(packet.points).enumerate() {
        if wanted >> k & 1 == 1 {
            *sum += turns(*at);
        }
    }
}
