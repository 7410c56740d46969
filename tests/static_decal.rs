//! Static decals (Zechmeister 2020) on scenes whose answer is known, and the failures that the thesis shows, made on purpose.
#![cfg(feature = "render")]

mod drawing;

use drapery::buffer::Buffer;
use drapery::compare::Image;
use drapery::scene_file::{Override, SceneFile};
use drapery::technique::{Frame, Kind};
use drawing::{errors, stage, truth_of};

/// A plane seen from straight above: pixel (i, j) of 64 x 64 has its centre over plan point (i - 31.5, 31.5 - j).
fn map(layers: &str) -> String {
    format!(
        "schema = 1\nimage = {{ width = 64, height = 64 }}\n\
         terrain = {{ generate = {{ kind = \"plane\", posts = [9, 9], cell_m = 10.0 }}, color = \"#ffffff\" }}\n\
         camera = {{ eye = [0, 0, 100], target = [0, 0, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = 64 }}\n{layers}"
    )
}

fn draw(text: &str, of: &[&str]) -> Frame {
    let long = |change: &&str| format!("technique.static-decal.{change}");
    let changes: Vec<String> = of.iter().map(long).collect();
    let changes: Vec<&str> = changes.iter().map(String::as_str).collect();
    drawing::frame_of(Kind::StaticDecal, &stage(text, &changes), &[])
}

fn colors(image: &Buffer<[u8; 4]>) -> Vec<[u8; 4]> {
    let mut all = image.values().to_vec();
    all.sort_unstable();
    all.dedup();
    all
}

#[test]
fn a_stroke_that_reaches_over_the_border_of_its_cell_is_whole() {
    // Hard case 29. Dots in the corners keep the grid in its place; its cells are 16 m wide.
    let dots = "{ line = [[-32, -32], [-31.9, -32]] }, { line = [[32, 32], [31.9, 32]] }";
    for off in [0.0, 1.0, 2.0 - 1e-9, 2.0, 2.0 + 1e-9, 7.9] {
        for line in [
            format!("[[{off}, -20], [{off}, 20]]"),
            format!("[[-20, {off}], [20, {off}]]"),
            format!(
                "[[{}, {}], [{}, {}], [{}, 3]]",
                -16.0 + off,
                16.0 - off,
                16.0 - off,
                -16.0 + off,
                30.0 - off
            ),
        ] {
            let text = map(&format!(
                "[[layer]]\nfeatures = [{dots}, {{ line = {line} }}]\nline = {{ color = \"#ff0000\", width_m = 4.0, join = \"miter\" }}\n"
            ));
            let whole = draw(&text, &["grid=1"]).image;
            for grid in ["grid=4", "grid=5", "grid=64"] {
                assert_eq!(draw(&text, &[grid]).image, whole, "{line} {grid}");
            }
        }
    }
}

#[test]
fn each_point_of_polygons_that_share_edges_has_one_owner() {
    // Hard case 31: corners on the pixels' centres.
    let mut features = String::new();
    for k in 0..64 {
        let (x, y) = (f64::from(k % 8) * 6.0 - 24.5, f64::from(k / 8) * 6.0 - 24.5);
        let (e, n) = (x + 6.0, y + 6.0);
        if k % 3 == 0 {
            features += &format!("{{ polygon = [[{x}, {y}], [{e}, {y}], [{e}, {n}], [{x}, {n}]] }}, ");
        } else {
            features += &format!(
                "{{ polygon = [[{x}, {y}], [{e}, {y}], [{e}, {n}]] }}, {{ polygon = [[{x}, {y}], [{e}, {n}], [{x}, {n}]] }}, "
            );
        }
    }
    let text = map(&format!(
        "[[layer]]\nfeatures = [{features}]\nfill = {{ color = \"#000000\", opacity = 0.5 }}\n"
    ));
    for of in [
        &["samples=1"][..],
        &["samples=1", "grid=7", "leaf_capacity=1", "depth=16"],
        &["samples=1", "grid=1", "depth=0"],
    ] {
        let image = draw(&text, of).image;
        assert_eq!(colors(&image).len(), 2, "bare ground and half black");
        let dark = image.values().iter().filter(|pixel| pixel[0] < 200).count();
        // Half-open: 48 x 48 centres, not 49 x 49.
        assert_eq!(dark, 48 * 48, "{of:?}");
    }
}

#[test]
fn red_over_blue_is_the_same_for_every_pair_of_types() {
    // Hard case 41.
    let polygon = "features = [{ polygon = [[-20, -20], [20, -20], [20, 20], [-20, 20]] }]";
    let line = "features = [{ line = [[-20, 0], [20, 0]] }]";
    let types = |color: &str| {
        [
            format!("[[layer]]\n{polygon}\nfill = {{ color = \"{color}\", opacity = 0.5 }}\n"),
            format!(
                "[[layer]]\n{polygon}\noutline = {{ color = \"{color}\", width_m = 60, opacity = 0.5 }}\n"
            ),
            format!("[[layer]]\n{line}\nline = {{ color = \"{color}\", width_m = 30, opacity = 0.5 }}\n"),
        ]
    };
    for below in types("#0000ff") {
        for above in types("#ff0000") {
            let text = map(&[below.as_str(), above.as_str()].concat());
            for grid in ["grid=1", "grid=40"] {
                // White, then half of it blue, then half of that red.
                let middle = *draw(&text, &[grid]).image.at(32, 32);
                assert_eq!(middle, [191, 64, 128, 255], "{text}");
            }
        }
    }
}

#[test]
fn three_hundred_polygons_over_one_another_are_composed_one_by_one() {
    // Hard cases 36 and 37.
    let mut features = String::new();
    for k in 0..300 {
        let r = 5.0 + f64::from(k % 23);
        features += &format!("{{ polygon = [[-{r}, -{r}], [{r}, -{r}], [{r}, {r}], [-{r}, {r}]] }}, ");
    }
    let text = map(&format!(
        "[[layer]]\nfeatures = [{features}]\nfill = {{ color = \"#206080\", opacity = 0.01 }}\n"
    ));
    let truth = truth_of(&stage(&text, &[]));
    let error = |of: &[&str]| errors(&truth, &Image::from_rgba8(&draw(&text, of).image).unwrap()).max;
    // Borders run between samples: nothing is left but the rounding to code values.
    for of in [&["samples=16"][..], &["samples=16", "grid=3", "hierarchy=wide"]] {
        assert!(error(of) <= 0.5 / 255.0 + 1e-9, "{of:?}: {}", error(of));
    }
}

#[test]
fn a_wide_outline_reaches_to_the_wrong_side_unless_the_whole_polygon_is_asked() {
    // Fig. 4.8: the stroke of each side of a thin polygon reaches over the other one.
    let layer = |mode: &str| {
        map(&format!(
            "[[layer]]\nfeatures = [{{ polygon = [[-25, -4], [25, -4], [25, 4], [-25, 4]] }}]\n\
             outline = {{ color = \"#ff0000\", width_m = 40, mode = \"{mode}\", join = \"miter\" }}\n"
        ))
    };
    let is_red = |image: &Buffer<[u8; 4]>, x: usize, y: usize| image.at(x, y)[1] == 0;
    let places = |text: &str, of: &[&str]| {
        let image = draw(text, of).image;
        // In the polygon, and above it.
        (is_red(&image, 32, 32), is_red(&image, 32, 22))
    };
    assert_eq!(places(&layer("inset"), &["outlines=polygon"]), (true, false));
    assert_eq!(places(&layer("inset"), &[]), (true, true), "the thesis's artifact");
    assert_eq!(places(&layer("offset"), &["outlines=polygon"]), (false, true));
    assert_eq!(places(&layer("offset"), &[]), (false, true), "outside of either side");
    assert_eq!(places(&layer("normal"), &[]), (true, true));
}

#[test]
fn a_hole_and_an_island_are_outlined_on_their_own_sides_however_they_turn() {
    let ring = |r: i32, turns: bool| {
        let mut ring =
            [format!("[-{r}, -{r}]"), format!("[{r}, -{r}]"), format!("[{r}, {r}]"), format!("[-{r}, {r}]")];
        if turns {
            ring.reverse();
        }
        format!("[{}]", ring.join(", "))
    };
    for turns in 0..8 {
        let bit = |k: i32| turns >> k & 1 == 1;
        let rings = [ring(28, bit(0)), ring(20, bit(1)), ring(10, bit(2))].join(", ");
        let text = map(&format!(
            "[[layer]]\nfeatures = [{{ polygon = [{rings}] }}]\noutline = {{ color = \"#ff0000\", width_m = 6, mode = \"inset\", join = \"miter\" }}\n"
        ));
        let (by_side, by_polygon) = (draw(&text, &[]).image, draw(&text, &["outlines=polygon"]).image);
        // Between two rings, three metres wide: outside of the hole, inside of the island.
        let is_red = |y: usize| by_polygon.at(32, y)[1] < 128;
        assert!(is_red(5) && !is_red(1) && is_red(10) && !is_red(13) && is_red(23) && !is_red(20));
        assert_eq!(by_side, by_polygon, "{turns}");
    }
}

#[test]
fn a_hole_that_touches_the_border_with_a_vertex_is_a_hole_whichever_vertex_comes_first() {
    let mut hole = ["[24, 0]", "[-8, 14]", "[-8, -14]"];
    for _ in 0..3 {
        let text = map(&format!(
            "[[layer]]\nfeatures = [{{ polygon = [[[-24, -24], [24, -24], [24, 24], [-24, 24]], [{}]] }}]\n\
             outline = {{ color = \"#ff0000\", width_m = 6, mode = \"inset\" }}\n",
            hole.join(", ")
        ));
        let image = draw(&text, &[]).image;
        let is_red = |x: usize, y: usize| image.at(x, y)[1] < 128;
        // West of the hole's western side, and east of it.
        assert!(is_red(22, 32) && !is_red(25, 32), "{hole:?}");
        hole.rotate_left(1);
    }
}

#[test]
fn thin_lines_are_dashed_and_more_samples_close_the_gaps() {
    // Fig. 4.9a.
    let text = map(
        "[[layer]]\nfeatures = [{ line = [[-30, -7], [30, 6]] }]\nline = { color = \"#000000\", width_m = 0.3 }\n",
    );
    let gaps = |of: &[&str]| {
        let image = draw(&text, of).image;
        (4..60).filter(|x| (0..64).all(|y| image.at(*x, y)[0] == 255)).count()
    };
    let [one, eight, many] = [gaps(&["samples=1"]), gaps(&["samples=8"]), gaps(&["samples=64"])];
    assert!(one > 20 && eight < one / 4 && many == 0, "{one} {eight} {many}");
    assert_eq!(gaps(&["edges=analytic"]), 0);
}

#[test]
fn settings_that_mean_nothing_are_refused_by_name() {
    for (change, what) in [
        ("grid=0", "grid"),
        ("grid=100000", "grid"),
        ("leaf_capacity=0", "leaf_capacity"),
        ("depth=17", "depth"),
        ("samples=2", "samples"),
    ] {
        let change = Override::parse(&format!("technique.static-decal.{change}")).unwrap();
        let refused = SceneFile::parse(&map(""), None, &[change]).unwrap_err().to_string();
        assert!(refused.contains(what), "{refused}");
    }
    let both = ["edges=analytic", "leaf_polygons=clipped"]
        .map(|change| Override::parse(&format!("technique.static-decal.{change}")).unwrap());
    let refused = SceneFile::parse(&map(""), None, &both).unwrap_err().to_string();
    assert!(refused.contains("leaf_polygons"), "{refused}");
}

#[test]
fn a_scene_without_decals_is_bare_and_polygons_over_everything_are_everywhere() {
    assert_eq!(colors(&draw(&map(""), &[]).image), [[255, 255, 255, 255]]);
    let everything = map(
        "[[layer]]\nfeatures = [{ polygon = [[-9e6, -9e6], [9e6, -9e6], [9e6, 9e6], [-9e6, 9e6]] }]\nfill = { color = \"#ff0000\" }\n",
    );
    for of in [&["grid=1"][..], &["grid=900"], &["preparation=whole"]] {
        assert_eq!(colors(&draw(&everything, of).image), [[255, 0, 0, 255]], "{of:?}");
    }
}

#[test]
fn a_point_on_the_centre_line_of_an_outline_lies_on_both_of_its_sides() {
    // Centres of pixels lie on the eastern edge, however it turns.
    for ring in
        ["[-20, -20], [10.5, -20], [10.5, 20], [-20, 20]", "[-20, 20], [10.5, 20], [10.5, -20], [-20, -20]"]
    {
        for mode in ["inset", "offset"] {
            let text = map(&format!(
                "[[layer]]\nfeatures = [{{ polygon = [{ring}] }}]\noutline = {{ color = \"#ff0000\", width_m = 2.5, mode = \"{mode}\" }}\n"
            ));
            let image = draw(&text, &["samples=1"]).image;
            let is_red = |x: usize| image.at(x, 32)[1] == 0;
            let inside_and_outside = [is_red(41), is_red(43)];
            assert_eq!(
                (is_red(42), inside_and_outside),
                (true, [mode == "inset", mode == "offset"]),
                "{ring} {mode}"
            );
        }
    }
}
