//! The lines of a frame against a cut of each line at each triangle of the mesh in use, in rational arithmetic.

use super::Prepare;
use super::grid_map::GridMap;
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

/// Lines over, along and around the seam and the poles of a globe whose outermost rows are half a cell from them.
const GLOBE: &str = r##"
schema = 1
plan = "globe"
image = { width = 64, height = 48 }
camera = { eye_geo = [0, 0, 9e6], target_geo = [0, 0, 0] }
terrain = { generate = { kind = "fbm", seed = 3, posts = [144, 72], cell_deg = 2.5, height_m = 90000 }, diagonal = "alternating", lod = { error_px = 1.0 } }
[[layer]]
features = [
  { line = [[-170, -60], [-13, 7.7], [-12, 9.3], [150, -34], [-160, 65]] },
  { line = [[-200, 12.5], [-170, 12.5], [-150, 12.5]] },
  { line = [[40, 70], [40, 90], [-95, 90], [-95, 60]] },
  { line = [[-180, -80], [180, -80]] },
  { polygon = [[170, -10], [-170, -12], [-168, 14], [171, 9]] },
]
line = { color = "#ff0000", width_m = 50000 }
fill = { color = "#00ff00" }
"##;

fn stage(text: &str, changes: &[&str]) -> Stage {
    let changes: Vec<Override> = changes.iter().map(|change| Override::parse(change).unwrap()).collect();
    let file = SceneFile::parse(text, None, &changes).unwrap();
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

/// The length in space of each line in each triangle of the mesh, by the corners' posts; what runs along an edge lies in the triangle east of it, or north.
fn by_brute_force(map: &GridMap, list: &DrawList, mesh: &Mesh) -> BTreeMap<(u32, [[u32; 2]; 3]), f64> {
    let Mesh::Lod(lod) = mesh else { panic!("no levels") };
    let lattice = mesh.lattice().unwrap();
    let mut lengths = BTreeMap::new();
    for id in 0..mesh.triangle_ids() {
        let triangle = lod.right_triangle(id);
        let corners = triangle.corners().map(|post| post.map(i64::from));
        // How far a step from column to column leads in the triangle, and one from row to row.
        let [apex, left, right] = triangle.corners().map(|post| lattice.vertex(post).world.to_vec());
        let leg = |k: usize| [0, 1].map(|axis| (corners[k][axis] - corners[0][axis]) as f64);
        let ([lx, ly], [rx, ry]) = (leg(1), leg(2));
        let area = lx * ry - ly * rx;
        let steps = [
            ((left - apex) * ry - (right - apex) * ly) / area,
            ((right - apex) * lx - (left - apex) * rx) / area,
        ];
        for (item, of) in list.numbered() {
            let chains = match (list.strokes(of), list.centre_lines(of)) {
                ([], []) => list.border(of),
                ([], lines) => lines,
                (strokes, _) => strokes,
            };
            for chain in chains {
                for pair in map.path(list.path_of(chain)).windows(2) {
                    let ends = [pair[0], pair[1]];
                    // Moved by what is next to nothing, as all points are.
                    let moved =
                        ends.map(|[x, y]| [x + 1.0 / 1024.0 / 1024.0, y + 1.0 / 1024.0 / 1024.0 / 1024.0]);
                    let share = share_within(moved, corners).to_f64().value();
                    let [dx, dy] = [0, 1].map(|k| ends[1][k] - ends[0][k]);
                    let length = share * (steps[0] * dx + steps[1] * dy).length();
                    if length > 0.0 {
                        *lengths.entry((item, triangle.corners())).or_insert(0.0) += length;
                    }
                }
            }
        }
    }
    lengths
}

/// Compares the lines of frames with the lines cut at all triangles; lengths may differ by so much.
fn check(stage: &Stage, views: &[ViewFrame], slack: f64) {
    let prepared = Prepare::new(stage).unwrap();
    let lattice = stage.mesh.lattice().unwrap();
    let map = GridMap::new(&lattice);
    for view in views {
        let mesh = stage.mesh_for(view);
        let in_use = MeshInUse::of(&stage.mesh, &mesh).unwrap();
        let overlay = prepared.overlay(&in_use, view);
        let mut found = BTreeMap::new();
        for strip in &overlay.strips {
            for (triangle, points) in &strip.clippings {
                let points = &strip.points[points.start as usize..points.end as usize];
                let steps = points.windows(2).map(|pair| (pair[1] - pair[0]).length());
                *found.entry((strip.item, triangle.corners())).or_insert(0.0) += steps.sum::<f64>();
            }
        }
        let expected = by_brute_force(&map, &stage.draw_list, &mesh);
        assert!(expected.len() > 60, "{}", expected.len());
        // A view may see no line of some quads.
        let is_seen = |corners: &[[u32; 2]; 3]| {
            let quads = in_use.quads(view, 8.0);
            quads.iter().any(|of| corners.iter().all(|corner| of.quad.contains(*corner)))
        };
        for (place, length) in &expected {
            let own = found.get(place).copied().unwrap_or(0.0);
            assert!((own - length).abs() < slack || !is_seen(&place.1), "{place:?}: {own}, not {length}");
        }
        // At a pole a triangle of two corners there is a side, and no triangle of the mesh.
        let is_side = |corners: &[[u32; 2]; 3]| {
            let is_at_pole = |row: u32| {
                let [south, north] = lattice.poles();
                south && row == 0 || north && row as usize + 1 == lattice.size()[1]
            };
            corners.iter().filter(|corner| is_at_pole(corner[1])).count() == 2
        };
        for (place, length) in found.into_iter().filter(|(place, _)| !expected.contains_key(place)) {
            assert!(length < 2.0 * slack || is_side(&place.1), "{place:?}: {length}");
        }
    }
}

#[test]
fn the_lines_of_every_view_are_the_lines_cut_at_the_triangles_in_use() {
    for (lod, count) in [("terrain.lod.error_px=1.0", 4), ("terrain.lod.borrow=0.4", 2)] {
        check(&stage(SCENE, &[lod]), &views()[..count], 1e-3);
    }
}

#[test]
fn on_a_globe_lines_are_cut_at_the_triangles_in_use_across_the_seam_and_up_to_the_poles() {
    let stage = stage(GLOBE, &[]);
    let from = |eye: [f64; 3]| {
        let view = Viewpoint {
            eye: World::from(DVec3::from(eye) * 6_378_137.0),
            target: World::default(),
            up: DVec3::new(0.1, 0.9, 0.4),
            near: 1.0,
            far: f64::INFINITY,
        };
        ViewFrame::perspective(&view, 50.0, (64, 48)).unwrap()
    };
    let views = [from([-2.0, 0.4, 0.5]), from([0.3, -0.2, 2.5]), from([0.5, 0.3, -1.8])];
    check(&stage, &views, 1.0);
    // Lines go on to the pole, and a line that crosses the seam is whole there: in both views its parts meet.
    let prepared = Prepare::new(&stage).unwrap();
    let mesh = stage.mesh_for(&views[1]);
    let overlay = prepared.overlay(&MeshInUse::of(&stage.mesh, &mesh).unwrap(), &views[1]);
    let pole = DVec3::Z * stage.scene.globe.unwrap().ellipsoid.b();
    let reach = overlay.strips.iter().flat_map(|strip| &strip.points);
    let nearest =
        reach.map(|at| (at.to_vec() - pole).truncate().length()).fold(f64::INFINITY, crate::math::min);
    assert!(nearest < 1.0, "{nearest}");
}
