//! Which samples a leaf of a cell's trees holds: a segment, a fill.

use super::cell::{Cell, FillLeaf, LineLeaf, NOTHING, RingPart};
use super::decals::Decals;
use super::packet::{LookupCounts, Packet, of, single};
use super::quadtree::Counts as QuadtreeCounts;
use super::settings::Outlines;
use crate::draw_list::{Role, Side};
use crate::space::{Plan, PlanBox, SmallBox};

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
                _ => segment.mask_of(packet.x, packet.y) & wanted,
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
                    let inside = self.held_by_area(cell, cell.area_of(owner), (packet, held), counts);
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
        let inside = self.held_by_area(cell, leaf.area, (packet, wanted), counts);
        if self.list().style_of(leaf.item).role == Role::Outside { wanted & !inside } else { inside }
    }

    /// Which of the wanted samples lie inside of any member of an area: the rule says which of the winding numbers of a member's rings, exterior
    /// and interior ones at any nesting, are inside.
    fn held_by_area(
        &self,
        cell: &Cell,
        area: u32,
        (packet, wanted): (&Packet, u64),
        counts: &mut LookupCounts,
    ) -> u64 {
        if area == NOTHING {
            return 0;
        }
        let rings = cell.rings_of(area);
        let rule = self.list().style_of(cell.areas[area as usize].owner).rule;
        let vertices = self.list().vertices();
        let (mut inside, mut done) = (0, QuadtreeCounts::default());
        for member in
            rings.chunk_by(|a, b| self.source.chain_of(a.ring).member == self.source.chain_of(b.ring).member)
        {
            let mut left = wanted & !inside;
            if !self.is_single
                && left != 0
                && let Some(turns) = self.turns_throughout(member, packet, &mut done)
            {
                // As a rule no edge is near.
                inside |= if rule.contains(turns) { left } else { 0 };
                continue;
            }
            while left != 0 {
                let k = left.trailing_zeros() as usize;
                left &= left - 1;
                let mut turns = 0;
                for part in member {
                    let quadtree = self.source.quadtree(part.ring);
                    turns += match self.is_single {
                        false => quadtree.winding(vertices, part.start, packet.points[k], &mut done),
                        true => {
                            quadtree.winding_f32(vertices, part.start, single(packet.points[k]), &mut done)
                        }
                    };
                }
                if rule.contains(turns) {
                    inside |= 1 << k;
                }
            }
        }
        counts.quadtree_nodes += done.nodes;
        counts.edges += done.edges;
        inside
    }

    /// How often a member's rings turn around all of the samples, where that is one number.
    #[inline]
    fn turns_throughout(
        &self,
        member: &[RingPart],
        packet: &Packet,
        done: &mut QuadtreeCounts,
    ) -> Option<i32> {
        let vertices = self.list().vertices();
        let one = |part: &RingPart| {
            let quadtree = self.source.quadtree(part.ring);
            quadtree.turns_throughout(vertices, part.start, (&packet.plan, packet.plan.min), done)
        };
        member.iter().map(one).sum()
    }

    /// Whether a point lies inside of an area of its cell.
    pub(super) fn is_inside(&self, cell: &Cell, area: u32, at: Plan) -> bool {
        let packet = Packet {
            points: &[at],
            x: &[at.x],
            y: &[at.y],
            plan: PlanBox::around([at]),
            bounds: SmallBox::around(&PlanBox::around([at])),
            open: 1,
        };
        self.held_by_area(cell, area, (&packet, 1), &mut LookupCounts::default()) == 1
    }
}
