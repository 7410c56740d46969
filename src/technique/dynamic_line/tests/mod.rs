//! Dynamic lines beside rational arithmetic, brute force, and scenes whose pixels are known.

mod border;
mod pictures;
mod shares;
mod updates;

use super::Prepare;
use super::camera::{Camera, P3};
use super::in_line::Fragment;
use crate::buffer::Values;
use crate::scene_file::{Override, SceneFile};
use crate::space::{Lens, Plan, ViewFrame, World};
use crate::stage::Stage;
use crate::technique::{Frame, FrameOptions, Prepared};
use dashu::rational::RBig;

/// Under these settings the pixels of a line are those whose centres its footprint holds.
const EXACT: [&str; 5] = [
    "technique.dynamic-line.simplification=none",
    "technique.dynamic-line.culling=boxes",
    "technique.dynamic-line.boxes=enclosing",
    "technique.dynamic-line.thin_lines=none",
    "technique.dynamic-line.antialiasing=none",
];

/// Pixels of 6.25 m, whose centres are at odd multiples of half as much.
const MAP: &str =
    "eye = [0, 0, 500], target = [0, 0, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = 400";

fn stage(camera: &str, terrain: &str, layers: &str, changes: &[&str]) -> Stage {
    let text = format!(
        "schema = 1\nimage = {{ width = 96, height = 64 }}\ncamera = {{ {camera} }}\n\
         terrain = {{ generate = {{ {terrain} }} }}\n{layers}"
    );
    let changes: Vec<Override> = changes.iter().map(|change| Override::parse(change).unwrap()).collect();
    let file = SceneFile::parse(&text, None, &changes).unwrap();
    let (scene, surface) = crate::source::load::load(&file, &|_| {}).unwrap();
    Stage::new(scene, surface).unwrap()
}

fn line_layer(points: &[[f64; 2]], width: f64) -> String {
    format!(
        "[[layer]]\nfeatures = [{{ line = {points:?} }}]\nline = {{ color = \"#000000\", width_px = {width:?} }}\n"
    )
}

const FLAT: &str = "kind = \"plane\", posts = [33, 33], cell_m = 20";
const HILLS: &str = "kind = \"fbm\", seed = 7, posts = [33, 33], cell_m = 20, height_m = 160";

fn frame(stage: &Stage) -> Frame {
    let buffers = ["list-length".to_owned()];
    let options = FrameOptions { tile: 64, buffers: &buffers, progress: &|_| {} };
    Prepare::new(stage).unwrap().frame(&stage.view().unwrap(), &options).unwrap()
}

/// Whether each pixel is in a line.
fn covered(stage: &Stage) -> Vec<bool> {
    let Values::U32(lengths) = &frame(stage).planes[0].values else { panic!("lengths are counted") };
    lengths.iter().map(|length| *length > 0).collect()
}

/// A surface point of a view.
fn fragment(view: &ViewFrame, at: World) -> Fragment<f64> {
    let point = P3::of(at);
    Fragment { point, pixel: Camera::new(view).pixel_at(point) }
}

/// The footprint by definition in rational numbers.
fn is_in_footprint([from, to]: [Plan; 2], half_px: f64, view: &ViewFrame, at: World) -> bool {
    let exact = |v: f64| RBig::try_from(v).unwrap();
    let minus = |a: f64, b: f64| exact(a) - exact(b);
    let square = |v: &RBig| v.clone() * v;
    let (dx, dy) = (minus(to.x, from.x), minus(to.y, from.y));
    let (ux, uy) = (minus(at.x, from.x), minus(at.y, from.y));
    let length = square(&dx) + square(&dy);
    let along = ux.clone() * &dx + uy.clone() * &dy;
    let share = if length > RBig::ZERO { along / length } else { RBig::ZERO };
    let share = share.clamp(RBig::ZERO, RBig::ONE);
    let distance = square(&(ux - share.clone() * dx)) + square(&(uy - share * dy));
    let (eye, growth) = (view.eye(), exact(half_px * view.lens().pixel()));
    let from_eye = match view.lens() {
        Lens::Parallel { .. } => RBig::ONE,
        Lens::Central { .. } => {
            let [x, y, z] = [(at.x, eye.x), (at.y, eye.y), (at.z, eye.z)].map(|(a, b)| minus(a, b));
            square(&x) + square(&y) + square(&z)
        }
    };
    distance <= square(&growth) * from_eye
}
