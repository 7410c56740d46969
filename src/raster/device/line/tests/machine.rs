//! From the world to fragments.

use crate::raster::device::{
    Fragment, LinePrimitive, LineStyle, Pipeline, PolygonOffset, Real, Stipple, Window,
};
use crate::raster::{Lattice, Samples};
use crate::scene::{DepthFormat, Device, Diagonal, Posts, Surface};
use crate::space::{Plan, Screen, ViewFrame, Viewpoint, World};
use crate::terrain::Mesh;
use glam::{DVec2, DVec3};

const SIZE: (usize, usize) = (64, 48);
const FORMATS: [DepthFormat; 4] =
    [DepthFormat::F32Reversed, DepthFormat::F32, DepthFormat::Unorm24, DepthFormat::Unorm16];

/// Level ground of 8 km around the eye's foot.
fn mesh() -> Mesh {
    let first = Plan::new(-4000.0, -4000.0);
    let posts = Posts::new((9, 9), first, (DVec2::X * 1000.0, DVec2::Y * 1000.0), vec![0.0; 81]).unwrap();
    Mesh::new(Surface::Grid(posts), Diagonal::SwNe).unwrap()
}

/// From 20 m up to the north, slightly down.
fn frame(far: f64) -> ViewFrame {
    let (eye, target) = (World::new(0.0, 0.0, 20.0), World::new(0.0, 100.0, 0.0));
    ViewFrame::perspective(&Viewpoint { eye, target, up: DVec3::Z, near: 1.0, far }, 60.0, SIZE).unwrap()
}

fn picture() -> Window {
    Window { columns: 0..SIZE.0, rows: 0..SIZE.1 }
}

fn device(depth: DepthFormat, subpixel_bits: u32) -> Device {
    Device { depth, subpixel_bits, ..Device::default() }
}

fn fragments<T: Real>(line: &LinePrimitive<T>, style: &LineStyle) -> Vec<Fragment> {
    let mut all = Vec::new();
    line.draw(style, 0, &picture(), &mut |fragment| all.push(fragment));
    all
}

fn behind_the_eye<T: Real>(depth: DepthFormat, subpixel_bits: u32) {
    let (frame, device) = (frame(1e5), device(depth, subpixel_bits));
    let pipeline = Pipeline::<T>::new(&frame, &mesh(), &device);
    // Hard case 4, on the ground: it leaves the picture at its lower border and never appears above the vanishing point.
    let (near, behind) = (World::new(0.0, 60.0, 0.0), World::new(3.0, -1000.0, 0.0));
    let start = frame.screen_from_world(near).unwrap();
    // It ends where it crosses the near plane.
    let [from, to] = [near, behind].map(|p| frame.depth(p));
    let crossing = near + (behind - near) * ((from - frame.near()) / (from - to));
    let (at, [x, y, z]) =
        (frame.screen_from_world(crossing).unwrap(), pipeline.line([near, behind]).unwrap().ends[1]);
    let distance = (Screen::new(x.get(), y.get()) - at).length();
    assert!(distance < 0.25, "{depth:?} {subpixel_bits}: ends {distance} px off");
    assert!((z.get() - if pipeline.depth().is_reversed() { 1.0 } else { 0.0 }).abs() < 1e-4);
    for width in [1.0, 8.0] {
        let style = LineStyle::new(width, Stipple::SOLID, false, &device);
        let line = pipeline.line([near, behind]).unwrap();
        let all = fragments(&line, &style);
        assert!(all.len() > 10, "{depth:?} {subpixel_bits}: {} fragments", all.len());
        for f in &all {
            let at = Screen::new(f.column as f64 + 0.5, f.row as f64 + 0.5);
            assert!(at.y > start.y - 1.0 - width / 2.0, "{f:?} is above the line's start");
            // Where the line of sight meets the ground the line is as many pixels away as its width allows.
            let ray = frame.ray(at);
            let t = ray.from.z / (ray.from.z - ray.through.z);
            let ground = ray.from + (ray.through - ray.from) * t;
            let on_line = World::new((60.0 - ground.y) * 3.0 / 1060.0, ground.y, 0.0);
            let distance = (frame.screen_from_world(on_line).unwrap() - at).length();
            assert!(distance < width / 2.0 + 0.6, "{f:?} is {distance} px off the line");
            assert!((0.0..=1.0).contains(&f.depth) || width > 1.0, "{f:?}");
        }
        let swapped = fragments(&pipeline.line([behind, near]).unwrap(), &style);
        assert!(
            swapped.len().abs_diff(all.len()) <= width as usize,
            "the other way round it is the same line"
        );
    }
    assert!(pipeline.line([World::new(0.0, -5.0, 0.0), behind]).is_none(), "all of it is behind the eye");
    let nan = World::new(f64::NAN, 60.0, 0.0);
    assert!(pipeline.line([near, nan]).is_none() && pipeline.line([nan, near]).is_none());
}

#[test]
fn an_end_behind_the_eye_is_cut_off_and_never_mirrored() {
    for depth in FORMATS {
        for bits in [0, 4, 8] {
            behind_the_eye::<f64>(depth, bits);
            behind_the_eye::<f32>(depth, bits);
        }
    }
}

#[test]
fn no_segment_however_far_its_ends_gives_a_number_out_of_range() {
    let frame = frame(f64::INFINITY);
    let device = device(DepthFormat::F32Reversed, 8);
    let style = LineStyle::new(3.0, Stipple { pattern: 0x00ff, factor: 1 }, false, &device);
    let smooth = LineStyle::new(3.0, Stipple { pattern: 0x00ff, factor: 1 }, true, &device);
    let mut drawn = 0;
    for reach in [1.0, 1e3, 1e9, 1e20, 1e37, 1e300] {
        for k in 0..64u32 {
            let bit = |n: u32| if k >> n & 1 == 1 { reach } else { -reach };
            let ends = [World::new(bit(0), bit(1), bit(2)), World::new(bit(3), bit(4), bit(5) * 0.5)];
            let mut check = |all: Vec<Fragment>| {
                drawn += all.len();
                assert!(all.iter().all(|f| f.depth.is_finite() && f.coverage > 0.0 && f.coverage <= 1.0));
            };
            for style in [&style, &smooth] {
                if let Some(line) = Pipeline::<f64>::new(&frame, &mesh(), &device).line(ends) {
                    check(fragments(&line, style));
                }
                if let Some(line) = Pipeline::<f32>::new(&frame, &mesh(), &device).line(ends) {
                    check(fragments(&line, style));
                }
            }
        }
    }
    assert!(drawn > 1000, "{drawn}");
}

#[test]
fn ends_are_snapped_as_triangles_corners_are() {
    let frame = frame(1e5);
    let pipeline = Pipeline::<f64>::new(&frame, &mesh(), &device(DepthFormat::F32, 4));
    let ends = [World::new(-10.0, 60.0, 0.0), World::new(17.0, 133.0, 1.0)];
    let line = pipeline.line(ends).unwrap();
    for (end, world) in line.ends.iter().zip(ends) {
        let exact = frame.screen_from_world(world).unwrap();
        for (snapped, exact) in end.iter().zip([exact.x, exact.y]) {
            assert!((snapped * 16.0).fract() == 0.0 && (snapped - exact).abs() <= 1.0 / 32.0);
        }
    }
}

#[test]
fn polygon_offset_moves_the_depth_buffer_away_from_the_eye_and_lines_before_the_ground() {
    let frame = frame(1e4);
    let mesh = mesh();
    let lattice = Lattice::centres(&frame, 0);
    for depth in FORMATS {
        let device = device(depth, 8);
        let plain = Pipeline::<f32>::new(&frame, &mesh, &device);
        let moved = plain.clone().with_polygon_offset(PolygonOffset { factor: 1.0, units: 1.0 });
        let draw = |pipeline: &Pipeline<f32>| {
            let primitives = pipeline.primitives(&mesh, 0..mesh.triangle_ids(), &lattice);
            let mut samples = Samples::default();
            pipeline.clear(&mut samples, SIZE);
            pipeline.draw(primitives.iter(), (&lattice, &picture()), &mut samples);
            samples
        };
        let (before, after) = (draw(&plain), draw(&moved));
        // A line on the ground, from near to far: with the offset all of it is before the ground.
        let line = plain.line([World::new(-8.0, 20.0, 0.0), World::new(120.0, 900.0, 0.0)]).unwrap();
        let style = LineStyle::new(1.0, Stipple::SOLID, false, &device);
        let all = fragments(&line, &style);
        let passed = |samples: &Samples| {
            let is_before = |f: &&Fragment| {
                let ground = samples.keys[f.row * samples.stride() + f.column];
                plain.depth().passes(plain.depth().store(f.depth), ground)
            };
            all.iter().filter(is_before).count()
        };
        assert_eq!(passed(&after), all.len(), "{depth:?}");
        assert!(passed(&before) < all.len(), "{depth:?}: without an offset they fight");
        let pairs = before.keys.iter().zip(&after.keys);
        assert!(pairs.clone().all(|(b, a)| if plain.depth().is_reversed() { a <= b } else { a >= b }));
        assert!(pairs.clone().any(|(b, a)| a != b));
    }
}
