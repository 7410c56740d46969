//! Cases 1 to 8: planes that clip, eyes in odd places, the horizon.

use super::artifact::{Artifact, Variant};
use super::case::Case;
use super::figure::Figure;
use super::hand::{Hand, worst};
use super::machine::DEPTHS;
use super::picture::{Picture, stray};
use super::setup::{HILLS, PLANE, Setup, line, lines, polygon, square, stroke};
use crate::error::Result;
use crate::math;
use crate::technique::Kind;

pub(super) const CASES: &[Case] = &[
    Case::new(1, "A volume cut by the near plane", &[Kind::StencilVolume], (|| near(0.0, "0.01", LENSES[0]), near_plane))
        .told("cesium#2618, #6461, #9108", "The mask of point samples, for every near plane that cuts no terrain.")
        .on(DEPTHS)
        .known(&[Artifact::of_machines(
            Kind::StencilVolume,
            "Z-fighting where a wall passes by the eye: depths of volumes and terrain are as coarse as the buffer's (Schneider & Klein 2007, 4.2).",
        )])
        .trying(&[Variant::known(
            Kind::StencilVolume,
            &["technique.stencil-volume.method=z-pass"],
            "z-pass fails with the eye or the near plane in a volume (Schneider & Klein 2007, 4.2.1).",
        )]),
    Case::new(2, "The far plane clips the volume", &[Kind::StencilVolume], (far, far_plane))
        .told("cesium#4930, #4483", "The mask does not depend on the far plane where the terrain is nearer.")
        .on(DEPTHS)
        .trying(&[Variant::known(
            Kind::StencilVolume,
            &["technique.stencil-volume.far=clip", "technique.stencil-volume.method=z-fail"],
            "Without a matrix whose far plane is infinite, z-fail loses faces (Schneider & Klein 2007, 4.2.1).",
        )]),
    Case::new(3, "The prism misses the terrain", &[Kind::StencilVolume], (prism, misses))
        .told("cesium#4161, #8436, #7092", "From straight above, heights change nothing."),
    Case::new(4, "An end point behind the eye", &[Kind::GeometryOverlay, Kind::DynamicLine], (|| behind(8.0), behind_the_eye))
        .told("cesium#13594", "The line is clipped, then stroked; it is never mirrored."),
    Case::new(5, "The camera under the ground", &Kind::ALL, (|| under(None), |hand| hand.against_truth(&under(hand.kind()), &[])))
        .told("osgearth PR#461", "The surface has two sides: the truth.")
        .known(&[Artifact::of(
            Kind::GeometryOverlay,
            "Draws the outlines of polygons, not their insides (Wartell et al. 2003, 3).",
        ),
        Artifact::of(
            Kind::Clipmap,
            "Where the surface is seen at a slant the filter reaches over several pixels: \"noticeably overblurred\" (Taibo et al. 2014, 2).",
        )]),
    Case::new(6, "Seen through the globe", &[Kind::Clipmap, Kind::StencilVolume], (equator, through_the_globe))
        .told("cesium#7618", "What lies on the far side covers nothing."),
    Case::new(7, "Dashes near the horizon", &[Kind::Clipmap, Kind::InverseProjection, Kind::StencilVolume, Kind::StaticDecal], (horizon, thin_lines))
        .told("maplibre#8328", "Lines across are 0.1774, 0.0443 and 0.0111 pixels thick; that much of each column is covered.")
        .known(&[
            Artifact::of(Kind::Clipmap, "Lines thinner than a texel of the level that is read come and go without prefiltering (Taibo et al. 2014, 3)."),
            Artifact::of(Kind::InverseProjection, "n x n samples miss lines thinner than their spacing; \"intermittence\" (She 2016, 2 and Fig. 1)."),
            Artifact::of(Kind::StencilVolume, "One sample a pixel: \"aliasing and intermittence in pixel scale\" (She 2016, Fig. 1c, of stencil volumes)."),
            Artifact::of(Kind::StaticDecal, "Eight samples a pixel miss lines thinner than their spacing (Zechmeister 2020, 3.5)."),
        ])
        .trying(&[
            Variant::right(Kind::Clipmap, &["technique.clipmap.polygons=exact", "technique.clipmap.joints=style", "technique.clipmap.overlaps=once", "technique.clipmap.threshold_texels=0", "technique.clipmap.anisotropy=64"]),
            Variant::right(Kind::StaticDecal, &["technique.static-decal.edges=analytic"]),
        ]),
    Case::new(8, "Culled by bounds without the terrain's height", &Kind::ALL, (|| plateau(3000.0, None), culled))
        .told("QGIS#48295", "A plateau at 3000 m has the picture of one at 0 m."),
];

const LENSES: [&str; 2] = ["fov_y_deg = 60.0", "projection = \"orthographic\", height_m = 30.0"];

/// A square of 20 m over a ridge, which makes its volume higher than the eye: 1 m up, so far beyond its eastern wall.
fn near(offset: f64, near_m: &str, lens: &str) -> Setup {
    let camera =
        format!("eye = [{:?}, 3.0, 5.5], target = [4.0, 9.0, 2.0], near_m = {near_m}, {lens}", 10.0 + offset);
    let terrain = "kind = \"tent\", posts = [41, 41], cell_m = 5.0, height_m = 6.0, radius_m = 12.0";
    Setup::new([64, 64], terrain, &camera, &polygon(&square([0.0, 0.0], 20.0), ""))
}

fn near_plane(hand: &Hand) -> Result<Vec<Figure>> {
    if hand.kind().is_none() {
        return hand.against_truth(&near(0.0, "0.01", LENSES[0]), &[]);
    }
    let points = hand.by(Kind::StaticDecal, &["technique.static-decal.samples=1"]);
    let mut figures = Vec::new();
    for lens in LENSES {
        for offset in [0.0, 1e-6, -1e-6, 1.0, -1.0] {
            for near_m in ["0.01", "0.2", "0.5"] {
                let setup = near(offset, near_m, lens);
                figures.push(hand.same(&hand.draw(&setup, &[])?, &points.draw(&setup, &[])?));
            }
        }
    }
    Ok(worst(figures))
}

/// A field and a road over grey hills: the sky is black.
fn far() -> Setup {
    let layers = polygon("[-150, -150], [120, -180], [60, 20], [160, 150], [-120, 90]", "")
        + &line("[-280, -200], [0, 100], [250, -60], [300, 280]", 12.0, "");
    let hills = Setup::new([96, 64], HILLS, "eye = [40, -420, 260], target = [0, 0, 40]", &layers);
    Setup { text: hills.text.replace("color = \"#000000\" }", "color = \"#404040\" }"), ..hills }
}

fn far_plane(hand: &Hand) -> Result<Vec<Figure>> {
    let (cut, mut whole) = (hand.draw(&far(), &["camera.far_m=520"])?, hand.draw(&far(), &[])?);
    // What the far plane has made sky is not asked, nor what lies beside it.
    let seen = hand.truth(&far(), &["camera.far_m=520"])?;
    let is_sky = |k: usize| seen.around(k, 1).any(|other| seen.values[other][0] < 0.24);
    for k in (0..whole.values.len()).filter(|k| is_sky(*k)) {
        whole.values[k] = cut.values[k];
    }
    Ok(hand.same(&cut, &whole))
}

fn prism() -> Setup {
    let camera = "eye = [0, 0, 5000], target = [0, 0, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = 500.0";
    let field = polygon("[-150, -150], [120, -180], [160, 20], [50, 150], [-120, 90]", "");
    Setup::new([96, 64], "kind = \"tent\", posts = [41, 41], cell_m = 20.0, height_m = 500.0", camera, &field)
}

fn misses(hand: &Hand) -> Result<Vec<Figure>> {
    let flat = hand.draw(&prism(), &["terrain.vertical_scale=0"])?;
    let of = |change: &&str| Ok(hand.same(&hand.draw(&prism(), &[change])?, &flat));
    let changes = [
        "terrain.vertical_scale=1",
        "terrain.vertical_scale=1.25",
        "terrain.vertical_scale=5",
        "terrain.generate.height_m=-430",
    ];
    Ok(worst(changes.iter().map(of).collect::<Result<Vec<_>>>()?))
}

/// A line that passes the eye, so many pixels wide.
fn behind(width_px: f64) -> Setup {
    let terrain = "kind = \"plane\", posts = [41, 41], cell_m = 60.0";
    let style = format!("width_px = {width_px:?}");
    let line = lines("[0, 10], [3, -1000]", &style);
    Setup::new([96, 64], terrain, "eye = [1, -100, 12], target = [0, 60, 0], near_m = 1", &line)
}

fn behind_the_eye(hand: &Hand) -> Result<Vec<Figure>> {
    let of = |width: f64| -> Result<Vec<Figure>> {
        let (drawn, right) = (hand.draw(&behind(width), &[])?, hand.truth(&behind(width), &[])?);
        Ok(vec![
            Figure::none("stray pixels", stray(&drawn, &right)),
            Figure::at_least(0.5, "covered, of what is right", drawn.covered() / right.covered()),
        ])
    };
    Ok(worst([of(1.0)?, of(8.0)?]))
}

/// Hills from 10 m below them.
fn under(kind: Option<Kind>) -> Setup {
    let layers = polygon("[-150, -150], [120, -180], [60, 20], [160, 150], [-120, 90]", "")
        + &stroke(kind, "[-280, -200], [0, 100], [250, -60], [300, 280]", 12.0, 8.0);
    Setup::new([96, 64], HILLS, "eye = [0, -60, -10], target = [10, 40, 60], near_m = 0.5", &layers)
}

/// The whole equator, from a height of two radii.
fn equator() -> Setup {
    let camera = "eye_geo = [0, 0, 12756274], target_geo = [0, 0, 0]";
    Setup::globe(camera, &line("[-180, 0], [180, 0]", 400_000.0, ""))
}

fn through_the_globe(hand: &Hand) -> Result<Vec<Figure>> {
    let far_side = ["layer.0.features=[{ line = [[85, 0], [180, 0], [275, 0]] }]"];
    let hidden = hand.draw(&equator(), &far_side)?;
    let mut figures = hand.against_truth(&equator(), &[])?;
    figures.push(Figure::at_most(1e-6, "covered by the hidden part, pixels", hidden.covered()));
    Ok(figures)
}

/// Distances of lines across.
const DISTANCES: [f64; 3] = [500.0, 1000.0, 2000.0];

/// Lines of 2 m across at 500, 1000 and 2000 m, the eye 100 m up, looking level; 256 rows of a field of view of 60 degrees.
fn horizon() -> Setup {
    let all = DISTANCES.map(|d| format!("[-4000, {d:?}], [4000, {d:?}]")).join(";");
    let terrain = "kind = \"plane\", posts = [3, 3], cell_m = 20000.0";
    let camera = "eye = [0, 0, 100], target = [0, 1000, 100], fov_y_deg = 60, near_m = 1, far_m = 1e5";
    Setup::new([32, 256], terrain, camera, &line(&all, 2.0, ""))
}

fn thin_lines(hand: &Hand) -> Result<Vec<Figure>> {
    let drawn = hand.draw(&horizon(), &[])?;
    let focal = 128.0 / math::tan(30f64.to_radians());
    let most = if hand.kind().is_none() { 1e-6 } else { 0.25 };
    let off = DISTANCES.map(|d| {
        let right = focal * 100.0 * (1.0 / (d - 1.0) - 1.0 / (d + 1.0));
        // The rows between those of neighbouring lines.
        let row = |distance: f64| 128.0 + focal * 100.0 / distance;
        let rows = row(d * 1.4) as usize..row(d / 1.4) as usize;
        let sum: f64 = rows.flat_map(|y| (0..32).map(move |x| (x, y))).map(|(x, y)| drawn.shade(x, y)).sum();
        (sum / 32.0 - right).abs() / right
    });
    let names = ["off at 500 m, of the thickness", "off at 1000 m", "off at 2000 m"];
    Ok(names.iter().zip(off).map(|(name, off)| Figure::at_most(most, name, off)).collect())
}

/// A plateau with a field and a road.
fn plateau(height: f64, kind: Option<Kind>) -> Setup {
    let layers = polygon("[-50.3, -40.1], [45.7, -30.2], [20.4, 35.6]", "")
        + &stroke(kind, "[-70.2, 40.7], [75.3, 10.1]", 7.0, 4.0);
    let camera = format!("eye = [5, -150, {:?}], target = [0, 0, {height:?}]", height + 90.0);
    Setup::new([64, 64], &format!("{PLANE}, height_m = {height:?}"), &camera, &layers)
}

fn culled(hand: &Hand) -> Result<Vec<Figure>> {
    let drawn: Picture = hand.draw(&plateau(3000.0, hand.kind()), &[])?;
    let mut figures = hand.same(&drawn, &hand.draw(&plateau(0.0, hand.kind()), &[])?);
    figures.push(Figure::at_least(100.0, "covered, pixels", drawn.covered()));
    Ok(figures)
}
