//! What pictures of lines on the screen may be: whatever an imitated machine within the envelope draws is allowed, and what a planted bug draws is not.
#![cfg(feature = "render")]

mod drawing;
mod judged;

use drapery::technique::Kind;
use drawing::{frame_of, scene, stage};
use judged::{MACHINES, allowed_of, best, wide};

const HILLS: &str = r#"kind = "fbm", seed = 3, posts = [65, 65], cell_m = 10.0, height_m = 120.0"#;

const LINES: &str = "[[layer]]\nfeatures = [{ line = [[-280, -200], [0, 100], [250, -60], [300, 280]] }, { line = [[-200, 200], [-20, -40], [200, -250]] }]\n\
     line = { color = \"#aa2200\", opacity = 0.6, width_px = 3.0 }\n\
     [[layer]]\nfeatures = [{ line = [[-100, -250], [-60, 0], [100, 40], [120, 250]] }]\nline = { color = \"#113355\", width_px = 1.5 }\n";

const SOUTH: &str = "eye = [40, -420, 260], target = [0, 0, 40]";

/// Settings of dynamic lines by which a pixel's centre is in a line where its surface point is in the footprint.
const PLAIN: [&str; 5] = [
    "technique.dynamic-line.antialiasing=\"none\"",
    "technique.dynamic-line.boxes=\"enclosing\"",
    "technique.dynamic-line.culling=\"boxes\"",
    "technique.dynamic-line.simplification=\"none\"",
    "technique.dynamic-line.thin_lines=\"none\"",
];

/// All machines' pictures have to be inside of some hypothesis, and little else may be.
fn assert_machines_are_inside(kind: Kind, name: &str, text: &str, changes: &[&str]) {
    let all = allowed_of(kind, &stage(text, changes));
    let widths: Vec<usize> = all.hypotheses.iter().map(wide).collect();
    let is_outside = |machine: &&&[&str]| {
        let image = frame_of(kind, &stage(text, &[changes, **machine].concat()), &[]).image;
        best(&all, &image) > 0
    };
    let bad: Vec<_> = MACHINES.iter().filter(is_outside).collect();
    assert!(bad.is_empty(), "{name}: {bad:?}");
    // Where counters of strips go on, what is not known adds up; of anti-aliased lines each share is off by what the ends may stray.
    let share = match name {
        _ if name.starts_with("anti-aliased") => 4,
        "strips" => 10,
        _ => 20,
    };
    assert!(widths[0] * share < all.width * all.height, "{name}: {widths:?}");
}

#[test]
fn what_machines_draw_of_dynamic_lines_is_allowed() {
    let kind = Kind::DynamicLine;
    let hills = scene(HILLS, SOUTH, LINES);
    assert_machines_are_inside(kind, "plain", &hills, &PLAIN);
    assert_machines_are_inside(kind, "unsmoothed", &hills, &PLAIN[..1]);
    assert_machines_are_inside(kind, "default", &hills, &[]);
}

/// Fills, a stroke in metres and an outline in pixels among lines, some of them of many short segments.
fn mixed_layers() -> String {
    let zigzag: String = (0..60)
        .map(|k| {
            format!(
                "[{}, {}]",
                -240.0 + 8.0 * f64::from(k),
                -40.0 + 14.0 * f64::from(k % 3) + 0.5 * f64::from(k)
            )
        })
        .collect::<Vec<_>>()
        .join(", ");
    format!(
        "[[layer]]\nfeatures = [{{ polygon = [[-150, -150], [120, -180], [60, 20], [160, 150], [-120, 90]] }}]\n\
         fill = {{ color = \"#3388ff\", opacity = 0.6 }}\noutline = {{ color = \"#003366\", width_px = 2.5, opacity = 0.8 }}\n\
         [[layer]]\nfeatures = [{{ line = [[-200, -100], [200, 100]] }}]\nline = {{ color = \"#ffcc00\", width_m = 14, opacity = 0.7 }}\n\
         [[layer]]\nfeatures = [{{ line = [{zigzag}] }}]\nline = {{ color = \"#661144\", width_px = 4.0, opacity = 0.5 }}\n{LINES}"
    )
}

#[test]
fn settings_of_dynamic_lines_and_other_views_are_allowed() {
    let kind = Kind::DynamicLine;
    let near = "eye = [20, -120, 150], target = [0, 60, 60]";
    let above = "eye = [5, -10, 700], target = [0, 0, 40]";
    let low = "eye = [-200, -330, 150], target = [100, 100, 40]";
    let far = "eye = [300, -2400, 1200], target = [0, 0, 0], fov_y_deg = 25";
    let side = "eye = [40, -420, 260], target = [0, 0, 40], projection = \"orthographic\", height_m = 300";
    let none = "technique.dynamic-line.antialiasing=\"none\"";
    let scenes: [(&str, &str, &str, &[&str]); 14] = [
        ("mixed", SOUTH, &mixed_layers(), &[]),
        ("mixed unsmoothed", SOUTH, &mixed_layers(), &[none]),
        ("near", near, LINES, &[]),
        ("low", low, &mixed_layers(), &[]),
        ("far", far, &mixed_layers(), &[]),
        ("far unsmoothed", far, &mixed_layers(), &[none]),
        ("above", above, &mixed_layers(), &[]),
        ("above unsmoothed", above, &mixed_layers(), &[none]),
        ("second depth", low, LINES, &["technique.dynamic-line.thin_lines=\"second-depth\"", none]),
        ("orthographic", side, &mixed_layers(), &[none]),
        ("unsorted", SOUTH, LINES, &["technique.dynamic-line.sorting=\"none\"", none]),
        ("double", SOUTH, &mixed_layers(), &["technique.dynamic-line.overlaps=\"double\"", none]),
        ("overlapping", low, &mixed_layers(), &["technique.dynamic-line.boxes=\"overlapping\"", none]),
        ("additive", SOUTH, &mixed_layers(), &["compositing.mode=\"additive\""]),
    ];
    for (name, camera, layers, changes) in scenes {
        assert_machines_are_inside(kind, name, &scene(HILLS, camera, layers), changes);
    }
}

#[test]
fn what_bugs_draw_of_dynamic_lines_is_not_allowed() {
    let kind = Kind::DynamicLine;
    let text = scene(HILLS, SOUTH, &mixed_layers());
    let smoothed = allowed_of(kind, &stage(&text, &["device.subpixel_bits=8"]));
    let none = "technique.dynamic-line.antialiasing=\"none\"";
    let unsmoothed = allowed_of(kind, &stage(&text, &[none, "device.subpixel_bits=8"]));
    let bugs: [(&str, &str, &str); 8] = [
        ("wider by a twentieth", "width_px = 4.0", "width_px = 4.2"),
        ("thin line wider by a twentieth", "width_px = 1.5", "width_px = 1.575"),
        ("a line missing", ", { line = [[-200, 200], [-20, -40], [200, -250]] }", ""),
        ("a segment missing", "[100, 40], [120, 250]] }", "[100, 40]] }"),
        ("half a pixel", "target = [0, 0, 40]", "target = [0, 0, 42.0]"),
        ("opacity", "opacity = 0.8", "opacity = 0.78"),
        ("colour", "#113355", "#183355"),
        ("order", "order = 0", "order = 1"),
    ];
    for (name, from, to) in bugs {
        let with = if name == "order" {
            // The last layer comes first: what sorting would have put right.
            let (first, last) = text.rsplit_once("[[layer]]").unwrap();
            let (head, rest) = first.split_once("[[layer]]").unwrap();
            format!("{head}[[layer]]{last}[[layer]]{rest}")
        } else {
            text.replacen(from, to, 1)
        };
        assert_ne!(with, text, "{name}");
        for (what, all, changes) in
            [("smoothed", &smoothed, &[][..]), ("unsmoothed", &unsmoothed, &[none][..])]
        {
            let image = frame_of(kind, &stage(&with, changes), &[]).image;
            assert!(best(all, &image) > 0, "{name}, {what}");
        }
    }
    let settings: [(&str, &str); 6] = [
        ("no filter", none),
        ("whole parts", "technique.dynamic-line.l_max=1e9"),
        ("drawn twice", "technique.dynamic-line.overlaps=\"double\""),
        ("unsorted", "technique.dynamic-line.sorting=\"none\""),
        ("corners by style", "technique.dynamic-line.corners=\"style\""),
        ("no vertex left out", "technique.dynamic-line.simplification=\"none\""),
    ];
    for (name, change) in settings {
        let image = frame_of(kind, &stage(&text, &[change]), &[]).image;
        assert!(best(&smoothed, &image) > 0, "{name}");
    }
}

/// Opaque and translucent lines, wide ones and one in metres, and an area.
const OVERLAID: &str = "[[layer]]\nfeatures = [{ polygon = [[-150, -150], [120, -180], [60, 20], [160, 150], [-120, 90]] }]\n\
     fill = { color = \"#3388ff\" }\noutline = { color = \"#003366\", width_px = 2, opacity = 0.5 }\n\
     [[layer]]\nfeatures = [{ line = [[-200, -100], [200, 100]] }, { line = [[-280, 10], [-100, 40], [40, -250]] }]\n\
     line = { color = \"#cc8800\", width_m = 14, opacity = 0.7 }\n";

#[test]
fn what_machines_draw_of_lines_overlaid_is_allowed() {
    let kind = Kind::GeometryOverlay;
    let layers = format!("{OVERLAID}{LINES}");
    let near = "eye = [20, -120, 150], target = [0, 60, 60]";
    let above = "eye = [5, -10, 700], target = [0, 0, 40]";
    let low = "eye = [-200, -330, 110], target = [100, 100, 60]";
    let far = "eye = [300, -2400, 1200], target = [0, 0, 0], fov_y_deg = 25";
    let side = "eye = [40, -420, 260], target = [0, 0, 40], projection = \"orthographic\", height_m = 300";
    let set = |change: &str| format!("technique.geometry-overlay.{change}");
    let changes: [Vec<String>; 5] = [
        vec![],
        vec![set("stipple=0xf0f3")],
        vec![set("stipple=0x3333"), set("primitives=\"strips\"")],
        vec![set("lines=\"antialiased\"")],
        vec![set("offset_factor=0.0"), set("offset_units=4.0")],
    ];
    let cases = [
        ("hills", SOUTH, 0),
        ("near", near, 0),
        ("above", above, 0),
        ("low", low, 0),
        ("far", far, 0),
        ("orthographic", side, 0),
        ("stippled", SOUTH, 1),
        ("strips", SOUTH, 2),
        ("anti-aliased", SOUTH, 3),
        ("anti-aliased low", low, 3),
        ("no slope", low, 4),
    ];
    for (name, camera, k) in cases {
        let changes: Vec<&str> = changes[k].iter().map(String::as_str).collect();
        assert_machines_are_inside(kind, name, &scene(HILLS, camera, &layers), &changes);
    }
    let fine = HILLS.replace("[65, 65], cell_m = 10.0", "[257, 257], cell_m = 2.5");
    let changes = ["terrain.lod={ error_px = 2.0 }", "terrain.diagonal=\"alternating\""];
    assert_machines_are_inside(kind, "level of detail", &scene(&fine, low, &layers), &changes);
}

#[test]
fn what_bugs_draw_of_lines_overlaid_is_not_allowed() {
    let kind = Kind::GeometryOverlay;
    let text = scene(HILLS, SOUTH, &format!("{OVERLAID}{LINES}"));
    let set = |change: &str| format!("technique.geometry-overlay.{change}");
    let all = allowed_of(kind, &stage(&text, &["device.subpixel_bits=8"]));
    let bugs: [(&str, &str, &str); 8] = [
        ("a pixel wider", "width_px = 3.0", "width_px = 4.0"),
        ("metres wider by a fifth", "width_m = 14,", "width_m = 16.8,"),
        ("a line missing", ", { line = [[-200, 200], [-20, -40], [200, -250]] }", ""),
        ("a segment missing", "[100, 40], [120, 250]] }", "[100, 40]] }"),
        ("half a pixel", "target = [0, 0, 40]", "target = [0, 0, 42.0]"),
        ("opacity", "opacity = 0.6", "opacity = 0.58"),
        ("colour", "#113355", "#183355"),
        ("a vertex moved", "[250, -60]", "[251.5, -60]"),
    ];
    for (name, from, to) in bugs {
        let with = text.replacen(from, to, 1);
        assert_ne!(with, text, "{name}");
        let image = frame_of(kind, &stage(&with, &[]), &[]).image;
        assert!(best(&all, &image) > 0, "{name}");
    }
    let settings = [
        ("no polygon offset", vec![set("offset_factor=0.0"), set("offset_units=0.0")]),
        ("half the polygon offset", vec![set("offset_factor=0.5")]),
        ("one pixel wide", vec![set("widths=\"one\"")]),
        ("anti-aliased", vec![set("lines=\"antialiased\"")]),
        ("stippled", vec![set("stipple=0xfffd")]),
    ];
    for (name, changes) in settings {
        let changes: Vec<&str> = changes.iter().map(String::as_str).collect();
        let image = frame_of(kind, &stage(&text, &changes), &[]).image;
        assert!(best(&all, &image) > 0, "{name}");
    }
}

/// Translucent fills with a hole, across one another, an opaque one with an outline, under lines.
const FILLED: &str = "[[layer]]\nfeatures = [{ polygon = [[[-200, -180], [90, -200], [120, 60], [-150, 120]], [[-90, -100], [20, -110], [0, 20]]] }, { polygon = [[0, -60], [220, 10], [210, -100], [30, 110]] }]\n\
     fill = { color = \"#3388ff\", opacity = 0.5 }\n\
     [[layer]]\nfeatures = [{ polygon = [[-60, 20], [200, 60], [-40, 160]] }]\nfill = { color = \"#cc8800\" }\noutline = { color = \"#003366\", width_px = 2 }\n";

#[test]
fn what_machines_draw_of_fills_overlaid_is_allowed_and_what_bugs_draw_is_not() {
    let kind = Kind::GeometryOverlay;
    let filled = "technique.geometry-overlay.polygons=\"filled\"";
    let layers = format!("{FILLED}{LINES}");
    let near = "eye = [20, -120, 150], target = [0, 60, 60]";
    let above = "eye = [5, -10, 700], target = [0, 0, 40]";
    for (name, camera) in [("hills", SOUTH), ("above", above)] {
        assert_machines_are_inside(kind, name, &scene(HILLS, camera, &layers), &[filled]);
    }
    let fine = HILLS.replace("[65, 65], cell_m = 10.0", "[257, 257], cell_m = 2.5");
    let changes = [filled, "terrain.lod={ error_px = 2.0 }", "terrain.diagonal=\"alternating\""];
    assert_machines_are_inside(kind, "level of detail", &scene(&fine, near, &layers), &changes);
    let text = scene(HILLS, SOUTH, &layers);
    let all = allowed_of(kind, &stage(&text, &[filled, "device.subpixel_bits=8"]));
    let bugs = [
        ("no hole", ", [[-90, -100], [20, -110], [0, 20]]", ""),
        ("opacity", "#3388ff\", opacity = 0.5", "#3388ff\", opacity = 0.48"),
        ("a vertex moved", "[120, 60]", "[150, 60]"),
        ("another rule", "opacity = 0.5 }", "opacity = 0.5, rule = \"nonzero\" }"),
        ("a polygon missing", ", { polygon = [[0, -60], [220, 10], [210, -100], [30, 110]] }", ""),
    ];
    for (name, from, to) in bugs {
        let with = text.replacen(from, to, 1);
        assert_ne!(with, text, "{name}");
        let image = frame_of(kind, &stage(&with, &[filled]), &[]).image;
        assert!(best(&all, &image) > 0, "{name}");
    }
    for setting in ["polygons=\"outlines\"", "polygons=\"antialiased\"", "offset_factor=0.0"] {
        let setting = format!("technique.geometry-overlay.{setting}");
        let image = frame_of(kind, &stage(&text, &[filled, &setting]), &[]).image;
        assert!(best(&all, &image) > 0, "{setting}");
    }
    let smooth = stage(&text, &["technique.geometry-overlay.polygons=\"antialiased\""]);
    let refused = drapery::allowed::allowed(kind, (&smooth, &smooth.view().unwrap()), &|_| {}).unwrap_err();
    assert!(refused.to_string().contains("shares"), "{refused}");
}
