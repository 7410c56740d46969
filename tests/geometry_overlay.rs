//! Geometry overlay (Wartell et al. 2003): lines on every mesh, depth fighting and bleeding, what OpenGL makes of lines.
#![cfg(feature = "render")]

mod drawing;

use drapery::buffer::Values;
use drapery::technique::{self, Frame, Kind};
use drawing::{count, frame_of, scene, stage};

const NADIR: &str =
    "eye = [3, 5, 400], target = [3, 5, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = 300";
const OBLIQUE: &str = "eye = [-60, -520, 330], target = [0, 0, 20]";
const SINE: &str = "kind = \"sine\", posts = [129, 129], cell_m = 4, height_m = 20";
const FLAT: &str = "kind = \"plane\", posts = [33, 33], cell_m = 20";
const HILLS: &str = "kind = \"fbm\", seed = 7, posts = [33, 33], cell_m = 20, height_m = 160";
const LINE: &str = "[[layer]]\nfeatures = [{ line = [[-233, -121], [-60, 107], [81, -117], [239, 87]] }]\n\
                    line = { color = \"#aa0022\", width_px = 1, opacity = 0.5 }\n";

fn draw(text: &str, changes: &[&str]) -> Frame {
    frame_of(Kind::GeometryOverlay, &stage(text, changes), &["layer", "clipping", "color"])
}

fn numbers<'f>(frame: &'f Frame, name: &str) -> &'f [u32] {
    match &frame.planes.iter().find(|plane| plane.name == name).unwrap().values {
        Values::U32(values) => values,
        other => panic!("{name} holds {other:?}"),
    }
}

/// How many pixels are not what they are without the layers.
fn painted(frame: &Frame) -> usize {
    numbers(frame, "clipping").iter().filter(|clipping| **clipping != u32::MAX).count()
}

#[test]
fn no_level_of_detail_moves_a_line_that_is_seen_from_above() {
    let text = scene(SINE, NADIR, LINE)
        .replace("color = \"#ffffff\" }", "color = \"#ffffff\", diagonal = \"alternating\" }");
    let full = draw(&text, &[]);
    assert!(painted(&full) > 60, "{}", painted(&full));
    for level in 0..6 {
        let change = format!("terrain.lod.level={level}");
        let frame = draw(&text, &[&change]);
        assert_eq!(frame.image, full.image, "level {level}");
        assert!(numbers(&frame, "layer").iter().any(|layer| *layer >= 2 * level && *layer != u32::MAX));
    }
}

/// Hills with levels, a share of whose quads is not there.
const LEVELS: &str = "kind = \"fbm\", seed = 7, posts = [385, 300], cell_m = 2, height_m = 160";

#[test]
fn borrowed_quads_show_the_same_however_their_clippings_are_found() {
    let text = scene(LEVELS, OBLIQUE, LINE).replace(
        "color = \"#ffffff\" }",
        "color = \"#ffffff\", diagonal = \"alternating\", lod = { error_px = 0.05, borrow = 0.2 } }",
    );
    let stage = stage(&text, &[]);
    let cached = technique::prepare(Kind::GeometryOverlay, &stage).unwrap();
    let view = stage.view().unwrap();
    let frames: Vec<Frame> =
        (0..2).map(|_| cached.frame(&view, &technique::FrameOptions::default()).unwrap()).collect();
    let searched = draw(&text, &["technique.geometry-overlay.borrowed=searched"]);
    assert!(count(&searched, "borrowed_quads") >= 3);
    for frame in &frames {
        assert_eq!(frame.image, searched.image);
        assert_eq!(count(frame, "clippings_drawn"), count(&searched, "clippings_drawn"));
    }
    // The first frame walks over whole quads, and keeps where lines enter.
    let [first, second] = [&frames[0], &frames[1]].map(|frame| count(frame, "clippings_visited"));
    assert_eq!(first, count(&searched, "clippings_visited"));
    assert!(second < first, "{second} {first}");
    assert_eq!(second, count(&frames[1], "clippings_drawn"));
}

#[test]
fn no_line_lies_where_the_mesh_leaves_triangles_out() {
    // A row of posts is missing: at a forced level the triangles around it go.
    let levels = ["terrain.diagonal=alternating", "terrain.lod.level=4"];
    let (scene, surface) = drawing::loaded(&scene(LEVELS, NADIR, LINE), &levels);
    let drapery::scene::Surface::Grid(mut posts) = surface else { panic!("no grid") };
    (0..385).for_each(|column| posts.heights_mut()[150 * 385 + column] = f64::NAN);
    let stage = drapery::stage::Stage::new(scene, drapery::scene::Surface::Grid(posts)).unwrap();
    let frame = frame_of(Kind::GeometryOverlay, &stage, &["clipping", "triangle"]);
    let (clippings, triangles) = (numbers(&frame, "clipping"), numbers(&frame, "triangle"));
    assert!(triangles.iter().filter(|triangle| **triangle == u32::MAX).count() > 300);
    let in_the_air = clippings.iter().zip(triangles).filter(|(c, t)| **c != u32::MAX && **t == u32::MAX);
    // An end of a segment may share a pixel with the border of the hole.
    assert!(in_the_air.count() < 4 && painted(&frame) > 20);
}

#[test]
fn a_tolerance_takes_vertices_within_triangles_and_moves_no_line_further() {
    // A finely twisted line on two large triangles: within a pixel's tolerance it is nearly straight.
    let twist: Vec<String> =
        (-200..200).map(|k| format!("[{k}, {:.2}]", f64::from(k) * 0.4 + f64::from(k % 3) * 0.7)).collect();
    let layer = format!(
        "[[layer]]\nfeatures = [{{ line = [{}] }}]\nline = {{ color = \"#aa0022\", width_px = 1 }}\n",
        twist.join(", ")
    );
    let text = scene("kind = \"plane\", posts = [2, 2], cell_m = 600", NADIR, &layer);
    let points = |tolerance: &str| {
        let frame = draw(&text, &[&format!("technique.geometry-overlay.tolerance_px={tolerance}")]);
        (count(&frame, "points"), count(&frame, "points_drawn"), painted(&frame))
    };
    let (all, full, painted) = points("0");
    assert_eq!(all, full);
    let (same, few, drawn) = points("0.5");
    assert_eq!(same, all);
    assert!(few < all / 10, "{few} of {all}");
    assert!(drawn.abs_diff(painted) < painted / 4);
}

#[test]
fn the_structures_of_the_quads_in_use_are_tables_that_refer_to_one_another() {
    let text = scene(LEVELS, OBLIQUE, LINE).replace(
        "color = \"#ffffff\" }",
        "color = \"#ffffff\", diagonal = \"alternating\", lod = { error_px = 0.5 } }",
    );
    let names = [
        "quads",
        "polylines",
        "quad-clippings",
        "triangle-clippings",
        "line-vertices",
        "crossings",
        "directions",
    ];
    let frame = frame_of(Kind::GeometryOverlay, &stage(&text, &[]), &names);
    let table = |name: &str| {
        let plane = frame.planes.iter().find(|plane| plane.name == name).unwrap();
        let Values::U32(values) = &plane.values else { panic!("{name}") };
        values.chunks(plane.width).map(<[u32]>::to_vec).collect::<Vec<_>>()
    };
    let (quads, lines, sections, clippings) =
        (table("quads"), table("polylines"), table("quad-clippings"), table("triangle-clippings"));
    assert!(quads.len() > 1 && clippings.len() > 500);
    assert_eq!(quads.iter().map(|quad| quad[5] as usize).sum::<usize>(), lines.len());
    assert_eq!(lines.iter().map(|line| line[3] as usize).sum::<usize>(), sections.len());
    assert_eq!(sections.iter().map(|section| section[6] as usize).sum::<usize>(), clippings.len());
    // A clipping's parent is of the next layer and holds its apex in the middle of its longest side.
    let with_parent: Vec<_> = clippings.iter().filter(|clipping| clipping[14] != u32::MAX).collect();
    assert!(with_parent.len() > clippings.len() / 2);
    for clipping in with_parent {
        let parent = &clippings[clipping[14] as usize];
        assert_eq!([parent[2] + parent[4], parent[3] + parent[5]], [2 * clipping[0], 2 * clipping[1]]);
    }
}

#[test]
fn a_line_through_the_middle_of_a_cell_is_as_high_as_its_diagonal() {
    // Heights 0, 10 / 10, 0: the middle is 0 or 10, by the diagonal, and never 5.
    for (diagonal, expected) in [("sw-ne", 0.0), ("nw-se", 10.0)] {
        let text = scene(FLAT, NADIR, LINE);
        let mut stage = stage(&text, &[&format!("terrain.diagonal={diagonal}")]);
        let posts = drapery::scene::Posts::new(
            (2, 2),
            drapery::space::Plan::new(-100.0, -100.0),
            (glam::DVec2::X * 200.0, glam::DVec2::Y * 200.0),
            vec![0.0, 10.0, 10.0, 0.0],
        );
        let surface = drapery::scene::Surface::Grid(posts.unwrap());
        stage.mesh = drapery::terrain::Mesh::new(surface, stage.scene.diagonal).unwrap().into();
        let height = stage.mesh.height_at(drapery::space::Plan::new(0.0, 0.0)).unwrap();
        assert_eq!(height, expected);
        let frame = frame_of(Kind::GeometryOverlay, &stage, &["clipping"]);
        assert_eq!(count(&frame, "fragments"), count(&frame, "fragments_drawn"), "{diagonal}");
        assert!(painted(&frame) > 20);
    }
}

#[test]
fn polygon_offset_ends_the_fighting_of_a_line_with_its_mesh() {
    // Hard case 16: 24 bits between 0.1 and a million metres.
    let machine = [
        "camera.near_m=0.1",
        "camera.far_m=1e6",
        "device.precision=f32",
        "device.depth=unorm24",
        "device.subpixel_bits=8",
    ];
    let mut fought = 0;
    for jitter in 0..25 {
        let [x, z] =
            [f64::from(jitter % 5) * 0.037, f64::from(jitter / 5) * 0.029].map(|v| format!("{v:.3}"));
        let camera = format!("eye = [{x}, -400, {z}], target = [0, 0, -90]").replace(", 0.", ", 120.");
        let text = scene(FLAT, &camera, LINE);
        let calm = draw(&text, &machine);
        assert!(count(&calm, "fragments") > 50);
        assert_eq!(count(&calm, "fragments_drawn"), count(&calm, "fragments"), "{camera}");
        let none =
            ["technique.geometry-overlay.offset_factor=0", "technique.geometry-overlay.offset_units=0"];
        let bare = draw(&text, &[&machine[..], &none[..]].concat());
        fought += count(&bare, "fragments") - count(&bare, "fragments_drawn");
    }
    assert!(fought > 100, "{fought}");
}

#[test]
fn too_much_polygon_offset_lets_hidden_lines_bleed_through() {
    let text = scene(HILLS, "eye = [-60, -520, 130], target = [0, 0, 20]", LINE);
    let drawn = |units: &str| {
        count(&draw(&text, &[&format!("technique.geometry-overlay.offset_units={units}")]), "fragments_drawn")
    };
    let (usual, much) = (drawn("1"), drawn("1e9"));
    assert!(usual < much, "{usual} {much}");
    assert_eq!(drawn("2"), usual);
}

#[test]
fn a_line_that_passes_the_eye_is_cut_there_and_never_mirrored() {
    // Hard case 4: the far end lies behind the eye. What is drawn lies on one straight line of the picture.
    let line = "[[layer]]\nfeatures = [{ line = [[0, 10], [3, -300]] }]\nline = { color = \"#aa0022\", width_px = WIDTH }\n";
    for width in ["1", "8"] {
        let text = scene(FLAT, "eye = [1, -100, 12], target = [0, 60, 0]", &line.replace("WIDTH", width));
        let frame = draw(&text, &[]);
        let rows: Vec<usize> = numbers(&frame, "clipping")
            .iter()
            .enumerate()
            .filter(|(_, clipping)| **clipping != u32::MAX)
            .map(|(pixel, _)| pixel / 96)
            .collect();
        assert_eq!(rows.last(), Some(&63), "{width}: it runs out of the picture below");
        assert!(rows.windows(2).all(|pair| pair[1] <= pair[0] + 1), "{width}: without a gap");
        assert!(rows[0] > 10, "{width}: {}", rows[0]);
    }
}

#[test]
fn a_fill_is_drawn_by_its_border_alone_one_pixel_wide() {
    let of = |style: &str| {
        let polygon = "features = [{ polygon = [[-200, -100], [0, -130], [120, 140], [-150, 160]] }]";
        draw(&scene(FLAT, NADIR, &format!("[[layer]]\n{polygon}\n{style}\n")), &[])
    };
    let fill = of("fill = { color = \"#208040\" }");
    let outline = of("outline = { color = \"#208040\", width_px = 1 }");
    assert!(painted(&fill) > 80);
    assert_eq!(fill.image, outline.image);
}

#[test]
fn a_stipple_leaves_gaps_and_runs_through_strips() {
    let text = scene(HILLS, OBLIQUE, LINE);
    let fragments = |changes: &[&str]| count(&draw(&text, changes), "fragments");
    let solid = fragments(&[]);
    let half = "technique.geometry-overlay.stipple=21845";
    let strips = "technique.geometry-overlay.primitives=strips";
    // Every other fragment, counted through each quad clipping, or anew in each segment.
    let through = fragments(&[half, strips]);
    assert!(through.abs_diff(solid / 2) <= 2, "{through} of {solid}");
    assert!(fragments(&[half]) > through);
    assert_eq!(fragments(&["technique.geometry-overlay.stipple=0"]), 0);
}

#[test]
fn widths_are_those_of_the_style_or_one_pixel() {
    let wide = LINE.replace("width_px = 1", "width_px = 5");
    let text = scene(FLAT, NADIR, &wide);
    let (five, one) = (draw(&text, &[]), draw(&text, &["technique.geometry-overlay.widths=one"]));
    assert_eq!(one.image, draw(&scene(FLAT, NADIR, LINE), &[]).image);
    let ratio = count(&five, "fragments") as f64 / count(&one, "fragments") as f64;
    assert!((ratio - 5.0).abs() < 0.05, "{ratio}");
    // 300 m are 64 pixels: 23.4 m are five.
    let metres = scene(FLAT, NADIR, &LINE.replace("width_px = 1", "width_m = 23.4"));
    assert_eq!(draw(&metres, &[]).image, five.image);
}

#[test]
fn a_wide_line_beside_the_picture_reaches_into_it() {
    // A metre a pixel, the picture begins 4 m east of the quad that the line lies in: quads are 12.8 m wide.
    let camera = "eye = [52, 0, 400], target = [52, 0, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = 64";
    let line = "[[layer]]\nfeatures = [{ line = [[-8, -20], [-8, 20]] }]\nline = { color = \"#aa0022\", width_px = 31 }\n";
    let text = scene("kind = \"plane\", posts = [513, 513], cell_m = 0.1", camera, line);
    let frame = draw(&text, &["device.max_line_width_px=40"]);
    assert!((110..=170).contains(&painted(&frame)), "{}", painted(&frame));
    assert_eq!(painted(&draw(&text, &["device.max_line_width_px=20"])), 0);
}

#[test]
fn antialiased_lines_cover_as_much_as_they_are_wide() {
    // Hard case 27, from above: the sum of shares is length times width.
    for width in [1.0, 3.0, 7.0] {
        let line = format!(
            "[[layer]]\nfeatures = [{{ line = [[-120, -61], [130, 97]] }}]\nline = {{ color = \"#000000\", width_px = {width} }}\n"
        );
        let text = scene(FLAT, NADIR, &line);
        let frame = draw(&text, &["technique.geometry-overlay.lines=antialiased"]);
        let Some(Values::F64(colors)) =
            frame.planes.iter().find(|p| p.name == "color").map(|p| p.values.clone())
        else {
            panic!("no colours")
        };
        let covered: f64 = colors.chunks(4).map(|color| 1.0 - color[1]).sum();
        let length = (250f64 * 250.0 + 158.0 * 158.0).sqrt() / 300.0 * 64.0;
        assert!((covered / length - width).abs() < 1e-3 * width, "{covered} {}", length * width);
    }
}

#[test]
fn what_is_no_line_or_no_grid_is_refused_with_the_reason() {
    let points =
        "[[layer]]\nfeatures = [{ points = [[0, 0]] }]\npoint = { color = \"#222222\", width_m = 20 }\n";
    let mut stage = stage(&scene(FLAT, NADIR, points), &[]);
    let said = technique::applies(Kind::GeometryOverlay, &stage).unwrap_err().to_string();
    assert!(said.contains("has points"), "{said}");
    let corners = [(0.0, 0.0), (9.0, 0.0), (0.0, 9.0)].map(|(x, y)| drapery::space::World::new(x, y, 0.0));
    let surface = drapery::scene::Surface::Points(corners.to_vec());
    stage.mesh = drapery::terrain::Mesh::new(surface, stage.scene.diagonal).unwrap().into();
    let said = technique::applies(Kind::GeometryOverlay, &stage).unwrap_err().to_string();
    assert!(said.contains("is no grid"), "{said}");
}
