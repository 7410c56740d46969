//! The imitated machine draws the pictures at many settings, and reading finds these again.

use super::drawing::{Picture, Rectangle, Way};
use super::pictures::{BAND, BAND_STEPS, pictures};
use super::{KNOWN, changes, read, write_instructions};
use crate::buffer::Buffer;
use crate::canvas::SamplePattern;
use crate::output::{Batch, write_png, write_whole};
use crate::raster::Lattice;
use crate::raster::device::{DepthBuffer, Pipeline, Window};
use crate::scene::{DepthFormat, Device, Diagonal, Interpolation, Posts, Precision, Surface};
use crate::scene_file::{Override, SceneFile};
use crate::space::{Plan, ViewFrame, Viewpoint, World};
use crate::terrain::Mesh;
use glam::{DVec2, DVec3};
use std::path::Path;

const DEVICE: Device = Device {
    precision: Precision::F32,
    position: crate::scene::Positions::Local,
    subpixel_bits: 8,
    interpolation: Interpolation::Unsnapped,
    depth: DepthFormat::F32Reversed,
    stencil_bits: 8,
    max_line_width_px: 10.0,
    filter_bits: 8,
    level_bits: 5,
};

/// A machine that looks straight down, on whose screen a metre is a pixel and depth is how far a point lies below 1.
struct Imitation {
    pipeline: Pipeline<f32>,
    half: f64,
}

impl Imitation {
    fn new(device: &Device, side: usize) -> Self {
        let eye = World::new(0.0, 0.0, 2.0);
        let view = Viewpoint { eye, target: World::default(), up: DVec3::Y, near: 1.0, far: 2.0 };
        let view = ViewFrame::orthographic(&view, side as f64, (side, side)).unwrap();
        let posts = Posts::new((2, 2), Plan::default(), (DVec2::X, DVec2::Y), vec![0.0; 4]).unwrap();
        let mesh = Mesh::new(Surface::Grid(posts), Diagonal::SwNe).unwrap();
        // Depth grows away from the eye here, whatever the device's depth buffer does.
        let device = Device { depth: DepthFormat::F32, ..*device };
        Self { pipeline: Pipeline::new(&view, &mesh, &device), half: side as f64 / 2.0 }
    }

    /// Calls `visit` with what a rectangle covers of a lattice and the depth there.
    fn rasterize(
        &self,
        rectangle: &Rectangle,
        lattice: &Lattice,
        visit: &mut dyn FnMut((usize, usize), f64),
    ) {
        let [a, b, c, d] =
            rectangle.corners().map(|[x, y, z]| World::new(x - self.half, self.half - y, 1.0 - z));
        let window = Window { columns: 0..lattice.columns, rows: 0..lattice.rows };
        for triangle in [[a, b, c], [a, c, d]] {
            self.pipeline.rasterize(&triangle, true, (lattice, &window), &mut |at, _, depth| {
                visit(at, f64::from(depth))
            });
        }
    }
}

fn drawn(picture: &Picture, device: &Device) -> Buffer<[u8; 4]> {
    let side = picture.side;
    let size = [side, side];
    let mut pixels = vec![[0, 0, 0, 255]; side * side];
    let machine = Imitation::new(device, side);
    let centres = Lattice::samples([0, 0], size, 1);
    match picture.way {
        Way::Flat => picture.rectangles.iter().for_each(|rectangle| {
            machine.rasterize(rectangle, &centres, &mut |(x, y), _| pixels[y * side + x] = [255; 4]);
        }),
        Way::Interpolated => picture.rectangles.iter().for_each(|rectangle| {
            machine.rasterize(rectangle, &centres, &mut |(x, y), z| pixels[y * side + x] = split(z));
        }),
        Way::Samples(count) => {
            let places = match SamplePattern::of(count) {
                Some(SamplePattern::Multisample(places)) => places.to_vec(),
                _ => vec![[0, 0]],
            };
            let mut white = vec![0u32; side * side];
            for place in places {
                let lattice = Lattice::one_each([0, 0], size, place.map(|v| 0.5 + f64::from(v) / 16.0));
                for rectangle in &picture.rectangles {
                    machine.rasterize(rectangle, &lattice, &mut |(x, y), _| white[y * side + x] += 1);
                }
            }
            let code = |white: u32| (f64::from(white) / f64::from(count) * 255.0 + 0.5) as u8;
            pixels = white.into_iter().map(|white| [code(white), code(white), code(white), 255]).collect();
        }
        Way::Depth | Way::DepthReversed => compared(picture, DepthBuffer(device.depth), &mut pixels),
        Way::Filtered => {
            for (k, pixel) in pixels.iter_mut().enumerate() {
                let (column, band) = (k % side, k / side / BAND);
                let bits = if band < 2 { device.filter_bits } else { device.level_bits };
                let (weight, steps) = (column as f64 * BAND_STEPS[band % 2], f64::from(1u32 << bits));
                *pixel = split(if bits == 0 { weight } else { (weight * steps + 0.5).floor() / steps });
            }
        }
    }
    Buffer::from_values(side, side, pixels)
}

/// Rectangles on whole pixels, compared by what a depth buffer keeps of them.
fn compared(picture: &Picture, depth: DepthBuffer, pixels: &mut [[u8; 4]]) {
    let mut kept = vec![depth.cleared(); pixels.len()];
    for rectangle in &picture.rectangles {
        let stored = depth.store(rectangle.depths[0] as f32);
        let [left, top, right, bottom] = rectangle.sides.map(|v| v as usize);
        for at in (top..bottom).flat_map(|y| (left..right).map(move |x| y * picture.side + x)) {
            if depth.passes(stored, kept[at]) {
                kept[at] = stored;
                let [red, green, blue] = rectangle.color;
                pixels[at] = [red, green, blue, 255];
            }
        }
    }
}

/// A number as two code values.
fn split(v: f64) -> [u8; 4] {
    [(v * 255.0).floor() as u8, ((v * 255.0).fract() * 255.0 + 0.5) as u8, 0, 255]
}

/// Draws the pictures that a renderer with this device hands in.
fn draw_all(device: &Device, folder: &Path, is_wanted: &dyn Fn(&str) -> bool) {
    let is_reversed = device.depth == DepthFormat::F32Reversed;
    let other = if is_reversed { "depth" } else { "depth-reversed" };
    for picture in pictures().iter().filter(|picture| picture.name != other && is_wanted(picture.name)) {
        let image = drawn(picture, device);
        write_whole(&folder.join(format!("{}.png", picture.name)), |to| write_png(&image, to)).unwrap();
    }
}

/// The device of a scene with these changes.
fn applied(said: &[String]) -> Device {
    let said: Vec<Override> = said.iter().map(|text| Override::parse(text).unwrap()).collect();
    SceneFile::parse("schema = 1\n[terrain]\ngenerate = { kind = \"plane\" }\n", None, &said).unwrap().device
}

#[test]
fn reading_finds_the_settings_that_the_pictures_were_drawn_with() {
    let devices = [
        DEVICE,
        Device {
            interpolation: Interpolation::Snapped,
            depth: DepthFormat::Unorm24,
            filter_bits: 0,
            ..DEVICE
        },
        Device { subpixel_bits: 4, depth: DepthFormat::F32, level_bits: 3, ..DEVICE },
        Device {
            subpixel_bits: 4,
            interpolation: Interpolation::Snapped,
            depth: DepthFormat::Unorm16,
            ..DEVICE
        },
        // Without snapping there is nothing to tell of interpolation.
        Device {
            subpixel_bits: 0,
            interpolation: Interpolation::Snapped,
            filter_bits: 4,
            level_bits: 11,
            ..DEVICE
        },
    ];
    for device in devices {
        let folder = tempfile::tempdir().unwrap();
        draw_all(&device, folder.path(), &|_| true);
        let text = read(folder.path()).unwrap_or_else(|error| panic!("{device:?}: {error}"));
        assert_eq!(applied(&changes(&text).unwrap()), device, "{text}");
        assert!(text.contains("belongs to the top-left one"), "{text}");
        for count in [1, 4, 8] {
            assert!(text.contains(&format!("samples-{count}: where Direct3D and Vulkan put them")), "{text}");
        }
    }
}

#[test]
fn pictures_that_are_missing_leave_their_keys_out_and_none_at_all_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    draw_all(&DEVICE, folder.path(), &|name| name == "interpolation" || name == "depth-reversed");
    let text = read(folder.path()).unwrap();
    assert!(text.contains("# Not seen: edges.png.") && !text.contains("filter_bits"), "{text}");
    assert!(
        text.contains("depth = \"f32-reversed\"") && text.contains("interpolation = \"unsnapped\""),
        "{text}"
    );
    let error = read(&folder.path().join("none")).unwrap_err();
    assert!(error.what().starts_with("there is no picture of a calibration"), "{error}");
}

#[test]
fn pictures_that_contradict_themselves_or_one_another_are_refused() {
    let refusal = |first: &Device, second: &Device, of_second: &str| {
        let folder = tempfile::tempdir().unwrap();
        draw_all(first, folder.path(), &|_| true);
        draw_all(second, folder.path(), &|name| name.starts_with(of_second));
        read(folder.path()).unwrap_err().to_string()
    };
    let snapped = Device { interpolation: Interpolation::Snapped, ..DEVICE };
    let coarse = Device { subpixel_bits: 4, ..snapped };
    assert!(
        refusal(&snapped, &coarse, "interpolation")
            .contains("edges are snapped to 2^-8 pixels, what is interpolated to 2^-4")
    );
    let other = Device { depth: DepthFormat::Unorm24, ..DEVICE };
    assert!(refusal(&DEVICE, &other, "depth").contains("a picture for each direction of depth"));
    // Any other picture under the name of one, and one of another size.
    for (name, under, what) in [
        ("samples-4", "samples-8", "2 samples are at one place"),
        ("samples-8", "samples-4", "is no mean of 4 samples"),
        ("filter", "edges", "contradicts itself"),
        ("edges", "interpolation", "explained neither"),
        ("edges", "depth", "not 64 x 64"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let picture = pictures().into_iter().find(|picture| picture.name == name).unwrap();
        let image = drawn(&picture, &DEVICE);
        write_whole(&folder.path().join(format!("{under}.png")), |to| write_png(&image, to)).unwrap();
        let said = read(folder.path()).unwrap_err().to_string();
        assert!(said.contains(what), "{name} as {under}: {said}");
    }
}

#[test]
fn the_tables_that_ship_are_devices_and_other_files_are_refused() {
    for (name, text) in KNOWN {
        let device = applied(&changes(text).unwrap());
        assert_eq!(device.is_exact(), name == "exact", "{name}");
    }
    for (text, what) in [
        ("[device]\nprecision = ", "this is no TOML"),
        ("[image]\nwidth = 3\n", "`image` is nothing of a device"),
        ("", "no table `device`"),
        ("[device]\nbits = 8\n", "no key `bits`"),
    ] {
        assert!(changes(text).unwrap_err().to_string().contains(what), "{text}");
    }
}

#[test]
fn the_instructions_have_every_place_exactly() {
    let folder = tempfile::tempdir().unwrap();
    write_instructions(Batch::into(folder.path()).unwrap()).unwrap();
    let told: serde_json::Value =
        serde_json::from_slice(&std::fs::read(folder.path().join("calibration.json")).unwrap()).unwrap();
    assert_eq!(told["pictures"].as_array().map(Vec::len), Some(pictures().len()));
    for picture in pictures() {
        let half = picture.side as f64 / 2.0;
        for [x, y, z] in picture.rectangles.iter().flat_map(Rectangle::corners) {
            let exact = |v: f64| f64::from(v as f32) == v;
            assert!(exact(x / half - 1.0) && exact(1.0 - y / half) && exact(z), "{}", picture.name);
        }
        let has_tables = folder.path().join(format!("{}.vertices.npy", picture.name)).is_file();
        assert_eq!(has_tables, !picture.rectangles.is_empty());
    }
}
