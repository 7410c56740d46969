//! The area of each winding number in one texel, where edges cross or overlap: an accumulator of signed areas cannot tell them apart.
//!
//! The texel is cut into slabs at the ends and crossings of its edges; in a slab edges keep their order, so that the area
//! between two of them is a trapezoid. A crowd of edges is quartered first.

/// The winding numbers of the stroke and of the polygon that it may be cut to.
pub(super) type Windings = [i32; 2];

/// The part of an edge in the texel, from its smaller y to its larger; the texel is the unit square, x east, y south.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Fragment {
    pub(super) top: [f64; 2],
    pub(super) bottom: [f64; 2],
    /// Added to the winding numbers of what lies east of it.
    pub(super) adds: Windings,
}

/// A change of the winding numbers along the texel's western side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Step {
    /// South of this.
    pub(super) y: f64,
    pub(super) adds: Windings,
}

/// More edges than this are quartered: slabs cost the square of their number.
const CROWD: usize = 24;

/// After so many quarterings a square has an area of 2^-16: what it holds is told by its middle where still too many edges meet.
const DEEPEST: u32 = 8;

/// So many edges are cut into slabs even in the smallest square.
const TOO_MANY: usize = 256;

/// What a texel is made of.
#[derive(Debug, Clone, Default)]
pub(super) struct Texel {
    /// Winding numbers in the north-west corner.
    pub(super) corner: Windings,
    /// Changes along the western side.
    pub(super) steps: Vec<Step>,
    /// Edges.
    pub(super) fragments: Vec<Fragment>,
    heights: Vec<f64>,
    order: Vec<(f64, Windings)>,
}

/// A rectangle of the texel.
#[derive(Debug, Clone, Copy)]
struct TexelPart {
    min: [f64; 2],
    max: [f64; 2],
}

impl Texel {
    /// Empties it.
    pub(super) fn clear(&mut self, corner: Windings) {
        self.corner = corner;
        self.steps.clear();
        self.fragments.clear();
    }

    /// Adds to the winding numbers in the north-west corner.
    pub(super) fn add_corner(&mut self, adds: Windings) {
        self.corner = sum(self.corner, adds);
    }

    /// Adds a change along the western side.
    pub(super) fn add_step(&mut self, y: f64, adds: Windings) {
        self.steps.push(Step { y, adds });
    }

    /// Adds what an edge west of the texel does between two heights.
    pub(super) fn add_west(&mut self, (top, bottom): (f64, f64), adds: Windings) {
        if top < bottom {
            self.steps.push(Step { y: top, adds });
            self.steps.push(Step { y: bottom, adds: adds.map(|v| -v) });
        }
    }

    /// Calls `visit` with winding numbers and the area that has them, again and again, until the areas are 1 in all. Where `is_alike` says
    /// that it makes no difference which of some winding numbers of the stroke is told, one of them is told for all.
    pub(super) fn areas(
        &mut self,
        is_alike: &impl Fn((i32, i32)) -> bool,
        visit: &mut impl FnMut(Windings, f64),
    ) {
        merge(&mut self.corner, &mut self.steps, 0.0);
        let whole = TexelPart { min: [0.0; 2], max: [1.0; 2] };
        if self.fragments.len() <= CROWD {
            let mut room =
                Room { heights: std::mem::take(&mut self.heights), order: std::mem::take(&mut self.order) };
            room.slabs(&self.fragments, &self.steps, self.corner, &whole, visit);
            (self.heights, self.order) = (room.heights, room.order);
        } else {
            let mut room = Room::default();
            room.quarter(&self.fragments, &self.steps, (self.corner, is_alike), &whole, 0, visit);
        }
    }
}

/// Sorts steps and joins those at one height, so that only true changes are left, whatever they came from; those at or before the
/// northern end are part of the corner.
fn merge(corner: &mut Windings, steps: &mut Vec<Step>, north: f64) {
    steps.sort_unstable_by(|a, b| a.y.total_cmp(&b.y));
    let mut kept: usize = 0;
    for k in 0..steps.len() {
        let step = steps[k];
        if step.y <= north {
            *corner = sum(*corner, step.adds);
        } else if kept > 0 && steps[kept - 1].y == step.y {
            steps[kept - 1].adds = sum(steps[kept - 1].adds, step.adds);
        } else {
            // A height is complete when the next one begins.
            if kept > 0 && steps[kept - 1].adds == [0, 0] {
                kept -= 1;
            }
            steps[kept] = step;
            kept += 1;
        }
    }
    if kept > 0 && steps[kept - 1].adds == [0, 0] {
        kept -= 1;
    }
    steps.truncate(kept);
}

fn sum(a: Windings, b: Windings) -> Windings {
    [a[0] + b[0], a[1] + b[1]]
}

/// Lists that are used again.
#[derive(Debug, Default)]
struct Room {
    heights: Vec<f64>,
    order: Vec<(f64, Windings)>,
}

impl Room {
    fn slabs(
        &mut self,
        fragments: &[Fragment],
        steps: &[Step],
        corner: Windings,
        part: &TexelPart,
        visit: &mut impl FnMut(Windings, f64),
    ) {
        // Find where anything ends or crosses.
        self.heights.clear();
        self.heights.extend([part.min[1], part.max[1]]);
        self.heights.extend(steps.iter().map(|step| step.y).filter(|y| part.min[1] < *y && *y < part.max[1]));
        for (k, a) in fragments.iter().enumerate() {
            self.heights.extend([a.top[1], a.bottom[1]]);
            self.heights.extend(fragments[..k].iter().filter_map(|b| crossing(a, b)));
        }
        self.heights.sort_unstable_by(f64::total_cmp);

        // Measure each slab.
        let (mut west, mut next) = (corner, 0);
        for k in 1..self.heights.len() {
            let (north, south) = (self.heights[k - 1], self.heights[k]);
            if north >= south {
                continue;
            }
            while next < steps.len() && steps[next].y <= north {
                west = sum(west, steps[next].adds);
                next += 1;
            }
            let middle = 0.5 * (north + south);
            self.order.clear();
            let spans = |f: &&Fragment| f.top[1] <= north && f.bottom[1] >= south;
            self.order.extend(fragments.iter().filter(spans).map(|f| (f.x_at(middle), f.adds)));
            self.order.sort_by(|a, b| a.0.total_cmp(&b.0));
            let (mut winding, mut from) = (west, part.min[0]);
            for &(x, adds) in &self.order {
                if x > from {
                    visit(winding, (x - from) * (south - north));
                    from = x;
                }
                winding = sum(winding, adds);
            }
            visit(winding, (part.max[0] - from) * (south - north));
        }
    }

    fn quarter(
        &mut self,
        fragments: &[Fragment],
        steps: &[Step],
        (corner, is_alike): (Windings, &impl Fn((i32, i32)) -> bool),
        part: &TexelPart,
        depth: u32,
        visit: &mut impl FnMut(Windings, f64),
    ) {
        let size = [part.max[0] - part.min[0], part.max[1] - part.min[1]];
        if is_alike(range(fragments, steps, corner)) {
            return visit(corner, size[0] * size[1]);
        }
        if fragments.len() <= CROWD || (depth == DEEPEST && fragments.len() <= TOO_MANY) {
            return self.slabs(fragments, steps, corner, part, visit);
        }
        if depth == DEEPEST {
            let middle = [part.min[0] + 0.5 * size[0], part.min[1] + 0.5 * size[1]];
            return visit(winding_at(fragments, steps, corner, middle), size[0] * size[1]);
        }
        for quarter in 0..4 {
            let low = |axis: usize, far: bool| part.min[axis] + if far { 0.5 * size[axis] } else { 0.0 };
            let min = [low(0, quarter & 1 == 1), low(1, quarter & 2 == 2)];
            let inner = TexelPart { min, max: [min[0] + 0.5 * size[0], min[1] + 0.5 * size[1]] };
            let (mut inside, mut west) = (Vec::new(), steps.to_vec());
            fragments.iter().for_each(|f| f.clip(&inner, &mut inside, &mut west));
            let mut start = corner;
            merge(&mut start, &mut west, inner.min[1]);
            self.quarter(&inside, &west, (start, is_alike), &inner, depth + 1, visit);
        }
    }
}

/// Between which winding numbers of the stroke all points lie.
fn range(fragments: &[Fragment], steps: &[Step], corner: Windings) -> (i32, i32) {
    let all = steps.iter().map(|s| s.adds[0]).chain(fragments.iter().map(|f| f.adds[0]));
    let change: i32 = all.map(i32::abs).sum();
    (corner[0] - change, corner[0] + change)
}

fn winding_at(fragments: &[Fragment], steps: &[Step], corner: Windings, at: [f64; 2]) -> Windings {
    let west = steps.iter().filter(|step| step.y <= at[1]).fold(corner, |w, step| sum(w, step.adds));
    let is_west = |f: &&Fragment| f.top[1] <= at[1] && at[1] < f.bottom[1] && f.x_at(at[1]) <= at[0];
    fragments.iter().filter(is_west).fold(west, |w, f| sum(w, f.adds))
}

impl Fragment {
    fn x_at(&self, y: f64) -> f64 {
        let share = (y - self.top[1]) / (self.bottom[1] - self.top[1]);
        self.top[0] + share * (self.bottom[0] - self.top[0])
    }

    fn y_at(&self, x: f64) -> f64 {
        let share = (x - self.top[0]) / (self.bottom[0] - self.top[0]);
        self.top[1] + share * (self.bottom[1] - self.top[1])
    }

    /// Cuts the part in a rectangle out, and adds what the part west of it does along its side.
    fn clip(&self, part: &TexelPart, inside: &mut Vec<Self>, west: &mut Vec<Step>) {
        let (north, south) = (part.min[1], part.max[1]);
        if self.bottom[1] <= north || self.top[1] >= south {
            return;
        }
        let top = if self.top[1] >= north { self.top } else { [self.x_at(north), north] };
        let bottom = if self.bottom[1] <= south { self.bottom } else { [self.x_at(south), south] };
        let mut cuts = [top[1]; 4];
        let mut count = 1;
        for limit in [part.min[0], part.max[0]] {
            if (top[0] < limit) != (bottom[0] < limit) {
                cuts[count] = self.y_at(limit).clamp(top[1], bottom[1]);
                count += 1;
            }
        }
        cuts[1..count].sort_unstable_by(f64::total_cmp);
        cuts[count] = bottom[1];
        let x_at = |y: f64| match y {
            y if y == top[1] => top[0],
            y if y == bottom[1] => bottom[0],
            y => self.x_at(y),
        };
        for pair in cuts[..=count].windows(2) {
            let &[from, to] = pair else { continue };
            if from >= to {
                continue;
            }
            let middle = 0.5 * (x_at(from) + x_at(to));
            if middle < part.min[0] {
                west.push(Step { y: from, adds: self.adds });
                west.push(Step { y: to, adds: self.adds.map(|v| -v) });
            } else if middle <= part.max[0] {
                let within = |x: f64| x.clamp(part.min[0], part.max[0]);
                let (top, bottom) = ([within(x_at(from)), from], [within(x_at(to)), to]);
                inside.push(Self { top, bottom, adds: self.adds });
            }
        }
    }
}

/// The height at which two edges cross, strictly between the ends that they share.
fn crossing(a: &Fragment, b: &Fragment) -> Option<f64> {
    let north = if a.top[1] > b.top[1] { a.top[1] } else { b.top[1] };
    let south = if a.bottom[1] < b.bottom[1] { a.bottom[1] } else { b.bottom[1] };
    if north >= south {
        return None;
    }
    let (above, below) = (a.x_at(north) - b.x_at(north), a.x_at(south) - b.x_at(south));
    ((above > 0.0 && below < 0.0) || (above < 0.0 && below > 0.0))
        .then(|| north + (south - north) * (above / (above - below)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A closed ring in and around the unit square as fragments and western steps.
    fn texel(rings: &[Vec<[f64; 2]>]) -> Texel {
        let mut texel = Texel::default();
        let unit = TexelPart { min: [0.0; 2], max: [1.0; 2] };
        for ring in rings {
            for k in 0..ring.len() {
                let (from, to) = (ring[k], ring[(k + 1) % ring.len()]);
                let (top, bottom, sign) = if from[1] < to[1] { (from, to, 1) } else { (to, from, -1) };
                if top[1] < bottom[1] {
                    let edge = Fragment { top, bottom, adds: [sign, 0] };
                    edge.clip(&unit, &mut texel.fragments, &mut texel.steps);
                }
            }
        }
        texel
    }

    fn covered(texel: &mut Texel) -> f64 {
        let (mut all, mut inside) = (0.0, 0.0);
        texel.areas(&|_| false, &mut |winding, area| {
            all += area;
            if winding[0] != 0 {
                inside += area;
            }
        });
        assert!((all - 1.0).abs() < 1e-9, "{all}");
        inside
    }

    /// The share of the square's points with a winding number that is not 0, by a fine lattice.
    fn sampled(rings: &[Vec<[f64; 2]>], n: usize) -> f64 {
        let winding = |x: f64, y: f64| -> i32 {
            let mut turns = 0;
            for ring in rings {
                for k in 0..ring.len() {
                    let (a, b) = (ring[k], ring[(k + 1) % ring.len()]);
                    if (a[1] <= y) != (b[1] <= y) && a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) <= x {
                        turns += if a[1] < b[1] { 1 } else { -1 };
                    }
                }
            }
            turns
        };
        let at = |k: usize| (k as f64 + 0.5) / n as f64;
        let inside = (0..n * n).filter(|k| winding(at(k % n), at(k / n)) != 0).count();
        inside as f64 / (n * n) as f64
    }

    #[test]
    fn two_crossing_bands_cover_their_union() {
        let across = vec![[-1.0, 0.25], [-1.0, 0.5], [2.0, 0.5], [2.0, 0.25]];
        let along = vec![[0.5, -1.0], [0.5, 2.0], [0.75, 2.0], [0.75, -1.0]];
        assert!((covered(&mut texel(&[across, along])) - 0.4375).abs() < 1e-12);
    }

    #[test]
    fn the_areas_of_a_crossing_are_told_apart() {
        // A bow tie whose knot is in the middle: half of it turns each way.
        let tie = vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        let mut areas = [0.0; 3];
        texel(&[tie]).areas(&|_| false, &mut |winding, area| areas[(winding[0] + 1) as usize] += area);
        assert!(areas.iter().zip([0.25, 0.5, 0.25]).all(|(a, b)| (a - b).abs() < 1e-12), "{areas:?}");
    }

    #[test]
    fn what_comes_and_goes_at_one_height_west_of_the_texel_is_no_step() {
        let mut texel = Texel::default();
        texel.add_west((0.0, 0.5), [1, 0]);
        texel.add_west((0.5, 1.0), [1, 0]);
        assert_eq!(covered(&mut texel), 1.0);
        assert_eq!(
            (texel.corner, texel.steps.len()),
            ([1, 0], 1),
            "only the end at the southern side is left"
        );
    }

    fn rings(count: usize) -> impl Strategy<Value = Vec<Vec<[f64; 2]>>> {
        let point = [-0.6..1.6f64, -0.6..1.6f64];
        prop::collection::vec(prop::collection::vec(point, 3..6), 1..count)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn random_rings_cover_what_a_fine_lattice_says(rings in rings(6)) {
            let (exact, sampled) = (covered(&mut texel(&rings)), sampled(&rings, 200));
            prop_assert!((exact - sampled).abs() < 0.01, "{exact} {sampled}");
        }

        #[test]
        fn a_crowd_that_is_quartered_covers_what_slabs_say(rings in rings(30)) {
            let mut crowd = texel(&rings);
            let quartered = covered(&mut crowd);
            let mut slabs = 0.0;
            let whole = TexelPart { min: [0.0; 2], max: [1.0; 2] };
            let mut again = texel(&rings);
            merge(&mut again.corner, &mut again.steps, 0.0);
            Room::default().slabs(&again.fragments, &again.steps, again.corner, &whole, &mut |winding, area| {
                if winding[0] != 0 { slabs += area; }
            });
            prop_assert!((quartered - slabs).abs() < 1e-9, "{quartered} {slabs}");
        }
    }
}
