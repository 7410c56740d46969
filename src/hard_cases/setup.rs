//! Scenes of cases: white features on black ground under a black sky, unless they say otherwise, so that a pixel's shade is what is covered.

use crate::scene::{Scene, Surface};
use crate::technique::Kind;
use std::fmt::Write;

/// A scene as a text, and a surface that the text cannot say.
#[derive(Debug, Clone)]
pub(super) struct Setup {
    /// The scene file.
    pub(super) text: String,
    /// The terrain, in place of the text's.
    pub(super) surface: Option<Surface>,
    /// What the text cannot say of the scene.
    pub(super) edit: Option<fn(&mut Scene)>,
}

/// Looking straight down on 128 m, north up.
const DOWN: &str =
    "eye = [0, 0, 500], target = [0, 0, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = 128.0";
/// A plane of 512 m.
pub(super) const PLANE: &str = "kind = \"plane\", posts = [5, 5], cell_m = 128.0";
/// Hills of 640 m.
pub(super) const HILLS: &str = "kind = \"fbm\", seed = 3, posts = [65, 65], cell_m = 10.0, height_m = 120.0";

impl Setup {
    /// A scene over generated terrain, with layers and other tables.
    pub(super) fn new([width, height]: [u32; 2], terrain: &str, camera: &str, more: &str) -> Self {
        let text = format!(
            "schema = 1\nimage = {{ width = {width}, height = {height}, background = \"#000000\" }}\n\
             terrain = {{ generate = {{ {terrain} }}, color = \"#000000\" }}\ncamera = {{ {camera} }}\n{more}"
        );
        Self { text, surface: None, edit: None }
    }

    /// 128 m of a plane from straight above, a metre a pixel.
    pub(super) fn map(layers: &str) -> Self {
        Self::new([128, 128], PLANE, DOWN, layers)
    }

    /// The same of so many metres, in so many pixels.
    pub(super) fn map_of(metres: f64, pixels: u32, layers: &str) -> Self {
        let camera = DOWN.replace("128.0", &format!("{metres:?}"));
        let terrain = format!("kind = \"plane\", posts = [3, 3], cell_m = {:?}", 2.0 * metres);
        Self::new([pixels, pixels], &terrain, &camera, layers)
    }

    /// On a globe, smooth, in cells of five degrees.
    pub(super) fn globe(camera: &str, layers: &str) -> Self {
        let world = "kind = \"plane\", posts = [73, 37], cell_deg = 5";
        let flat = Self::new([64, 64], world, camera, layers);
        Self { text: format!("plan = \"globe\"\n{}", flat.text), ..flat }
    }

    /// The terrain moved to the north-east; the text's own coordinates are where they are.
    pub(super) fn moved(self, by: f64) -> Self {
        let offset = format!("color = \"#000000\", offset = [{by:?}, {by:?}] }}");
        Self { text: self.text.replacen("color = \"#000000\" }", &offset, 1), ..self }
    }

    /// With other keys of the terrain.
    pub(super) fn with_terrain(self, keys: &str) -> Self {
        let keys = format!("color = \"#000000\", {keys} }}");
        Self { text: self.text.replacen("color = \"#000000\" }", &keys, 1), ..self }
    }

    /// With another terrain.
    pub(super) fn over(self, surface: Surface) -> Self {
        Self { surface: Some(surface), ..self }
    }
}

/// A layer of white lines `x y, x y` so many metres wide; several are parted by semicolons.
pub(super) fn line(points: &str, width_m: f64, style: &str) -> String {
    lines(points, &format!("width_m = {width_m:?}, {style}"))
}

/// A layer of white lines with a style.
pub(super) fn lines(points: &str, style: &str) -> String {
    let features: String = points.split(';').map(|one| format!("{{ line = [{one}] }}, ")).collect();
    format!(
        "[[layer]]\nfeatures = [{features}]\nline = {{ color = \"#ffffff\", {} }}\n",
        style.trim_end_matches([',', ' '])
    )
}

/// A layer of white lines as whom they are for draws them: so many metres wide, or so many pixels.
pub(super) fn stroke(kind: Option<Kind>, points: &str, metres: f64, pixels: f64) -> String {
    match kind {
        Some(Kind::DynamicLine) => lines(points, &format!("width_px = {pixels:?}")),
        _ => line(points, metres, ""),
    }
}

/// A layer of one white polygon; rings are parted by semicolons.
pub(super) fn polygon(rings: &str, style: &str) -> String {
    polygons(&format!("{{ polygon = [{}] }}", ring_list(rings)), style)
}

/// A layer of white polygons, features as the scene file has them.
pub(super) fn polygons(features: &str, style: &str) -> String {
    format!("[[layer]]\nfeatures = [{features}]\nfill = {{ color = \"#ffffff\"{style} }}\n")
}

fn ring_list(rings: &str) -> String {
    rings.split(';').map(|ring| format!("[{ring}], ")).collect()
}

/// Points in the words of a scene file.
pub(super) fn points(all: &[[f64; 2]]) -> String {
    let mut text = String::new();
    for [x, y] in all {
        // Writing to a text does not fail.
        let _ = write!(text, "[{x:?}, {y:?}], ");
    }
    text.trim_end_matches(", ").to_owned()
}

/// A square around a place.
pub(super) fn square([x, y]: [f64; 2], side: f64) -> String {
    let half = 0.5 * side;
    points(&[[x - half, y - half], [x + half, y - half], [x + half, y + half], [x - half, y + half]])
}

/// A place so far from another in a direction, degrees from east over north.
pub(super) fn towards([x, y]: [f64; 2], degrees: f64, distance: f64) -> [f64; 2] {
    let angle = degrees.to_radians();
    [x + distance * crate::math::cos(angle), y + distance * crate::math::sin(angle)]
}
