//! The lines of a frame against a cut of each line at each triangle of the mesh in use, in rational arithmetic.

use super::Prepare;
use super::mesh::MeshInUse;
use crate::draw_list::DrawList;
use crate::scene_file::{Override, SceneFile};
use crate::space::Viewpoint;
use crate::space::{ViewFrame, World};
use crate::stage::Stage;
use crate::terrain::Mesh;
use dashu::rational::RBig;
use glam::DVec3;
use std::collections::BTreeMap;

/// Twisted lines over 200 x 170 posts with a hole, one along a row of posts and one along a diagonal: the cells are 8 m wide, so that the posts' coordinates are exact.
const SCENE: &str = r##"
schema = 1
image = { width = 64, height = 48 }
camera = { eye = [0, -900, 500], target = [0, 0, 0] }
terrain = { generate = { kind = "fbm", seed = 3, posts = [201, 171], cell_m = 8, height_m = 260 }, diagonal = "alternating", lod = { error_px = 1.0 } }
[[layer]]
features = [
  { line = [[-700, -610], [-130, 77], [-121, 93], [250, -340], [771, 655]] },
  { line = [[-900, 200], [900, 231], [-900, 260]] },
  { line = [[-640, -80], [640, -80]] },
  { line = [[-512, -512], [512, 512]] },
  { polygon = [[-300, 300], [10, 420], [33, 80], [-280, 111]] },
]
line = { color = "#ff0000", width_px = 1 }
fill = { color = "#00ff00" }
"##;

fn stage(changes: &[&str]) -> Stage {
    let changes: Vec<Override> = changes.iter().map(|change| Override::parse(change).unwrap()).collect();
    let file = SceneFile::parse(SCENE, None, &changes).unwrap();
    let (scene, surface) = crate::source::load::load(&file, &|_| {}).unwrap();
    Stage::new(scene, surface).unwrap()
}

fn views() -> Vec<ViewFrame> {
    let from = |eye: [f64; 3], target: [f64; 3]| {
        let [eye, target] = [eye, target].map(|[x, y, z]| World::new(x, y, z));
        let view = Viewpoint { eye, target, up: DVec3::new(0.1, 0.9, 0.4), near: 1.0, far: f64::INFINITY };
        ViewFrame::perspective(&view, 60.0, (64, 48)).unwrap()
    };
    vec![
        from([0.0, -900.0, 500.0], [0.0, 0.0, 0.0]),
        from([-500.0, -300.0, 300.0], [100.0, 40.0, 80.0]),
        from([90.0, 60.0, 2500.0], [0.0, 0.0, 0.0]),
        from([700.0, 500.0, 260.0], [-100.0, -40.0, 60.0]),
    ]
}

/// How long a segment is within a triangle, in shares of the segment.
fn share_within(segment: [[f64; 2]; 2], corners: [[i64; 2]; 3]) -> RBig {
    let exact = |v: f64| RBig::try_from(v).unwrap();
    let (mut from, mut to) = (RBig::ZERO, RBig::ONE);
    for k in 0..3 {
        let [a, b] = [corners[k], corners[(k + 1) % 3]];
        let [dx, dy] = [0, 1].map(|axis| RBig::from(b[axis] - a[axis]));
        let side =
            |[x, y]: [f64; 2]| &dx * (exact(y) - RBig::from(a[1])) - &dy * (exact(x) - RBig::from(a[0]));
        let [start, end] = segment.map(side);
        match (start >= RBig::ZERO, end >= RBig::ZERO) {
            (true, true) => {}
            (false, false) => return RBig::ZERO,
            (true, false) => to = to.min(&start / (&start - &end)),
            (false, true) => from = from.max(&start / (&start - &end)),
        }
    }
    if to > from { to - from } else { RBig::ZERO }
}

/// The length of each line in each triangle of the mesh, by the corners' posts; what runs along an edge lies in the triangle east of it, or north.
fn by_brute_force(prepared: &Prepare, list: &DrawList, mesh: &Mesh) -> BTreeMap<(u32, [[u32; 2]; 3]), f64> {
    let Mesh::Lod(lod) = mesh else { panic!("no levels") };
    let mut lengths = BTreeMap::new();
    for id in 0..mesh.triangle_ids() {
        let triangle = lod.right_triangle(id);
        let corners = triangle.corners().map(|post| post.map(i64::from));
        for (item, of) in list.numbered() {
            let chains = if list.strokes(of).is_empty() { list.border(of) } else { list.strokes(of) };
            for chain in chains {
                for pair in list.path_of(chain).windows(2) {
                    let ends = [pair[0], pair[1]].map(|at| prepared.map.grid_from_plan(at));
                    // Moved by what is next to nothing, as all points are.
                    let moved =
                        ends.map(|[x, y]| [x + 1.0 / 1024.0 / 1024.0, y + 1.0 / 1024.0 / 1024.0 / 1024.0]);
                    let share = share_within(moved, corners).to_f64().value();
                    let [dx, dy] = [0, 1].map(|k| ends[1][k] - ends[0][k]);
                    let length = share * (dx * dx + dy * dy).sqrt();
                    if length > 1e-4 {
                        *lengths.entry((item, triangle.corners())).or_insert(0.0) += length;
                    }
                }
            }
        }
    }
    lengths
}

#[test]
fn the_lines_of_every_view_are_the_lines_cut_at_the_triangles_in_use() {
    for (lod, count) in [("terrain.lod.error_px=1.0", 4), ("terrain.lod.borrow=0.4", 2)] {
        let stage = stage(&[lod]);
        let prepared = Prepare::new(&stage).unwrap();
        for view in &views()[..count] {
            let mesh = stage.mesh_for(view);
            let in_use = MeshInUse::of(&stage.mesh, &mesh).unwrap();
            let overlay = prepared.overlay(&in_use, view);
            let mut found = BTreeMap::new();
            for strip in &overlay.strips {
                for (triangle, points) in &strip.clippings {
                    let points = &strip.points[points.start as usize..points.end as usize];
                    let steps =
                        points.windows(2).map(|pair| (pair[1].plan() - pair[0].plan()).length() / 8.0);
                    *found.entry((strip.item, triangle.corners())).or_insert(0.0) += steps.sum::<f64>();
                }
            }
            let expected = by_brute_force(&prepared, &stage.draw_list, &mesh);
            assert!(expected.len() > 100, "{}", expected.len());
            for (place, length) in &expected {
                let own = found.get(place).copied().unwrap_or(0.0);
                assert!((own - length).abs() < 1e-4, "{place:?}: {own}, not {length}");
            }
            for (place, length) in found.into_iter().filter(|(place, _)| !expected.contains_key(place)) {
                assert!(length < 2e-4, "{place:?}: {length}");
            }
        }
    }
}
