//! Edges without samples: which share of a pixel an item covers, from the distance of its border (3.5 and 4.3.2 leave it to future work; Thöny et al. 2017 do
//! so for lines).
//!
//! Across a border the pixel is as wide as its parallelogram in the plan is in the direction of the border's normal. The nearest border alone is
//! looked at, as if it were straight: corners and what is thinner than a pixel on both sides of another thing come out wrong.

use super::bvh::Walk;
use super::cell::{Cell, NOTHING, Turns};
use super::contents::RingsAs;
use super::decals::Decals;
use super::share::{PlanPixel, Shares};
use crate::draw_list::{Role, Side};
use crate::math;
use crate::space::{Plan, SmallBox};
use glam::DVec2;

/// Where a pixel reaches over more cells than this, one is built for it alone.
const MOST_CELLS: usize = 4;

impl Decals<'_> {
    /// Finds the items that cover a share of a pixel; quickly where the settings say `edges = "analytic"`. `shares` is emptied first.
    pub fn cover(&self, pixel: &PlanPixel, shares: &mut Shares) {
        shares.found.clear();
        shares.edges.clear();
        let bounds = pixel.bounds();
        let wanted = SmallBox::around(&bounds);
        let cells = self.grid.cells_in(&bounds, MOST_CELLS);
        // Cells that were made for points alone do not know their edges.
        if let Some(cells) = cells.filter(|_| self.rings_as == RingsAs::Trees) {
            let home = self.cell_of(pixel.at).and_then(|cell| self.cell(cell));
            let near: Vec<&Cell> = cells.iter().filter_map(|cell| self.cell(*cell)).collect();
            self.cover_from(&near, home, (pixel, wanted), shares);
        } else if let Some(own) = self.cell_around(&bounds, RingsAs::Trees) {
            self.cover_from(&[&own], Some(&own), (pixel, wanted), shares);
        }
    }

    /// Finds the items of some cells; `home` is that of the pixel's centre.
    fn cover_from(
        &self,
        cells: &[&Cell],
        home: Option<&Cell>,
        (pixel, wanted): (&PlanPixel, SmallBox),
        shares: &mut Shares,
    ) {
        cells.iter().for_each(|cell| self.find_edges(cell, wanted, pixel, shares));
        for cell in cells {
            for leaf in Walk::new(&cell.lines, wanted) {
                let leaf = cell.segments[leaf as usize];
                let Some(segment) = self.source.segment(leaf) else { continue };
                let mut share =
                    pixel.share(segment.depth_inside(pixel.at), segment.normal_to(pixel.at), segment.width());
                if let Some(side) = self.list().style_of(leaf.item).cut
                    && share > 0.0
                {
                    let inside = self.share_inside(self.list().area_owner(leaf.item), home, pixel, shares);
                    share = math::min(share, if side == Side::Inside { inside } else { 1.0 - inside });
                }
                shares.found.push((leaf.item, share));
            }
            for leaf in Walk::new(&cell.polygons, wanted) {
                let item = cell.fills[leaf as usize].item;
                let inside = self.share_inside(item, home, pixel, shares);
                let is_outside = self.list().style_of(item).role == Role::Outside;
                shares.found.push((item, if is_outside { 1.0 - inside } else { inside }));
            }
        }
        // Of an item that was found several times, the largest share.
        shares.found.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
        shares.found.dedup_by_key(|(item, _)| *item);
        shares.found.retain(|(_, share)| *share > 0.0);
    }

    /// Finds the edges of areas near a pixel.
    fn find_edges(&self, cell: &Cell, wanted: SmallBox, pixel: &PlanPixel, shares: &mut Shares) {
        let vertices = self.list().vertices();
        for (area, part) in (0..).zip(&cell.areas) {
            for ring in cell.rings_of(area) {
                let Turns::Tree { ring, start } = ring.turns else { continue };
                let quadtree = self.source.quadtree(ring);
                quadtree.edges_near(vertices, start, &wanted, &mut |from, to| {
                    let away = nearest(pixel.at, from, to) - pixel.at;
                    let known = shares.edges.iter_mut().find(|(owner, ..)| *owner == part.owner);
                    let along = to - from;
                    let square = along.length_squared();
                    let normal = if square > 0.0 { along.perp() / square.sqrt() } else { DVec2::X };
                    match known {
                        Some(known) if known.1 <= away.length() => {}
                        Some(known) => *known = (part.owner, away.length(), normal),
                        None => shares.edges.push((part.owner, away.length(), normal)),
                    }
                });
            }
        }
    }

    /// The share of a pixel that lies inside of an area.
    fn share_inside(&self, owner: u32, home: Option<&Cell>, pixel: &PlanPixel, shares: &Shares) -> f64 {
        let area = home.map(|cell| (cell, cell.area_of(owner)));
        let is_inside =
            area.is_some_and(|(cell, area)| area != NOTHING && self.is_inside(cell, area, pixel.at));
        match shares.edges.iter().find(|(of, ..)| *of == owner) {
            Some((_, away, normal)) => {
                let depth = if is_inside { *away } else { -away };
                pixel.share(depth, *normal, f64::INFINITY)
            }
            None => f64::from(u8::from(is_inside)),
        }
    }
}

/// The point of a segment that is nearest to a point.
fn nearest(at: Plan, from: Plan, to: Plan) -> Plan {
    let along = to - from;
    let square = along.length_squared();
    let t = if square > 0.0 { ((at - from).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
    from + along * t
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decal::Settings;
    use crate::scene_file::SceneFile;
    use crate::space::PlanBox;
    use crate::stage::Stage;

    fn stage(layer: &str) -> Stage {
        let text = format!(
            "schema = 1\ncamera = {{ eye = [0, -90, 90], target = [0, 0, 0] }}\n\
             terrain = {{ generate = {{ kind = \"plane\", posts = [9, 9], cell_m = 10 }} }}\n[[layer]]\n{layer}\n"
        );
        let file = SceneFile::parse(&text, None, &[]).unwrap();
        let (scene, surface) = crate::source::load::load(&file, &|_| {}).unwrap();
        Stage::new(scene, surface).unwrap()
    }

    /// What covers pixels of 1 m.
    fn covered<const N: usize>(layer: &str, settings: &Settings, at: [[f64; 2]; N]) -> [Vec<(u32, f64)>; N] {
        let stage = stage(layer);
        let terrain = PlanBox { min: Plan::new(-40.0, -40.0), max: Plan::new(40.0, 40.0) };
        let decals = Decals::new(&stage.draw_list, &terrain, settings, false, &|_| {});
        at.map(|[x, y]| {
            let mut shares = Shares::default();
            decals.cover(&PlanPixel { at: Plan::new(x, y), steps: [DVec2::X, -DVec2::Y] }, &mut shares);
            shares.found().to_vec()
        })
    }

    const SQUARE: &str = "features = [{ polygon = [[0, 0], [10, 0], [10, 10], [0, 10]] }]\n";

    fn settings(grid: u32) -> Settings {
        Settings { grid, leaf_capacity: 1, joins: crate::decal::Joins::Style, ..Settings::default() }
    }

    #[test]
    fn a_fill_covers_what_its_nearest_edge_leaves_of_a_pixel() {
        let fill = format!("{SQUARE}fill = {{ color = \"#000000\" }}");
        // Beside an edge, inside of it, near two of them, in the middle, in another leaf than that of the first cell that it reaches; beside it all.
        let at = [[10.25, 5.0], [9.75, 5.0], [9.75, 9.0], [5.0, 5.0], [7.6, 9.75], [10.5, 5.0], [12.0, 5.0]];
        for grid in [1, 7] {
            let found = covered(&fill, &settings(grid), at);
            assert_eq!(found[..5].concat(), [0.25, 0.75, 0.75, 1.0, 0.75].map(|share| (0, share)), "{grid}");
            assert!(found[5..].iter().all(Vec::is_empty), "{grid}");
        }
        // The line of an edge that ends 2 m away says nothing.
        let angle = "features = [{ polygon = [[0, 0], [10, 0], [10, 4], [6, 4], [6, 10], [0, 10]] }]\nfill = { color = \"#000000\" }";
        assert!(covered(angle, &settings(1), [[9.8, 6.0]])[0].is_empty());
    }

    #[test]
    fn outside_is_the_rest_and_an_outline_that_is_cut_has_no_more_than_its_side() {
        let inverted = format!("{SQUARE}fill = {{ color = \"#000000\", invert = true }}");
        assert_eq!(covered(&inverted, &settings(3), [[9.75, 5.0], [30.0, 5.0]]), [[(0, 0.25)], [(0, 1.0)]]);
        for (mode, share) in [("inset", 0.75), ("offset", 0.25), ("normal", 1.0)] {
            let outline =
                format!("{SQUARE}outline = {{ color = \"#000000\", width_m = 2.0, mode = \"{mode}\" }}");
            assert_eq!(covered(&outline, &settings(3), [[9.75, 5.0]]), [[(0, share)]], "{mode}");
        }
    }

    #[test]
    fn of_a_lines_segments_the_one_that_covers_most_counts() {
        let line = "features = [{ line = [[0, 0], [10, 0], [10, 10]] }]\nline = { color = \"#000000\", width_m = 2.0 }";
        let found = covered(line, &settings(2), [[5.0, 0.75], [9.5, 0.75], [10.75, 5.0]]);
        assert_eq!(found, [[(0, 0.75)], [(0, 1.0)], [(0, 0.75)]]);
    }
}
