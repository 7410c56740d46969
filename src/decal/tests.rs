//! Points of several cells that are looked up together.

use super::{Decals, Hit, Hits, LookupCounts, Overlaps, Palette, Settings};
use crate::resolve::Compositor;
use crate::scene::{BlendMode, Compositing};
use crate::scene_file::SceneFile;
use crate::space::{Plan, PlanBox};
use crate::stage::Stage;

/// What holds some points, as items and the bits of the points. Four cells of 5 m: one has a triangle, item 0; a strip, item 1, and a line, item 2, are in
/// both northern ones; the south-eastern one is empty.
fn found(settings: &Settings, points: &[[f64; 2]]) -> Vec<(u32, u64)> {
    let text = "schema = 1\ncamera = { eye = [0, -90, 90], target = [0, 0, 0] }\n\
                terrain = { generate = { kind = \"plane\", posts = [9, 9], cell_m = 10 } }\n[[layer]]\n\
                features = [{ polygon = [[0, 0], [1, 0], [0, 1]] }, { polygon = [[0, 5.2], [10, 5.2], [10, 10], [0, 10]] }]\n\
                fill = { color = \"#000000\", opacity = 0.5 }\n[[layer]]\nfeatures = [{ line = [[2, 7], [8, 7]] }]\n\
                line = { color = \"#ff0000\", opacity = 0.5, width_m = 1.0 }\n";
    let (scene, surface) =
        crate::source::load::load(&SceneFile::parse(text, None, &[]).unwrap(), &|_| {}).unwrap();
    let stage = Stage::new(scene, surface).unwrap();
    let terrain = PlanBox { min: Plan::new(-40.0, -40.0), max: Plan::new(40.0, 40.0) };
    let settings = Settings { grid: 2, ..*settings };
    let decals = Decals::new(&stage.draw_list, &terrain, &settings, false, &|_| {});
    let palette = Palette::new(&stage.draw_list, Compositor::new(Compositing::default()), BlendMode::Over);
    let points: Vec<Plan> = points.iter().map(|[x, y]| Plan::new(*x, *y)).collect();
    let mut hits = Hits::default();
    decals.find(&points, &palette, &mut hits, &mut LookupCounts::default());
    hits.found().iter().map(|Hit { item, samples }| (*item, *samples)).collect()
}

#[test]
fn points_on_both_sides_of_a_cells_border_are_each_looked_up_in_their_own_cell() {
    let once = Settings::default();
    // From the empty cell into the strip, and the other way; within a cell; outside of the grid; from a cell to one that is not beside it.
    assert_eq!(found(&once, &[[7.0, 4.9], [7.0, 5.3]]), [(1, 0b10)]);
    assert_eq!(found(&once, &[[7.0, 5.3], [7.0, 4.9], [f64::INFINITY, 0.0]]), [(1, 0b1)]);
    assert_eq!(found(&once, &[[7.0, 5.1], [7.0, 5.3]]), [(1, 0b10)]);
    assert_eq!(found(&once, &[[11.0, 6.0], [9.0, 6.0]]), [(1, 0b10)]);
    assert_eq!(found(&once, &[[0.2, 0.2], [9.0, 9.0]]), [(1, 0b10), (0, 0b1)]);
    assert!(found(&once, &[[7.0, 4.0], [7.0, 4.5]]).is_empty());
}

#[test]
fn an_item_of_two_cells_is_found_once_unless_its_segments_count_each() {
    let points = [[4.9, 7.0], [5.1, 7.0], [4.8, 9.0]];
    assert_eq!(found(&Settings::default(), &points), [(2, 0b011), (1, 0b111)]);
    let double = Settings { overlaps: Overlaps::Double, ..Settings::default() };
    assert_eq!(found(&double, &points), [(2, 0b001), (2, 0b010), (1, 0b101), (1, 0b010)]);
}
