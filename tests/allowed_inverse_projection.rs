//! What inverse projection's pictures and buffers may be: what imitated machines and a client of its own draw is allowed, what bugs draw is not.
#![cfg(feature = "render")]

mod drawing;
mod judged;

use drapery::buffer::{Buffer, Plane, Values};
use drapery::compare::{Allowed, StageRange};
use drapery::scene_file::{Override, SceneFile};
use drapery::stage::Stage;
use drapery::technique::{Frame, Kind};
use drawing::{frame_of, scene, stage};
use judged::{MACHINES, allowed_of, best, outside, wide};
use std::path::Path;

const KIND: Kind = Kind::InverseProjection;

const BUFFERS: [&str; 5] = ["depth", "triangle", "quad", "class", "edges"];

/// A golden's scene, smaller, with changes.
fn golden(name: &str, changes: &[&str]) -> Stage {
    let changes = changes.iter().chain(&["image.width=60", "image.height=40"]);
    let changes: Vec<Override> = changes.map(|c| Override::parse(c).unwrap()).collect();
    let path = format!("{}/golden/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let file = SceneFile::read(Path::new(&path), &changes).unwrap_or_else(|e| panic!("{e}"));
    let (scene, surface) = drapery::source::load::load(&file, &|_| {}).unwrap_or_else(|e| panic!("{e}"));
    Stage::new(scene, surface).unwrap_or_else(|e| panic!("{e}"))
}

/// The pixels of a buffer that are not what they may be.
fn strange(range: &StageRange, plane: &Plane, origin: [f64; 2]) -> Vec<usize> {
    let values: Vec<f64> = match &plane.values {
        Values::U8(values) => values.iter().map(|v| f64::from(*v)).collect(),
        Values::U32(values) => values.iter().map(|v| f64::from(*v)).collect(),
        Values::F64(values) => values.clone(),
        _ => panic!("{} has other values", plane.name),
    };
    match range {
        StageRange::Between { components, lo, hi } => {
            let is_place = *components == 8;
            let at = |k: usize| values[k] + if is_place { origin[k % 2] } else { 0.0 };
            let fits = |k: &usize| lo[*k] <= at(*k) && at(*k) <= hi[*k];
            (0..values.len()).filter(|k| !fits(k)).map(|k| k / components).collect()
        }
        StageRange::OneOf(rows) => {
            let pixels = rows.chunk_by(|a, b| a.0 == b.0);
            let wrong = pixels.filter(|of| !of.iter().any(|row| row.1 == values[of[0].0 as usize]));
            wrong.map(|of| of[0].0 as usize).collect()
        }
    }
}

fn strange_buffers(all: &Allowed, stage: &Stage, frame: &Frame) -> Vec<(String, usize)> {
    let origin = stage.scene.origin.truncate().to_array();
    let of = |name: &str| frame.planes.iter().find(|plane| plane.name == name).unwrap();
    let count =
        |s: &drapery::compare::Stage| (s.buffer.clone(), strange(&s.range, of(&s.buffer), origin).len());
    all.stages.iter().map(count).filter(|(_, count)| *count > 0).collect()
}

#[test]
fn what_machines_draw_is_allowed_and_little_else_is() {
    let scenes = [
        "inverse-projection/samples-5",
        "inverse-projection/silhouettes",
        "inverse-projection/smear",
        "inverse-projection/true-corners",
        "inverse-projection/winding",
        "style/layer-opacity",
        "style/outlines",
        "terrain/vertical-scale",
        "view/orthographic",
        "globe/region",
    ];
    let mut shares = Vec::new();
    for name in scenes {
        let all = allowed_of(KIND, &golden(name, &[]));
        let share = |of| wide(of) as f64 / (all.width * all.height) as f64;
        let wide: Vec<f64> = all.hypotheses.iter().map(share).collect();
        assert!(wide[0] < 0.05, "{name}: {wide:?}");
        shares.push(wide[0]);
        for machine in MACHINES {
            let stage = golden(name, machine);
            let frame = frame_of(KIND, &stage, &BUFFERS);
            let missed: Vec<usize> = all.hypotheses.iter().map(|h| outside(h, &frame.image)).collect();
            assert_eq!(best(&all, &frame.image), 0, "{name} {machine:?}: {missed:?}");
            // Depths are those of the format that the scene says.
            if !machine.iter().any(|change| change.contains("depth")) {
                assert_eq!(strange_buffers(&all, &stage, &frame), [], "{name} {machine:?}");
            }
        }
    }
    let mean = shares.iter().sum::<f64>() / shares.len() as f64;
    assert!(mean < 0.02, "{mean}");
}

const HILLS: &str = r#"kind = "fbm", seed = 3, posts = [65, 65], cell_m = 10.0, height_m = 120.0"#;

/// A road that crosses itself and a river over a lake, on hills, seen from the south; a side of a ridge is hidden.
fn crossing() -> String {
    let layers = "[[layer]]\nfeatures = [{ polygon = [[-150, -150], [120, -180], [60, 20], [160, 150], [-120, 90]] }]\n\
         fill = { color = \"#3388ff\", opacity = 0.6 }\noutline = { color = \"#003366\", width_m = 6.0 }\n\
         [[layer]]\nfeatures = [{ line = [[-280, -200], [100, 60], [60, 150], [-100, 60], [200, -250]] }, { line = [[-200, 200], [-20, -40], [200, -150]] }]\n\
         line = { color = \"#ff7f00\", width_m = 12 }\n";
    scene(HILLS, "eye = [40, -330, 130], target = [0, 0, 40]", layers)
}

#[test]
fn what_bugs_draw_is_not_allowed() {
    let of = stage(&crossing(), &["device.subpixel_bits=8"]);
    let all = allowed_of(KIND, &of);
    let right = frame_of(KIND, &of, &BUFFERS);
    assert_eq!(best(&all, &right.image), 0);
    let bugs: [(&str, &str, &str, &str); 9] = [
        ("wider by a twentieth", "width_m = 12 }", "width_m = 12.6 }", ""),
        ("a line missing", ", { line = [[-200, 200], [-20, -40], [200, -150]] }", "", ""),
        ("half a pixel up", "target = [0, 0, 40]", "target = [0, 0, 41.9]", ""),
        ("opacity", "opacity = 0.6", "opacity = 0.58", ""),
        ("a vertex moved", "[60, 20]", "[61.5, 20]", ""),
        ("corners", "", "", "technique.inverse-projection.corners=\"true\""),
        ("winding numbers", "", "", "technique.inverse-projection.point_in_polygon=\"winding\""),
        ("one sample", "", "", "technique.inverse-projection.samples=1"),
        ("smear", "", "", "technique.inverse-projection.silhouette=\"smear\""),
    ];
    let mut let_through = Vec::new();
    for (name, from, to, change) in bugs {
        let text = crossing().replacen(from, to, 1);
        let changes: Vec<&str> = [change].into_iter().filter(|change| !change.is_empty()).collect();
        let frame = frame_of(KIND, &stage(&text, &changes), &BUFFERS);
        if best(&all, &frame.image) == 0 {
            let_through.push(name);
        }
    }
    assert!(let_through.is_empty(), "{let_through:?}");
}

/// A client of its own, which reads quadrilaterals and draws one opaque line on white ground.
#[derive(Clone)]
struct Client {
    samples: usize,
    /// Where in its part of the pixel a sample lies.
    offset: f64,
    /// Whether u and v are exchanged.
    is_transposed: bool,
    /// The order in which it takes the corners.
    order: [usize; 4],
    asks_pedals: bool,
    fills_whole_pixels: bool,
    outward: f64,
}

const RIGHT: Client = Client {
    samples: 3,
    offset: 0.5,
    is_transposed: false,
    order: [0, 1, 2, 3],
    asks_pedals: true,
    fills_whole_pixels: true,
    outward: 1.0,
};

type Point = [f64; 2];

fn cross(a: Point, b: Point, p: Point) -> f64 {
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

/// Whether a ring holds a point, by crossings.
fn holds(ring: &[Point], p: Point) -> bool {
    let edges = ring.iter().zip(ring.iter().cycle().skip(1));
    let crossed =
        edges.filter(|(a, b)| (a[1] > p[1]) != (b[1] > p[1]) && (cross(**a, **b, p) > 0.0) == (b[1] > a[1]));
    crossed.count() % 2 == 1
}

fn meets(quad: &[Point; 4], a: Point, b: Point) -> bool {
    let is_crossed = |k: usize| {
        let (p, q) = (quad[k], quad[(k + 1) % 4]);
        cross(a, b, p) * cross(a, b, q) <= 0.0 && cross(p, q, a) * cross(p, q, b) <= 0.0
    };
    (0..4).any(is_crossed) || holds(quad, a)
}

impl Client {
    /// The share of a pixel that the line in an outline, whose outside is on the right, covers.
    fn covered(&self, quad: &[Point; 4], outline: &[Point]) -> f64 {
        let edges = outline.iter().copied().zip(outline.iter().copied().cycle().skip(1));
        let near: Vec<(Point, Point)> = edges.filter(|(a, b)| meets(quad, *a, *b)).collect();
        if near.is_empty() {
            return f64::from(u8::from(self.fills_whole_pixels && holds(outline, quad[0])));
        }
        let [a, b, c, d] = self.order.map(|k| quad[k]);
        let place = |k: usize| (k as f64 + self.offset) / self.samples as f64;
        let mut count = 0;
        for (i, j) in (0..self.samples).flat_map(|i| (0..self.samples).map(move |j| (i, j))) {
            let (u, v) = if self.is_transposed { (place(j), place(i)) } else { (place(i), place(j)) };
            let mix =
                |k: usize| (a[k] * (1.0 - u) + b[k] * u) * (1.0 - v) + (d[k] * (1.0 - u) + c[k] * u) * v;
            let at = [mix(0), mix(1)];
            let flag: i32 = near.iter().map(|(from, to)| self.vote(*from, *to, at)).sum();
            count += usize::from(flag > 0);
        }
        count as f64 / (self.samples * self.samples) as f64
    }

    /// Codes A and B.
    fn vote(&self, from: Point, to: Point, at: Point) -> i32 {
        let along = minus(to, from);
        let foot = dot(minus(at, from), along);
        if self.asks_pedals && !(0.0..=dot(along, along)).contains(&foot) {
            return 0;
        }
        let outward = [along[1] * self.outward, -along[0] * self.outward];
        let towards = [from[0] + to[0] - 2.0 * at[0], from[1] + to[1] - 2.0 * at[1]];
        if dot(towards, outward) >= 0.0 { 1 } else { -1 }
    }

    /// The picture over a frame's quadrilaterals.
    fn picture(&self, frame: &Frame, outline: &[Point]) -> Buffer<[u8; 4]> {
        let plane = frame.planes.iter().find(|plane| plane.name == "quad").unwrap();
        let Values::F64(values) = &plane.values else { panic!("other values") };
        let pixels = values.chunks(8).zip(frame.image.values()).map(|(of, ground)| {
            let quad = [0, 2, 4, 6].map(|k| [of[k], of[k + 1]]);
            if !of[0].is_finite() {
                return *ground;
            }
            let share = self.covered(&quad, outline);
            let code = |of_line: f64| (255.0 + share * (of_line - 255.0) + 0.5) as u8;
            [code(255.0), code(127.0), code(0.0), 255]
        });
        Buffer::from_values(frame.image.width(), frame.image.height(), pixels.collect())
    }
}

/// The outline of a line of three points, half a width aside: down on its right, back on its left.
fn outline([a, b, c]: [Point; 3], half: f64) -> Vec<Point> {
    let unit = |from: Point, to: Point| {
        let way = minus(to, from);
        let length = dot(way, way).sqrt();
        [way[0] / length, way[1] / length]
    };
    let (first, second) = (unit(a, b), unit(b, c));
    let right = |way: Point| [way[1] * half, -way[0] * half];
    let (p, q) = (right(first), right(second));
    let by = 1.0 / (1.0 + dot(first, second));
    let bend = [(p[0] + q[0]) * by, (p[1] + q[1]) * by];
    let aside = |at: Point, by: Point, sign: f64| [at[0] + sign * by[0], at[1] + sign * by[1]];
    let forth = [aside(a, p, 1.0), aside(b, bend, 1.0), aside(c, q, 1.0)];
    forth.into_iter().chain([aside(c, q, -1.0), aside(b, bend, -1.0), aside(a, p, -1.0)]).collect()
}

#[test]
fn a_client_of_its_own_is_allowed_until_a_bug_is_planted_in_it() {
    let layer = "[[layer]]\nfeatures = [{ line = [[-250, -100], [90, 40], [-60, 140]] }]\nline = { color = \"#ff7f00\", width_m = 26 }\n";
    let text = scene(HILLS, "eye = [40, -330, 130], target = [0, 0, 40]", layer);
    let of = stage(&text, &[]);
    let (all, frame) = (allowed_of(KIND, &of), frame_of(KIND, &of, &["quad"]));
    let outline = outline([[-250.0, -100.0], [90.0, 40.0], [-60.0, 140.0]], 13.0);
    let clients: [(&str, Client, bool); 8] = [
        ("right", RIGHT, true),
        // The mean of samples on a regular grid is the same in any order.
        ("transposed", Client { is_transposed: true, ..RIGHT }, true),
        ("samples at the corners of their parts", Client { offset: 0.0, ..RIGHT }, false),
        ("two by two samples", Client { samples: 2, ..RIGHT }, false),
        ("corners crossed", Client { order: [0, 1, 3, 2], ..RIGHT }, false),
        ("Code A alone", Client { asks_pedals: false, ..RIGHT }, false),
        ("whole pixels left out", Client { fills_whole_pixels: false, ..RIGHT }, false),
        ("normals inward", Client { outward: -1.0, ..RIGHT }, false),
    ];
    for (name, client, is_right) in clients {
        let image = client.picture(&frame, &outline);
        let missed: Vec<usize> = all.hypotheses.iter().map(|h| outside(h, &image)).collect();
        assert_eq!(best(&all, &image) == 0, is_right, "{name}: {missed:?}");
    }
}
