//! The truth's pieces against exact rational arithmetic: at a random point of a piece, which triangle is seen and which items
//! hold the point is found again from the definitions of `docs/semantics.md`, without a rounding.

use super::*;
use crate::draw_list::DrawList;
use crate::footprint::{Footprints, PixelSize};
use crate::scene::{
    Camera, Cap, Color, Feature, Fill, Join, Layer, Line, Outline, OutlineMode, Posts, Rule, Scene, Shape,
    Style, Surface, Width,
};
use crate::scene_file::SceneFile;
use crate::space::Plan;
use crate::terrain::{SurfaceTriangle, SurfaceVertex};
use crate::truth::Budget;
use crate::truth::polygon::Polygon;
use crate::truth::visible::SPECK;
use dashu::rational::Relaxed;
use glam::{DMat2, DMat3, DVec2};

type R = Relaxed;

fn rational(v: f64) -> R {
    R::try_from(v).unwrap()
}

/// The same number with no common factors: small numbers keep exact arithmetic quick.
fn lean(v: R) -> R {
    v.canonicalize().relax()
}

fn zero() -> R {
    R::ZERO
}

/// Numbers from a counter: the same on every machine.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Any of the first `n` numbers.
    fn below(&mut self, n: u64) -> u64 {
        self.roll() % n
    }

    /// A multiple of 1/64.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + ((high - low) * (self.roll() >> 11) as f64 / (1u64 << 53) as f64 * 64.0).floor() / 64.0
    }
}

fn color(dice: &mut Dice) -> Color {
    let alpha = if dice.below(3) == 0 { 1.0 } else { 0.5 };
    Color([dice.between(0.0, 1.0), dice.between(0.0, 1.0), dice.between(0.0, 1.0), alpha])
}

fn line(dice: &mut Dice) -> Line {
    let width = match dice.below(4) {
        0 => Width::Pixels(dice.between(0.5, 6.0)),
        _ => Width::Metres(dice.between(0.5, 12.0)),
    };
    let join = match dice.below(4) {
        0 => Join::Round,
        1 => Join::Bevel,
        // At 1.25 a turn of the triple (7, 24, 25) is exactly on the limit.
        _ => Join::Miter { limit: [1.25, 2.0, 4.0, 100.0][dice.below(4) as usize] },
    };
    let cap = [Cap::Butt, Cap::Square, Cap::Round][dice.below(3) as usize];
    Line { color: color(dice), width, join, cap }
}

fn points(dice: &mut Dice, count: u64) -> Vec<Plan> {
    (0..count).map(|_| Plan::new(dice.between(-28.0, 28.0), dice.between(-28.0, 28.0))).collect()
}

fn rings(dice: &mut Dice) -> Vec<Vec<Plan>> {
    (0..1 + dice.below(2)).map(|_| points(dice, 5)).collect()
}

fn layer(dice: &mut Dice) -> Layer {
    let features = 1 + dice.below(2) as usize;
    let kind = dice.below(5);
    let style = if kind < 2 {
        Style { line: Some(line(dice)), ..Style::default() }
    } else if kind == 2 {
        Style { point: Some(line(dice)), ..Style::default() }
    } else {
        let rule = if dice.below(2) == 0 { Rule::EvenOdd } else { Rule::NonZero };
        let mode = [OutlineMode::Inset, OutlineMode::Normal, OutlineMode::Offset][dice.below(3) as usize];
        let fill = (dice.below(3) > 0).then(|| Fill { color: color(dice), rule });
        let outline = (fill.is_none() || dice.below(2) == 0).then(|| Outline { line: line(dice), mode });
        Style { fill, outline, ..Style::default() }
    };
    let features = (0..features).map(|index| {
        let shape = match kind {
            0 | 1 => Shape::Line(vec![{
                let count = 2 + dice.below(4);
                points(dice, count)
            }]),
            2 => Shape::Points(points(dice, 3)),
            _ => match 1 + dice.below(4) {
                2 => Shape::MultiPolygon((0..3).map(|_| rings(dice)).collect()),
                _ => Shape::Polygon(rings(dice)),
            },
        };
        Feature { index, style: 0, shape }
    });
    Layer::uniform("layer", style, features.collect())
}

/// A scene of a few rough triangles and a few features, seen from near; `None` where the triangles have no mesh.
fn scene(dice: &mut Dice) -> Option<(Scene, Mesh)> {
    let text = "schema = 1\nimage = { width = 12, height = 9 }\nterrain.generate = { kind = \"plane\", posts = [3, 3], \
                cell_m = 10.0 }\n[[layer]]\nfeatures = [ { line = [[0, 0], [5, 5]] } ]\nline = { color = \"#ff0000\", width_m = 1 }";
    let file = SceneFile::parse(text, None, &[]).unwrap();
    let (mut scene, _) = crate::source::load::load(&file, &|_| {}).unwrap();
    scene.layers = (0..1 + dice.below(3)).map(|_| layer(dice)).collect();
    let eye = World::new(dice.between(-50.0, 50.0), dice.between(-50.0, 50.0), dice.between(5.0, 60.0));
    let target = World::new(dice.between(-20.0, 20.0), dice.between(-20.0, 20.0), dice.between(-5.0, 10.0));
    (scene.camera.eye, scene.camera.target) = (eye, target);
    scene.camera.near_m = 0.5;
    scene.camera.projection = match dice.below(3) {
        0 => crate::scene::Projection::Orthographic { height_m: dice.between(5.0, 60.0) },
        _ => crate::scene::Projection::Perspective { fov_y_deg: dice.between(10.0, 80.0) },
    };
    let surface = if dice.below(2) == 0 {
        let heights = (0..25).map(|_| dice.between(0.0, 15.0)).collect();
        let steps = (DVec2::X * 12.5, DVec2::Y * 12.5);
        Surface::Grid(Posts::new((5, 5), Plan::new(-25.0, -25.0), steps, heights).unwrap())
    } else {
        let corners =
            [(-30.0, -30.0), (30.0, -30.0), (30.0, 30.0), (-30.0, 30.0)].map(|(x, y)| Plan::new(x, y));
        let inner = points(dice, 8);
        let all = corners.into_iter().chain(inner);
        Surface::Points(all.map(|p| World::new(p.x, p.y, dice.between(0.0, 15.0))).collect())
    };
    let mesh = Mesh::new(surface, scene.diagonal).ok()?;
    if dice.below(2) == 0 {
        return Some((scene, mesh));
    }
    let mesh = leaning(dice, &mesh, &mut scene.camera);
    Some((scene, mesh))
}

/// A mesh and a camera in a world that is turned, sheared and mirrored without a rounding (so that triangles cross no more than they
/// did), over plan points that lie anywhere near: one in eight on a line.
fn leaning(dice: &mut Dice, mesh: &Mesh, camera: &mut Camera) -> Mesh {
    let mut numbers = |count: usize| (0..count).map(|_| dice.between(-1.25, 1.25)).collect::<Vec<f64>>();
    let (of_world, of_plan) = (numbers(9), numbers(4));
    let turn = DMat3::from_cols_slice(&of_world) + DMat3::IDENTITY;
    let turn = if turn.determinant().abs() > 0.25 { turn } else { DMat3::IDENTITY };
    let flat = DMat2::from_cols_slice(&of_plan);
    let flat = if dice.below(8) == 0 { DMat2::from_cols(flat.x_axis, flat.x_axis) } else { flat };
    // In a small world it is the plan that is known least.
    let size = [1.0, 1.0 / 64.0][dice.below(2) as usize];
    let place = |p: World| World::from(turn * p.to_vec() * size);
    let vertices = mesh.vertices().map(|vertex| {
        let off = DVec2::new(dice.between(-2.0, 2.0), dice.between(-2.0, 2.0));
        SurfaceVertex {
            world: place(vertex.world),
            plan: Plan::from(flat * vertex.plan.to_vec() + off),
            ..vertex
        }
    });
    let vertices = vertices.collect();
    let triangles = (0..mesh.triangle_ids()).filter_map(|id| mesh.corners(id)).collect();
    (camera.eye, camera.target, camera.up) = (place(camera.eye), place(camera.target), turn * camera.up);
    camera.near_m *= size;
    if let crate::scene::Projection::Orthographic { height_m } = &mut camera.projection {
        *height_m *= size;
    }
    Mesh::of_surface(vertices, triangles).unwrap()
}

type V3 = [R; 3];

fn vector(v: glam::DVec3) -> V3 {
    [rational(v.x), rational(v.y), rational(v.z)]
}

fn minus(a: &V3, b: &V3) -> V3 {
    [0, 1, 2].map(|k| a[k].clone() - b[k].clone())
}

fn plus_times(a: &V3, b: &V3, by: &R) -> V3 {
    [0, 1, 2].map(|k| a[k].clone() + b[k].clone() * by.clone())
}

fn cross(a: &V3, b: &V3) -> V3 {
    let part = |i: usize, j: usize| a[i].clone() * b[j].clone() - a[j].clone() * b[i].clone();
    [part(1, 2), part(2, 0), part(0, 1)]
}

fn dot(a: &V3, b: &V3) -> R {
    (0..3).fold(zero(), |sum, k| sum + a[k].clone() * b[k].clone())
}

/// The ray of a screen point as the camera's stored numbers define it.
fn ray(frame: &ViewFrame, at: [f64; 2]) -> (V3, V3) {
    let half = |n: usize| rational(n as f64 / 2.0);
    let pixel = rational(frame.lens().pixel());
    let x = (rational(at[0]) - half(frame.width())) * pixel.clone();
    let y = (half(frame.height()) - rational(at[1])) * pixel;
    let offset = plus_times(
        &plus_times(&[zero(), zero(), zero()], &vector(frame.right()), &x),
        &vector(frame.up()),
        &y,
    );
    let (eye, forward) = (vector(frame.eye().to_vec()), vector(frame.forward()));
    let one = R::ONE;
    match frame.lens() {
        Lens::Central { .. } => (eye, plus_times(&forward, &offset, &one).map(lean)),
        Lens::Parallel { .. } => (plus_times(&eye, &offset, &one).map(lean), forward),
    }
}

/// Whether a ray surely passes a triangle by: doubles far from any doubt.
fn passes_by(frame: &ViewFrame, at: [f64; 2], triangle: &[World; 3]) -> bool {
    let ray = frame.ray(crate::space::Screen::new(at[0], at[1]));
    let [a, b, c] = triangle.map(|p| p - ray.from);
    let along = (ray.through - ray.from) / frame.reach();
    let side = |p: DVec3, q: DVec3| p.cross(q).dot(along) / (p.length() * q.length());
    let sides = [side(a, b), side(b, c), side(c, a)];
    sides.iter().any(|s| *s > 1e-6) && sides.iter().any(|s| *s < -1e-6)
}

/// Where a ray meets a triangle: its parameter, if it is at least `near`, and the weights of the second and third corner.
fn meet(from: &V3, along: &V3, triangle: &[World; 3], near: f64) -> Option<(R, [R; 2])> {
    let [a, b, c] = triangle.map(|p| vector(p.to_vec()));
    let (u, v) = (minus(&b, &a), minus(&c, &a));
    let normal = cross(&u, &v);
    let facing = dot(&normal, along);
    if facing == zero() {
        return None;
    }
    let t = dot(&normal, &minus(&a, from)) / facing;
    if t < rational(near) {
        return None;
    }
    let from_a = minus(&plus_times(from, along, &t), &a);
    let (of_b, of_c) = (dot(&cross(&v, &normal), &from_a), dot(&cross(&normal, &u), &from_a));
    let whole = dot(&normal, &normal);
    let is_met = of_b >= zero() && of_c >= zero() && of_b.clone() + of_c.clone() <= whole;
    is_met.then(|| (t, [of_b / whole.clone(), of_c / whole].map(lean)))
}

type V2 = [R; 2];

fn flat(p: Plan) -> V2 {
    [rational(p.x), rational(p.y)]
}

fn sub(a: &V2, b: &V2) -> V2 {
    [a[0].clone() - b[0].clone(), a[1].clone() - b[1].clone()]
}

fn inner(a: &V2, b: &V2) -> R {
    a[0].clone() * b[0].clone() + a[1].clone() * b[1].clone()
}

fn perp(a: &V2, b: &V2) -> R {
    a[0].clone() * b[1].clone() - a[1].clone() * b[0].clone()
}

fn square(a: R) -> R {
    a.clone() * a
}

/// A seen point: in the plan, and its squared distance from the eye.
struct Seen {
    plan: V2,
    eye_squared: R,
}

fn in_rings(rings: &[Vec<Plan>], rule: Rule, p: &V2) -> bool {
    let mut turns = 0;
    for ring in rings {
        for k in 0..ring.len() {
            let (a, b) = (flat(ring[k]), flat(ring[(k + 1) % ring.len()]));
            let (up, down) = (a[1] <= p[1] && b[1] > p[1], b[1] <= p[1] && a[1] > p[1]);
            let side = perp(&sub(&b, &a), &sub(p, &a));
            turns += i32::from(up && side > zero()) - i32::from(down && side < zero());
        }
    }
    rule.contains(turns)
}

/// Whether a point is within a distance (squared) of a segment.
fn is_near(a: &V2, b: &V2, p: &V2, squared: &R) -> bool {
    let (d, v) = (sub(b, a), sub(p, a));
    let (along, length) = (inner(&d, &v), inner(&d, &d));
    if along <= zero() {
        return inner(&v, &v) <= *squared;
    }
    if along >= length {
        let w = sub(p, b);
        return inner(&w, &w) <= *squared;
    }
    square(perp(&d, &v)) <= squared.clone() * length
}

/// Whether `x <= h * sqrt(q)`, h at least 0.
fn at_most(x: &R, h: &R, q: &R) -> bool {
    *x <= zero() || square(x.clone()) <= square(h.clone()) * q.clone()
}

fn in_rectangle(a: &V2, b: &V2, half: &R, caps: (bool, bool), p: &V2) -> bool {
    let (d, v) = (sub(b, a), sub(p, a));
    let (along, across, length) = (inner(&d, &v), perp(&d, &v), inner(&d, &d));
    let reach = |is_square: bool| if is_square { half.clone() } else { zero() };
    at_most(&across, half, &length)
        && at_most(&-across, half, &length)
        && at_most(&-along.clone(), &reach(caps.0), &length)
        && at_most(&(along - length.clone()), &reach(caps.1), &length)
}

fn in_join(a: &V2, b: &V2, c: &V2, half: &R, join: Join, p: &V2) -> bool {
    let (d1, d2, v) = (sub(b, a), sub(c, b), sub(p, b));
    let turn = perp(&d1, &d2);
    if join == Join::Round {
        return inner(&v, &v) <= square(half.clone());
    }
    if turn == zero() || inner(&d1, &v) < zero() || inner(&d2, &v) > zero() {
        return false;
    }
    let outer = |d: &V2| match turn > zero() {
        true => [d[1].clone(), -d[0].clone()],
        false => [-d[1].clone(), d[0].clone()],
    };
    let (m1, m2) = (outer(&d1), outer(&d2));
    let (q1, q2) = (inner(&d1, &d1), inner(&d2, &d2));
    let is_mitred = match join {
        Join::Miter { limit } => {
            // cos of the turn >= 2 / limit^2 - 1.
            let least = rational(2.0) / square(rational(limit)) - R::ONE;
            let cosine = inner(&d1, &d2);
            let bound = square(least.clone()) * q1.clone() * q2.clone();
            match (least > zero(), cosine > zero()) {
                (true, false) => false,
                (false, true) => true,
                (true, true) => square(cosine) >= bound,
                (false, false) => square(cosine) <= bound,
            }
        }
        _ => false,
    };
    if is_mitred {
        return at_most(&inner(&m1, &v), half, &q1) && at_most(&inner(&m2, &v), half, &q2);
    }
    // v = alpha n1 + beta n2 with unit normals: alpha + beta <= half, alpha = share1 * sqrt(q1), beta = share2 * sqrt(q2).
    let whole = perp(&m1, &m2);
    let (share1, share2) = (perp(&v, &m2) / whole.clone(), perp(&m1, &v) / whole);
    let rest =
        square(half.clone()) - square(share1.clone()) * q1.clone() - square(share2.clone()) * q2.clone();
    let twice = rational(4.0) * square(share1) * square(share2) * q1 * q2;
    rest >= zero() && twice <= square(rest)
}

fn in_stroke(points: &[Plan], is_ring: bool, line: &Line, frame: &ViewFrame, seen: &Seen) -> bool {
    let mut chain: Vec<V2> = points.iter().map(|p| flat(*p)).collect();
    if is_ring {
        chain.push(chain[0].clone());
    }
    let p = &seen.plan;
    let half = match line.width {
        Width::Metres(width) => rational(width) / rational(2.0),
        Width::Pixels(width) => {
            let by = rational(width) / rational(2.0) * rational(frame.lens().pixel());
            let squared = match frame.lens() {
                Lens::Central { .. } => square(by) * seen.eye_squared.clone(),
                Lens::Parallel { .. } => square(by),
            };
            return chain.windows(2).any(|pair| is_near(&pair[0], &pair[1], p, &squared));
        }
    };
    let count = chain.len();
    let is_square = line.cap == Cap::Square && !is_ring;
    let segments = chain.windows(2).enumerate();
    let in_segment = segments.clone().any(|(k, s)| {
        in_rectangle(&s[0], &s[1], &half, (is_square && k == 0, is_square && k + 2 == count), p)
    });
    let in_corner = chain.windows(3).any(|s| in_join(&s[0], &s[1], &s[2], &half, line.join, p))
        || (is_ring && in_join(&chain[count - 2], &chain[0], &chain[1], &half, line.join, p));
    let ends = [&chain[0], &chain[count - 1]];
    let in_cap = !is_ring
        && line.cap == Cap::Round
        && ends.iter().any(|end| {
            let v = sub(p, end);
            inner(&v, &v) <= square(half.clone())
        });
    in_segment || in_corner || in_cap
}

/// Whether a point lies in the disc around another.
fn in_disc(at: Plan, line: &Line, frame: &ViewFrame, seen: &Seen) -> bool {
    let squared = match (line.width, frame.lens()) {
        (Width::Metres(width), _) => square(rational(width) / rational(2.0)),
        (Width::Pixels(width), lens) => {
            let by = square(rational(width) / rational(2.0) * rational(lens.pixel()));
            if matches!(lens, Lens::Central { .. }) { by * seen.eye_squared.clone() } else { by }
        }
    };
    let v = sub(&seen.plan, &flat(at));
    inner(&v, &v) <= squared
}

/// The items that hold a point, by their definitions, in draw order.
fn items_at(layers: &[Layer], frame: &ViewFrame, seen: &Seen) -> Vec<bool> {
    let mut all = Vec::new();
    for layer in layers {
        for feature in &layer.features {
            let style = layer.style_of(feature);
            match &feature.shape {
                Shape::Line(parts) => {
                    let line = style.line.as_ref().unwrap();
                    all.push(parts.iter().any(|part| in_stroke(part, false, line, frame, seen)));
                }
                Shape::Points(points) => {
                    let line = style.point.as_ref().unwrap();
                    all.push(points.iter().any(|at| in_disc(*at, line, frame, seen)));
                }
                Shape::Polygon(_) | Shape::MultiPolygon(_) | Shape::Swath { .. } => {
                    let rule = style.fill.map_or(Rule::EvenOdd, |fill| fill.rule);
                    let is_inside = match &feature.shape {
                        Shape::MultiPolygon(members) => {
                            members.iter().any(|rings| in_rings(rings, rule, &seen.plan))
                        }
                        shape => in_rings(&shape.parts().cloned().collect::<Vec<_>>(), rule, &seen.plan),
                    };
                    if style.fill.is_some() {
                        all.push(is_inside);
                    }
                    if let Some(outline) = &style.outline {
                        let counts = match outline.mode {
                            OutlineMode::Inset => is_inside,
                            OutlineMode::Normal => true,
                            OutlineMode::Offset => !is_inside,
                        };
                        let line = &outline.line;
                        let mut rings = feature.shape.parts();
                        all.push(counts && rings.any(|ring| in_stroke(ring, true, line, frame, seen)));
                    }
                }
            }
        }
    }
    all
}

/// A random point of a piece.
fn point_in(piece: &[[f64; 2]], dice: &mut Dice) -> [f64; 2] {
    let weights: Vec<f64> = piece.iter().map(|_| dice.between(0.0, 1.0) + 0.01).collect();
    let sum: f64 = weights.iter().sum();
    let mean = |k: usize| piece.iter().zip(&weights).map(|(p, w)| p[k] * w / sum).sum();
    [mean(0), mean(1)]
}

/// Looks at the pieces of random scenes from a seed on until so many have been judged; returns what was wrong.
fn violations(seed: u64, count: usize) -> Vec<String> {
    let mut dice = Dice(seed);
    let (mut judged, mut wrong) = (0, Vec::new());
    while judged < count {
        let at_seed = dice.0;
        let Some((scene, mesh)) = scene(&mut dice) else { continue };
        let Ok(frame) = scene.camera.view(&scene.image) else { continue };
        let budget = Budget { width: 0.02, depth: 8, coverage: true };
        let (looked_at, found) = violations_in(&scene, &mesh, &frame, budget, (&mut dice, 8));
        judged += looked_at;
        wrong.extend(found.into_iter().map(|what| format!("seed {at_seed:#x}, {what}")));
    }
    wrong
}

/// Looks at the pieces of a scene, at one in `few` of those that claim nothing: how many, and what was wrong.
fn violations_in(
    scene: &Scene,
    mesh: &Mesh,
    frame: &ViewFrame,
    budget: Budget,
    (dice, few): (&mut Dice, u64),
) -> (usize, Vec<String>) {
    let (mut judged, mut wrong) = (0, Vec::new());
    let size = PixelSize::of(frame, mesh);
    let list = DrawList::new(&mut scene.layers.clone(), &PlanBox::EMPTY).unwrap();
    let footprints = Footprints::new(&list, size, &|_| true);
    let setting = Setting::new(scene, mesh, (&footprints, size), budget);
    let triangles: Vec<(u32, SurfaceTriangle)> =
        (0..mesh.triangle_ids()).filter_map(|id| Some((id, mesh.surface_triangle(id)?))).collect();
    let (width, height) = (scene.image.width, scene.image.height);
    let mut work =
        Work::new(&setting, mesh, frame, &TilePlace { corner: [0, 0], size: [width, height] }, None);
    let all: Vec<u32> = (0..work.leaves.len()).flat_map(|leaf| work.facets_of(leaf)).collect();
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let near = narrowed((&work.facets, &work.boxes), &all, [x as f64, y as f64], 1.0);
        assert!(work.pixel([x, y], &near, &[]));
        let of_size = |shape: &&Polygon| work.pieces.area(**shape) >= SPECK;
        let sky = work.sight.sky.iter().filter(of_size).map(|shape| (*shape, None, Vec::new()));
        let seen =
            work.refinery.claims().into_iter().map(|(shape, facet, claims)| (shape, Some(facet), claims));
        for (shape, facet, claims) in sky.chain(seen) {
            let piece = work.pieces.of(shape);
            if dice.below(few) > 0 && claims.is_empty() && facet.is_some() {
                continue;
            }
            let p = point_in(piece, dice);
            judged += 1;
            let at = [x as f64 + p[0], y as f64 + p[1]];
            let facet = facet.map(|facet| &work.facets[facet as usize]);
            let claimed = facet.map(|facet| (facet.id, facet.hit(&work.rays, at)));
            if let Err(what) = judge(scene, frame, &triangles, at, (claimed, &claims)) {
                wrong.push(format!("pixel {x},{y}, {p:?}: {what}"));
            }
        }
    }
    (judged, wrong)
}

/// An item, and whether it holds the piece; `None`: it is not said.
type Claim = (u32, Option<bool>);

/// Whether what a piece claims is so at a point of the screen.
fn judge(
    scene: &Scene,
    frame: &ViewFrame,
    triangles: &[(u32, SurfaceTriangle)],
    at: [f64; 2],
    (claimed, claims): (Option<(u32, Hit)>, &[Claim]),
) -> Result<(), String> {
    let (from, along) = ray(frame, at);
    let near = triangles.iter().filter(|(_, t)| !passes_by(frame, at, &t.world));
    let hits = near.filter_map(|(id, t)| Some((*id, t, meet(&from, &along, &t.world, frame.near())?)));
    let hit = hits.min_by(|a, b| a.2.0.cmp(&b.2.0));
    let (Some((id, triangle, (t, weights))), Some((claimed, place))) = (&hit, claimed) else {
        let is_so = hit.is_none() && claimed.is_none();
        return if is_so { Ok(()) } else { Err(format!("sees {:?}, not {claimed:?}", hit.map(|h| h.0))) };
    };
    if *id != claimed {
        return Err(format!("sees triangle {id}, not {claimed}"));
    }
    let p = plus_times(&from, &along, t).map(lean);
    let to_eye = minus(&p, &vector(frame.eye().to_vec()));
    let [a, b, c] = triangle.plan().map(flat);
    let mean = |k: usize| {
        let side = |corner: &V2, weight: &R| (corner[k].clone() - a[k].clone()) * weight.clone();
        lean(a[k].clone() + side(&b, &weights[0]) + side(&c, &weights[1]))
    };
    let seen = Seen { plan: [mean(0), mean(1)], eye_squared: dot(&to_eye, &to_eye) };
    let told = [place.plan.x, place.plan.y, place.world.x, place.world.y, place.world.z];
    let off = |(exact, told): (&R, f64)| exact.clone() - rational(told);
    for off in seen.plan.iter().chain(&p).zip(told).map(off).filter(|_| place.error < f64::INFINITY) {
        let most = rational(place.error);
        if off > most || -off > most {
            return Err(format!("the point is not within {} of {place:?}", place.error));
        }
    }
    for (item, holds) in items_at(&scene.layers, frame, &seen).into_iter().enumerate() {
        let claim = claims.iter().find(|c| c.0 == item as u32).map_or(Some(false), |c| c.1);
        if claim.is_some_and(|claim| claim != holds) {
            return Err(format!("item {item}: it holds the point: {holds}"));
        }
    }
    Ok(())
}

fn violations_on_all_threads(count: usize) -> Vec<String> {
    let found = crate::parallel::map_indices(64, |k| {
        violations(0x5eed_0000 + (k as u64) * 0x1_0000_0001, count / 64)
    });
    found.concat()
}

#[test]
fn pieces_are_what_exact_arithmetic_says() {
    let wrong = violations_on_all_threads(20_000);
    assert!(wrong.is_empty(), "{} of 20,000:\n{}", wrong.len(), wrong[..wrong.len().min(5)].join("\n"));
}

#[test]
fn a_strip_thinner_than_the_roundings_of_its_place_lies_in_the_polygons_of_a_crowd() {
    // A thousand kilometres from the origin a pixel reaches a quarter of a rounding west over a line of posts, to which sixty
    // squares reach from the west: the middle of that strip, computed, is on the squares' border or beyond it.
    let (border, reach) = (1_000_000.0, 1.0 / (1u64 << 35) as f64);
    let (mut scene, _) = scene(&mut Dice(0)).unwrap();
    (scene.image.width, scene.image.height) = (2, 2);
    scene.camera.up = DVec3::Y;
    scene.camera.projection = crate::scene::Projection::Perspective { fov_y_deg: 0.3 };
    let mut look_from = |height: f64| {
        let at = |z| World::new(border + 0.25, 3.0, z);
        (scene.camera.eye, scene.camera.target) = (at(height), at(0.0));
        scene.camera.view(&scene.image).unwrap()
    };
    let size_at_a_metre = look_from(100.0).lens().pixel();
    let frame = look_from((0.25 + reach) / size_at_a_metre);
    let square = [(-6.0, 0.0), (0.0, 0.0), (0.0, 6.0), (-6.0, 6.0)];
    let ring: Vec<Plan> = square.map(|(x, y)| Plan::new(border + x, y)).to_vec();
    let fill = Fill { color: Color([0.0, 0.0, 0.0, 0.5]), rule: Rule::NonZero };
    let features =
        (0..60).map(|index| Feature { index, style: 0, shape: Shape::Polygon(vec![ring.clone()]) });
    let style = Style { fill: Some(fill), ..Style::default() };
    scene.layers = vec![Layer::uniform("crowd", style, features.collect())];
    let steps = (DVec2::X * 8.0, DVec2::Y * 8.0);
    let posts = Posts::new((3, 3), Plan::new(border - 8.0, -8.0), steps, vec![0.0; 9]).unwrap();
    let mesh = Mesh::new(Surface::Grid(posts), scene.diagonal).unwrap();
    let budget = Budget { width: 1e-13, depth: 10, coverage: true };
    let (judged, wrong) = violations_in(&scene, &mesh, &frame, budget, (&mut Dice(1), 1));
    let strip = frame.eye().z * frame.lens().pixel() - 0.25;
    assert!((strip - reach).abs() < 0.01 * reach, "{strip}: the strip is as wide as the test means");
    assert!(judged >= 6, "{judged}: two pixels in halves, and two others");
    assert!(wrong.is_empty(), "{}", wrong[..wrong.len().min(5)].join("\n"));
}

#[test]
#[ignore = "minutes of exact arithmetic: CI runs it"]
fn a_million_pieces_are_what_exact_arithmetic_says() {
    let wrong = violations_on_all_threads(1_000_000);
    assert!(wrong.is_empty(), "{} of 1,000,000:\n{}", wrong.len(), wrong[..wrong.len().min(5)].join("\n"));
}

#[test]
fn a_box_of_the_plan_is_seen_where_the_view_meets_its_corner_and_not_beside_it() {
    for middle in [30.0, -30.0, 1000.5] {
        let eye = World::new(middle, middle, 8.0);
        let target = World::new(middle, middle, 0.0);
        let view = crate::space::Viewpoint { eye, target, up: glam::DVec3::Y, near: 0.5, far: 100.0 };
        let frame = ViewFrame::orthographic(&view, 2.0, (8, 8)).unwrap();
        let frustum = Frustum::new(&frame, [0.0, 0.0], [8.0, 8.0]);
        let meets = |from: f64, to: f64, heights| {
            frustum.meets_plan(&PlanBox { min: Plan::new(from, from), max: Plan::new(to, to) }, heights)
        };
        // It sees a metre to each side of the middle.
        let level = (0.0, 1.0);
        assert!(meets(middle - 61.0, middle + 0.5, level) && meets(middle - 0.5, middle + 61.0, level));
        assert!(meets(middle - 61.0, middle - 0.5, level) && meets(middle + 0.5, middle + 61.0, level));
        assert!(!meets(middle - 61.0, middle - 1.5, level) && !meets(middle + 1.5, middle + 61.0, level));
        assert!(meets(middle - 61.0, middle + 61.0, (-90.0, -80.0)));
        assert!(!meets(middle - 61.0, middle + 61.0, (8.0, 80.0)));
        assert!(!meets(middle - 61.0, middle + 61.0, (-180.0, -93.0)));
    }
}
