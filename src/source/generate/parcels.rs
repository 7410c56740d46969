//! A cadastre: parcels of land in towns along a coast.

use super::random::{Sequence, at, scramble, signed, unit};
use super::roads::direction;
use crate::scene::Shape;
use crate::scene_file::VectorGenerator;
use crate::space::{Plan, PlanBox};
use glam::DVec2;

/// Parcels a side of a town.
const SIDE: usize = 12;

/// `count` parcels with eight or nine vertices each. Towns lie thick along a coast that wanders through the window, and thinner away from
/// it; parcels of a town share their borders.
pub(super) fn parcels(generator: &VectorGenerator, window: PlanBox) -> Vec<Shape> {
    let size = window.max - window.min;
    let towns = generator.count.div_ceil(SIDE * SIDE);
    let mut random = Sequence::new(generator.seed);
    let mut parcels = Vec::with_capacity(generator.count);
    // A town of this side would fill a twentieth of the window together with all others.
    let side = (size.x * size.y / (20.0 * towns as f64)).sqrt();
    for number in 0..towns {
        let along = random.unit();
        // The coast runs from the west to the east; twice the cube brings most towns near to it.
        let from_coast = random.signed();
        let coast = 0.5 + 0.25 * crate::math::sin(7.0 * along) + 0.08 * crate::math::sin(31.0 * along);
        let middle = window.min
            + DVec2::new(along * size.x, (coast + 0.4 * from_coast * from_coast * from_coast) * size.y);
        // A whole town is in the window, if it can be: half its diagonal and what its corners move.
        let margin = DVec2::splat(0.75 * side).min(size * 0.5);
        let middle =
            Plan::from(middle.to_vec().clamp(window.min.to_vec() + margin, window.max.to_vec() - margin));
        let town = Town {
            middle,
            step: direction(&mut random) * (side / SIDE as f64),
            seed: scramble(generator.seed ^ number as u64),
        };
        let cells = (0..SIDE * SIDE).take(generator.count - parcels.len());
        parcels.extend(cells.map(|cell| Shape::Polygon(vec![town.parcel(cell % SIDE, cell / SIDE)])));
    }
    parcels
}

struct Town {
    middle: Plan,
    /// From a parcel to the next of its row.
    step: DVec2,
    seed: u64,
}

impl Town {
    /// A corner of parcels, moved a little.
    fn corner(&self, column: usize, row: usize) -> Plan {
        let moved = |kind, place: usize| {
            place as f64 - 0.5 * SIDE as f64 + 0.2 * signed(at(self.seed ^ kind, column as i64, row as i64))
        };
        self.middle + self.step * moved(1, column) + self.step.perp() * moved(2, row)
    }

    /// Between two corners, the same from both sides.
    fn between(&self, (a, b): ((usize, usize), (usize, usize))) -> Plan {
        let (from, to) = (self.corner(a.0, a.1), self.corner(b.0, b.1));
        let hash = at(self.seed ^ 3, (a.0 + b.0) as i64, (a.1 + b.1) as i64);
        Plan::from((from.to_vec() + to.to_vec()) * 0.5 + (to - from).perp() * (0.06 * signed(hash)))
    }

    fn parcel(&self, column: usize, row: usize) -> Vec<Plan> {
        let corners = [(column, row), (column + 1, row), (column + 1, row + 1), (column, row + 1)];
        let mut ring = Vec::with_capacity(9);
        for k in 0..4 {
            let (a, b) = (corners[k], corners[(k + 1) % 4]);
            ring.push(self.corner(a.0, a.1));
            // The bend of a border is that of the way from its lesser corner.
            ring.push(self.between(if a < b { (a, b) } else { (b, a) }));
        }
        if unit(at(self.seed ^ 4, column as i64, row as i64)) < 1.0 / 3.0 {
            // A house's yard at the last border.
            let (from, to) = (ring[7], ring[0]);
            ring.push(Plan::from((from.to_vec() + to.to_vec()) * 0.5));
        }
        ring
    }
}

#[cfg(test)]
mod tests {
    use super::super::{features, tests::*};
    use super::*;
    use crate::scene_file::VectorKind;

    fn rings(count: usize) -> Vec<Vec<Plan>> {
        let generator = VectorGenerator { kind: VectorKind::Parcels, seed: 3, count, window: None };
        let ring = |shape| {
            if let Shape::Polygon(mut rings) = shape { rings.remove(0) } else { panic!("not a polygon") }
        };
        features(&generator, window()).into_iter().map(|feature| ring(feature.shape)).collect()
    }

    #[test]
    fn there_are_as_many_parcels_as_asked_for_with_eight_or_nine_vertices() {
        for count in [1, 144, 145, 3000] {
            assert_eq!(rings(count).len(), count);
        }
        let vertices: usize = rings(3000).iter().map(Vec::len).sum();
        assert!((24_700..25_300).contains(&vertices), "{vertices}");
    }

    #[test]
    fn parcels_turn_counter_clockwise_and_share_their_borders() {
        let rings = rings(144);
        let area = |ring: &Vec<Plan>| -> f64 {
            (0..ring.len()).map(|k| ring[k].to_vec().perp_dot(ring[(k + 1) % ring.len()].to_vec())).sum()
        };
        assert!(rings.iter().all(|ring| area(ring) > 0.0));
        let shared = rings[0].iter().filter(|p| rings[1].contains(p)).count();
        assert_eq!(shared, 3, "both corners and the bend between them");
    }

    #[test]
    fn parcels_keep_their_bits() {
        assert_eq!(bits(&rings(2000)), "f6f14d2224adbbc7");
    }
}
