//! Pictures whose pixels are known.

use super::{EXACT, FLAT, HILLS, MAP, covered, fragment, frame, is_in_footprint, line_layer, stage};
use crate::buffer::Values;
use crate::raster::Lattice;
use crate::space::{Plan, World};
use crate::stage::Stage;
use crate::visibility::{Planes, Sight};

/// The surface points of a stage's pixels.
fn surface(stage: &Stage) -> Vec<World> {
    let view = stage.view().unwrap();
    let lattice = Lattice::centres(&view, 0);
    let mut sight = Sight::new(&view, &stage.mesh, &stage.scene.device, lattice, 64);
    sight.see();
    let mut points = vec![World::default(); view.width() * view.height()];
    for (row, points) in points.chunks_mut(view.width()).enumerate() {
        sight.world_of_row((0, row), points, &mut Planes::default());
    }
    points
}

/// The pixels of which a picture says other than the footprint of a line by definition; rational numbers where doubles do not surely tell.
fn differing(stage: &Stage, path: &[[f64; 2]], width: f64) -> Vec<usize> {
    let view = stage.view().unwrap();
    let path: Vec<Plan> = path.iter().map(|[x, y]| Plan::new(*x, *y)).collect();
    let is_held = |at: &World| {
        let half = width / 2.0 * fragment(&view, *at).pixel;
        at.is_finite()
            && path.windows(2).any(|pair| {
                let (along, from) = (pair[1] - pair[0], at.plan() - pair[0]);
                let t = (from.dot(along) / along.length_squared()).clamp(0.0, 1.0);
                let excess = (from - along * t).length() - half;
                match excess.abs() > 1e-6 * (half + 1.0) {
                    true => excess < 0.0,
                    false => is_in_footprint([pair[0], pair[1]], width / 2.0, &view, *at),
                }
            })
    };
    let covered = covered(stage);
    let points = surface(stage);
    (0..points.len()).filter(|k| is_held(&points[*k]) != covered[*k]).collect()
}

#[test]
fn a_map_whose_borders_run_through_centres_is_the_footprint() {
    // Along rows and columns, a whole number of pixels wide; along (4, 3), 10 pixels wide: each third or fourth centre is on the border.
    let at = |x: f64, y: f64| [(x + 0.5) * 6.25, (y + 0.5) * 6.25];
    let lines = [
        (vec![at(-30.0, 4.0), at(20.0, 4.0), at(20.0, -19.0)], 6.0),
        (vec![at(-28.0, -20.0), at(12.0, 10.0), at(33.0, -18.0)], 10.0),
        (vec![at(-30.0, 0.0), at(9.0, 0.0)], 1e-9),
        (vec![at(-20.0, -20.0), at(11.0, 11.0)], 1e-9),
    ];
    for (line, width) in lines {
        for l_max in ["automatic", "1e9", "7"] {
            let l_max = format!("technique.dynamic-line.l_max={l_max}");
            let changes = [&EXACT[..], &[l_max.as_str()]].concat();
            let stage = stage(MAP, FLAT, &line_layer(&line, width), &changes);
            assert_eq!(differing(&stage, &line, width), [0; 0], "{line:?} {width} {l_max}");
            assert!(covered(&stage).iter().filter(|is| **is).count() >= 25);
        }
    }
}

#[test]
fn a_border_may_run_as_near_to_a_centre_as_doubles_can_say() {
    let path = [[-250.0, -150.0], [-60.0, 120.0], [80.0, -120.0], [95.0, 110.0], [240.0, 90.0]];
    let camera = "eye = [-60, -520, 330], target = [0, 0, 40]";
    let bare = stage(camera, HILLS, &line_layer(&path, 1.0), &EXACT);
    let (view, points) = (bare.view().unwrap(), surface(&bare));
    for pixel in [32 * 96 + 40, 40 * 96 + 70] {
        // As wide as to reach this pixel's centre, or as not to.
        let at = points[pixel];
        let distance = path.windows(2).map(|pair| {
            let [a, b] = [pair[0], pair[1]].map(|[x, y]| Plan::new(x, y));
            let t = ((at.plan() - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
            (at.plan() - a - (b - a) * t).length()
        });
        let width = 2.0 * distance.fold(f64::INFINITY, crate::math::min) / fragment(&view, at).pixel;
        for width in [width.next_down(), width, width.next_up()] {
            let stage = stage(camera, HILLS, &line_layer(&path, width), &EXACT);
            assert_eq!(differing(&stage, &path, width), [0; 0], "{width}");
        }
        let covers = |width: f64| covered(&stage(camera, HILLS, &line_layer(&path, width), &EXACT))[pixel];
        assert_eq!([width * (1.0 - 1e-12), width * (1.0 + 1e-12)].map(covers), [false, true]);
    }
}

#[test]
fn a_mitre_at_an_acute_turn_loses_what_lies_beyond_a_short_segment() {
    // In pixels, half a width of 8. The mitre at (0, 0) is 8 (-3, 1): the first segment's box ends at y = -x / 3. Beyond that lies the box of the second
    // segment, whose other end is at (-8, 6): what is farther than 8 from there and left of the third segment's box, x = -16, is in the first one's line alone.
    let line = [[-40.0, 0.0], [0.0, 0.0], [-8.0, 6.0], [-8.0, 20.0]].map(|[x, y]| [x * 6.25, y * 6.25]);
    let changes = |boxes: &str| {
        let boxes = format!("technique.dynamic-line.boxes={boxes}");
        let l_max = "technique.dynamic-line.l_max=1e9".to_owned();
        let changes = [&EXACT.map(str::to_owned)[..], &[boxes, l_max]].concat();
        let changes: Vec<&str> = changes.iter().map(String::as_str).collect();
        differing(&stage(MAP, FLAT, &line_layer(&line, 16.0), &changes), &line, 16.0)
    };
    let lost = [
        (-21.5, 7.5),
        (-20.5, 7.5),
        (-19.5, 7.5),
        (-18.5, 7.5),
        (-17.5, 7.5),
        (-16.5, 7.5),
        (-18.5, 6.5),
        (-17.5, 6.5),
        (-16.5, 6.5),
    ];
    let pixel = |(x, y): (f64, f64)| (32.0 - y) as usize * 96 + (48.0 + x) as usize;
    assert_eq!(changes("mitred"), lost.map(pixel));
    for boxes in ["overlapping", "enclosing"] {
        assert_eq!(changes(boxes), [0; 0], "{boxes}");
    }
}

#[test]
fn single_precision_tells_in_a_miter_of_a_segment_that_is_shorter_than_it() {
    // In pixels: a miter of 38 at the end of a segment of 2, both half as wide as 1. Its sides are y = -1 and that of the short segment, which falls by 0.0525
    // for each pixel from (-1.95, 1.104): they meet beyond x = 38.
    let line = [[-200.0, 0.0], [0.0, 0.0], [-12.5, 0.65625]];
    let layer = line_layer(&line, 2.0).replace("width_px", "join = \"miter\", miter_limit = 50, width_px");
    let changes = ["technique.dynamic-line.corners=style", "technique.dynamic-line.boxes=mitred"];
    for precision in ["device.precision=f64", "device.precision=f32"] {
        let covered = covered(&stage(MAP, FLAT, &layer, &[&EXACT[..], &changes, &[precision]].concat()));
        for (y, end) in [(1.5, 0), (0.5, 10), (-0.5, 29), (-1.5, 0)] {
            let row = &covered[(32.0 - y) as usize * 96 + 48..][..48];
            let found: Vec<usize> = (0..48).filter(|x| row[*x]).collect();
            assert_eq!(found, (0..end).collect::<Vec<_>>(), "{precision} {y}");
        }
    }
}

#[test]
fn a_crowd_of_lines_in_a_pixel_is_composed_in_order() {
    // 3,000 lines of opacity 1/2, each another item, within a pixel; the last one is on top.
    let features: String = (0..3000)
        .map(|k| format!("{{ line = [[3.0, 3.0], [{}, 3.2]] }},", 3.5 + f64::from(k % 7) / 10.0))
        .collect();
    let layer = |color: &str| {
        format!(
            "[[layer]]\nfeatures = [{features}]\nline = {{ color = \"{color}\", opacity = 0.5, width_px = 1.5 }}\n"
        )
    };
    let stage = stage(MAP, FLAT, &(layer("#ff0000") + &layer("#0000ff")), &EXACT);
    let frame = frame(&stage);
    let longest = frame.counts.iter().find(|(name, _)| *name == "longest_list").unwrap().1;
    assert_eq!(longest, 6000);
    let Values::U32(lengths) = &frame.planes[0].values else { panic!("lengths are counted") };
    let fullest = lengths.iter().position(|length| *length == 6000).unwrap();
    assert_eq!(frame.image.values()[fullest], [0, 0, 255, 255]);
}

#[test]
fn a_mitre_reaches_into_the_picture_from_a_corner_beside_it() {
    // The corner is 7 pixels left of the picture, its mitre reaches 38 to the right.
    let line = [[-700.0, 0.0], [-343.75, 0.0], [-356.25, 0.65625]];
    let layer = line_layer(&line, 2.0).replace("width_px", "join = \"miter\", miter_limit = 50, width_px");
    let changes = [
        "technique.dynamic-line.corners=style",
        "technique.dynamic-line.boxes=mitred",
        "technique.dynamic-line.l_max=1e9",
    ];
    let covered = covered(&stage(MAP, FLAT, &layer, &[&EXACT[..], &changes].concat()));
    let found: Vec<usize> = (0..96).filter(|x| covered[32 * 96 + x]).collect();
    assert_eq!(found, (0..22).collect::<Vec<_>>());
}

#[test]
fn a_vertex_on_the_side_of_the_picture_is_in_it() {
    let line = [[300.0, 3.125], [400.0, 3.125]];
    let changes = [&EXACT[..], &["technique.dynamic-line.culling=vertices"]].concat();
    let found = covered(&stage(MAP, FLAT, &line_layer(&line, 6.0), &changes));
    // Within 3 pixels of the vertex.
    assert_eq!(found.iter().filter(|is| **is).count(), 13);
    let beside = [[300.001, 3.125], [400.0, 3.125]];
    assert!(!covered(&stage(MAP, FLAT, &line_layer(&beside, 6.0), &changes)).contains(&true));
}

#[test]
fn what_is_added_hides_nothing_that_lies_below() {
    let layer = |color: &str, y: f64| line_layer(&[[-200.0, -y], [200.0, y]], 9.0).replace("#000000", color);
    let changes = [&EXACT[..], &["compositing.mode=additive", "terrain.color=#000000"]].concat();
    let stage = stage(MAP, FLAT, &(layer("#aa0000", 90.0) + &layer("#0000bb", -90.0)), &changes);
    assert_eq!(frame(&stage).image.values()[32 * 96 + 48], [0xaa, 0, 0xbb, 255]);
}

#[test]
fn a_smoothed_pixel_is_explained_by_all_that_its_filter_reads() {
    let text = line_layer(&[[-250.0, -31.0], [250.0, 27.0]], 3.0);
    let changes = [&EXACT[..4], &["image.width=48", "image.height=16"]].concat();
    let stage = stage(MAP, FLAT, &text, &changes);
    let (prepared, view) = (super::Prepare::new(&stage).unwrap(), stage.view().unwrap());
    let image = frame(&stage).image;
    for (k, code) in image.values().iter().enumerate() {
        let (_, said) = prepared.steps_of(&view, [k % 48, k / 48]).unwrap();
        assert_eq!(said, *code, "{k}");
    }
}
