//! The figures of `docs/tour.md` are what the program draws, bit for bit.
#![cfg(feature = "render")]

mod drawing;

use drapery::compare::{Difference, Image};
use drapery::output::{Npy, look, write_png};
use drapery::technique::{Frame, Kind};
use drapery::{buffer::Buffer, measure};
use drawing::{frame_of, stage, truth_of};
use std::path::{Path, PathBuf};

type Picture = Buffer<[u8; 4]>;

/// A part of a figure: a picture of the tour's scene with changes.
struct Panel {
    changes: &'static [&'static str],
    shown: Shown,
    /// Left, top, columns and rows of what is shown of it; `None`: all.
    window: Option<[usize; 4]>,
    /// Each pixel is so many pixels wide and high.
    scale: usize,
}

enum Shown {
    Truth,
    Picture(Kind),
    /// A buffer, as people look at it.
    Plane(Kind, &'static str),
    /// How far a technique is from the truth.
    Heat(Kind),
}

use Shown::{Heat, Picture as Drawn, Plane, Truth as Right};

const fn whole(shown: Shown) -> Panel {
    changed(&[], shown)
}

const fn changed(changes: &'static [&'static str], shown: Shown) -> Panel {
    Panel { changes, shown, window: None, scale: 2 }
}

/// Where the road comes over the hill.
const fn close(changes: &'static [&'static str], shown: Shown) -> Panel {
    Panel { changes, shown, window: Some([96, 38, 24, 16]), scale: 12 }
}

const IN_PIXELS: &[&str] = &[
    "layer.road.line.width_m=",
    "layer.road.line.width_px=4.0",
    "layer.track.line.width_m=",
    "layer.track.line.width_px=2.0",
];
const FEW: &[&str] = &["terrain.generate.posts=[33, 33]", "terrain.generate.cell_m=48.0"];
const COARSE: &[&str] = &["terrain.lod={ error_px = 2.0 }"];
const ONE: &[&str] = &["technique.stencil-volume.samples=1"];
/// Without shading, whose steps from triangle to triangle one sample a pixel does not have.
const FLAT: &[&str] = &["terrain.shade=", "technique.stencil-volume.samples=1"];
const FINE: &[&str] = &["technique.clipmap.virtual_size=4096", "technique.clipmap.clip_size=1024"];

/// Each figure of the tour, in two parts.
const FIGURES: [(&str, [Panel; 2]); 10] = [
    (
        "triangles",
        [changed(FEW, Plane(Kind::StaticDecal, "triangle")), changed(FEW, Plane(Kind::StaticDecal, "plan"))],
    ),
    ("truth", [whole(Right), whole(Plane(Kind::StaticDecal, "id"))]),
    ("pixels", [close(ONE, Drawn(Kind::StencilVolume)), close(&[], Right)]),
    ("clipmap", [changed(FINE, Drawn(Kind::Clipmap)), changed(FINE, Plane(Kind::Clipmap, "level"))]),
    (
        "stencil-volume",
        [changed(ONE, Drawn(Kind::StencilVolume)), changed(ONE, Plane(Kind::StencilVolume, "overdraw"))],
    ),
    (
        "inverse-projection",
        [whole(Drawn(Kind::InverseProjection)), whole(Plane(Kind::InverseProjection, "class"))],
    ),
    ("static-decal", [whole(Drawn(Kind::StaticDecal)), whole(Plane(Kind::StaticDecal, "nodes"))]),
    (
        "dynamic-line",
        [
            changed(IN_PIXELS, Drawn(Kind::DynamicLine)),
            changed(IN_PIXELS, Plane(Kind::DynamicLine, "list-length")),
        ],
    ),
    (
        "geometry-overlay",
        [
            changed(COARSE, Drawn(Kind::GeometryOverlay)),
            changed(COARSE, Plane(Kind::GeometryOverlay, "layer")),
        ],
    ),
    ("errors", [changed(FLAT, Heat(Kind::InverseProjection)), changed(FLAT, Heat(Kind::StencilVolume))]),
];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/tour")
}

fn drawn(panel: &Panel, scene: &str) -> Picture {
    let stage = stage(scene, panel.changes);
    let frame = |kind, buffers: &[&str]| -> Frame { frame_of(kind, &stage, buffers) };
    match panel.shown {
        Right => truth_of(&stage).image(),
        Drawn(kind) => frame(kind, &[]).image,
        Plane(kind, name) => {
            let frame = frame(kind, &[name]);
            let how = kind.declaration().planes.iter().find(|plane| plane.name == name).unwrap().look;
            look(Npy::new(&frame.planes[0]).unwrap(), how).unwrap()
        }
        Heat(kind) => {
            let image = Image::from_rgba8(&frame(kind, &[]).image).unwrap();
            Difference::of(&measure::expected(&truth_of(&stage)).unwrap(), &image)
                .unwrap()
                .heat_map(1.0 / 255.0)
        }
    }
}

/// A panel's window, its pixels made large.
fn enlarged(panel: &Panel, picture: &Picture) -> Picture {
    let [left, top, columns, rows] = panel.window.unwrap_or([0, 0, picture.width(), picture.height()]);
    let (width, height) = (columns * panel.scale, rows * panel.scale);
    let at = |k: usize| *picture.at(left + k % width / panel.scale, top + k / width / panel.scale);
    Buffer::from_values(width, height, (0..width * height).map(at).collect())
}

/// Two pictures of one height, a gap between them.
fn beside([left, right]: [Picture; 2]) -> Picture {
    const GAP: usize = 8;
    let rows = (0..left.height()).flat_map(|y| [left.row(y), &[[255; 4]; GAP][..], right.row(y)].concat());
    Buffer::from_values(left.width() + GAP + right.width(), left.height(), rows.collect())
}

#[test]
fn the_figures_of_the_tour_are_what_is_drawn() {
    let scene = std::fs::read_to_string(folder().join("tour.toml")).unwrap();
    let fresh = Path::new(env!("CARGO_TARGET_TMPDIR")).join("tour");
    let mut stale = Vec::new();
    for (name, panels) in &FIGURES {
        let figure = beside(panels.each_ref().map(|panel| enlarged(panel, &drawn(panel, &scene))));
        let stored = Image::read(&folder().join(format!("{name}.png")));
        let expected = Image::from_rgba8(&figure).unwrap();
        if stored.map_or(true, |stored| stored != expected) {
            std::fs::create_dir_all(&fresh).unwrap();
            let mut file = std::fs::File::create(fresh.join(format!("{name}.png"))).unwrap();
            write_png(&figure, &mut file).unwrap();
            stale.push(*name);
        }
    }
    assert!(
        stale.is_empty(),
        "{stale:?} are drawn otherwise: look at them in {}, and copy them",
        fresh.display()
    );
}
