//! Geometry overlay with its option to fill polygons: triangles on the mesh in use, against point samples and the truth.
#![cfg(feature = "render")]

mod drawing;

use drapery::buffer::Values;
use drapery::technique::{Frame, Kind};
use drawing::{count, errors, frame_of, scene, stage, truth_of};

const NADIR: &str =
    "eye = [3, 5, 400], target = [3, 5, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = 300";
const OBLIQUE: &str = "eye = [-60, -520, 330], target = [0, 0, 20]";
const HILLS: &str = "kind = \"fbm\", seed = 7, posts = [33, 33], cell_m = 20, height_m = 60";
const LEVELS: &str = "kind = \"fbm\", seed = 7, posts = [260, 300], cell_m = 2.5, height_m = 60";
const FILLED: &str = "technique.geometry-overlay.polygons=filled";
const SMOOTH: &str = "technique.geometry-overlay.polygons=antialiased";

/// A polygon with a hole and an island in it, one that crosses itself, and a union of two that lie over one another; translucent, so that what is drawn twice is
/// seen.
const AREAS: &str = "[[layer]]\n\
    features = [\n\
    { polygon = [[[-250, -130], [-20, -140], [10, 90], [-210, 120]], [[-200, -80], [-60, -90], [-50, 40], [-180, 60]], [[-150, -40], [-100, -40], [-120, 20]]] },\n\
    { polygon = [[20, -100], [230, 60], [220, -90], [40, 110]] },\n\
    ]\n\
    fill = { color = \"#aa0022\", opacity = 0.5 }\n\
    [[layer]]\n\
    features = [{ polygon = [[-100, -20], [160, -10], [150, 60], [-90, 40]] }]\n\
    fill = { color = \"#00aa44\", opacity = 0.6, rule = \"nonzero\" }\n";

fn filled(text: &str, changes: &[&str]) -> Frame {
    frame_of(Kind::GeometryOverlay, &stage(text, changes), &["color"])
}

fn with_levels(text: &str) -> String {
    let levels = "color = \"#ffffff\", diagonal = \"alternating\", lod = { error_px = 0.7 } }";
    text.replace("color = \"#ffffff\" }", levels)
}

#[test]
fn every_fill_is_drawn_where_a_pixels_centre_lies_in_it_and_once() {
    for (terrain, camera, differ) in [(HILLS, NADIR, 0), (HILLS, OBLIQUE, 0), (LEVELS, OBLIQUE, 0)] {
        let text = scene(terrain, camera, AREAS);
        let text = if terrain == LEVELS { with_levels(&text) } else { text };
        let stage = stage(&text, &[FILLED]);
        let frame = frame_of(Kind::GeometryOverlay, &stage, &[]);
        // Stencil volumes hold the footprint at each pixel's centre, exactly.
        let samples = frame_of(Kind::StencilVolume, &stage, &[]);
        let differing = frame.image.values().iter().zip(samples.image.values()).filter(|(a, b)| a != b);
        let differing = differing.count();
        assert!(differing <= differ, "{terrain} {camera}: {differing}");
        assert!(count(&frame, "fill_triangles") > 200);
    }
}
