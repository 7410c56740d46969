//! Figs. 2 and 3: volumes cut open.

use super::super::drawing::{Drawing, Window};
use super::super::figure::{Figure, Panel, Paper, Scale};
use super::super::shot::Shot;
use super::super::volumes::{VOLUMES, Volume, volumes};
use crate::error::{Error, Result};
use crate::space::Plan;
use crate::technique::Kind;

const CUT: &str = include_str!("cut.toml");
const STRIP: &str = include_str!("strip.toml");
const SIZE: [f64; 2] = [760.0, 360.0];
/// Steps of a profile, metres: posts are ten metres apart.
const STEP: f64 = 1.0;

pub(super) const FIGURE_2: Figure = Figure {
    name: "schneider-klein-2",
    paper: Paper::SchneiderKlein,
    number: "Fig. 2",
    title: "Is a point in a volume?",
    caption: "A vertical cut through the eye: terrain, the volumes of two areas, and a line of sight to a point P of the terrain. Faces are counted from the near \
              plane to P (z-pass) or from infinity to P (z-fail): +1 where the line enters a volume, -1 where it leaves one.",
    look_for: "both sums are 1: P lies in one volume. The volume before P is entered and left, and cancels.",
    draw: figure_2,
};

pub(super) const FIGURE_3: Figure = Figure {
    name: "schneider-klein-3",
    paper: Paper::SchneiderKlein,
    number: "Fig. 3",
    title: "A line's volumes along it",
    caption: "The terrain along a line of four segments, and the volume of each segment: from below the lowest to above the highest of the terrain's boxes that it \
              crosses.",
    look_for: "volumes keep clear of the terrain, and are no higher than its hills: little is rasterized in vain.",
    draw: figure_3,
};

/// A point of the cut as a point of a drawing's plan: along it, and up.
fn upright(along: f64, height: f64) -> Plan {
    Plan::new(along, height)
}

/// The part of the cut x = 0 that a volume takes: south and north end.
fn cut(volume: &Volume) -> Option<[f64; 2]> {
    let mut crossings: Vec<f64> = Vec::new();
    for ring in &volume.rings {
        for (k, a) in ring.iter().enumerate() {
            let b = ring[(k + 1) % ring.len()];
            if (a.x > 0.0) != (b.x > 0.0) {
                crossings.push(a.y + (b.y - a.y) * (-a.x / (b.x - a.x)));
            }
        }
    }
    crossings.sort_by(f64::total_cmp);
    Some([*crossings.first()?, *crossings.last()?])
}

/// The cut through the eye.
struct Cut {
    eye: Plan,
    profile: Vec<Plan>,
    /// Volumes from south to north, and the part of the cut that each takes.
    volumes: Vec<(Volume, [f64; 2])>,
}

impl Cut {
    fn of(shot: &Shot) -> Result<Self> {
        let all = volumes(&shot.frame(Kind::StencilVolume, &VOLUMES)?)?;
        let within = all.into_iter().filter_map(|volume| cut(&volume).map(|ends| (volume, ends)));
        let ground = |y: f64| upright(y, shot.on_ground(Plan::new(0.0, y)).z);
        let profile = (0..=320).map(|k| ground(f64::from(k) * STEP - 160.0)).collect();
        let eye = shot.view.eye();
        Ok(Self { eye: upright(eye.y, eye.z), profile, volumes: within.collect() })
    }

    /// The southernmost point in the last volume that the eye sees: no ground before it is above the line of sight.
    fn seen(&self) -> Option<Plan> {
        let (_, [south, north]) = self.volumes.last()?;
        let is_seen = |at: &Plan| {
            let slope = (at.y - self.eye.y) / (at.x - self.eye.x);
            let before = self.profile.iter().filter(|other| other.x > self.eye.x && other.x < at.x - STEP);
            before.into_iter().all(|other| other.y < self.eye.y + slope * (other.x - self.eye.x))
        };
        let inside = self.profile.iter().filter(|at| at.x > south + 2.0 && at.x < north - 2.0);
        inside.copied().find(is_seen)
    }
}

fn figure_2(_: Scale) -> Result<Vec<Panel>> {
    let cut = Cut::of(&Shot::of(CUT, &[])?)?;
    let seen = cut.seen().ok_or_else(|| Error::internal("a figure sees nothing"))?;
    let far = seen + (seen - cut.eye) * 0.22;
    let window = Window::around(
        cut.profile.iter().copied().chain([cut.eye, far]),
        [16.0, 24.0, SIZE[0] - 32.0, SIZE[1] - 56.0],
    );
    let mut drawing = Drawing::new("a cut through the eye", SIZE);
    for (volume, [south, north]) in &cut.volumes {
        let ring = [
            upright(*south, volume.bottom),
            upright(*north, volume.bottom),
            upright(*north, volume.top),
            upright(*south, volume.top),
        ];
        drawing.ring(&window.all(&ring), "blue area");
        drawing.ring(&window.all(&ring), "blue edge");
    }
    drawing.line(&window.all(&cut.profile), "ink edge");
    sight(&mut drawing, &window, [cut.eye, seen, far], &cut.volumes);
    Ok(vec![Panel::drawing("z-pass (orange) and z-fail (green) along one line of sight", drawing.svg())])
}

/// The line of sight from the eye through a seen point, and what is counted on it.
fn sight(drawing: &mut Drawing, window: &Window, [eye, seen, far]: [Plan; 3], cuts: &[(Volume, [f64; 2])]) {
    let along = seen - eye;
    let at = |t: f64| eye + along * t;
    let near = 12.0 / along.length();
    drawing.line(&window.all(&[eye, at(near)]), "soft edge dash");
    drawing.line(&window.all(&[at(near), seen]), "orange edge");
    drawing.line(&window.all(&[seen, far]), "green edge");
    for (volume, [south, north]) in cuts {
        let across = [(south - eye.x) / along.x, (north - eye.x) / along.x];
        let levels = [volume.bottom, volume.top].map(|height| (height - eye.y) / along.y);
        let enters = crate::math::max(across[0], crate::math::min(levels[0], levels[1]));
        let leaves = crate::math::min(across[1], crate::math::max(levels[0], levels[1]));
        for (t, is_front) in [(enters, true), (leaves, false)].into_iter().filter(|_| enters < leaves) {
            // Counted towards P from either end: z-pass comes from the eye, z-fail from infinity.
            let (color, sign) = match t < 1.0 {
                true => ("orange", if is_front { "+1" } else { "-1" }),
                false => ("green", if is_front { "-1" } else { "+1" }),
            };
            let [x, y] = window.at(at(t));
            drawing.dot([x, y], 4.0, &format!("{color} dot"));
            drawing.word([x + 4.0, y - 9.0], "middle", sign);
        }
    }
    for (point, word, anchor) in
        [(eye, "eye", "start"), (at(near), "O near", "start"), (seen, "P", "start"), (far, "O inf", "end")]
    {
        let [x, y] = window.at(point);
        drawing.dot([x, y], 3.5, "ink dot");
        drawing.word([x, y + 18.0], anchor, word);
    }
}

fn figure_3(_: Scale) -> Result<Vec<Panel>> {
    let shot = Shot::of(STRIP, &[])?;
    let all = volumes(&shot.frame(Kind::StencilVolume, &VOLUMES)?)?;
    let list = &shot.stage.draw_list;
    let item = list.items().first().ok_or_else(|| Error::internal("a figure's line is lost"))?;
    let path: Vec<Plan> =
        list.strokes(item).iter().flat_map(|chain| list.vertices_of(chain).to_vec()).collect();
    let (mut profile, mut corners, mut along) = (Vec::new(), vec![0.0], 0.0);
    for pair in path.windows(2) {
        let length = (pair[1] - pair[0]).length();
        let steps = (length / STEP) as usize;
        for k in 0..=steps {
            let share = k as f64 / steps.max(1) as f64;
            let height = shot.on_ground(pair[0] + (pair[1] - pair[0]) * share).z;
            profile.push(upright(along + share * length, height));
        }
        along += length;
        corners.push(along);
    }
    let caps = all.iter().flat_map(|volume| [upright(0.0, volume.bottom), upright(0.0, volume.top)]);
    let window =
        Window::around(profile.iter().copied().chain(caps), [16.0, 24.0, SIZE[0] - 32.0, SIZE[1] - 48.0]);
    let mut drawing = Drawing::new("a line's volumes along it", SIZE);
    for (volume, ends) in all.iter().zip(corners.windows(2)) {
        let at = |x: f64, height: f64| window.at(upright(x, height));
        let [low, high] = [volume.bottom, volume.top];
        drawing.ring(
            &[at(ends[0], low), at(ends[1], low), at(ends[1], high), at(ends[0], high)],
            "blue area faint",
        );
        drawing.line(&[at(ends[0], low), at(ends[0], high)], "blue edge thin");
        drawing.line(&[at(ends[1], low), at(ends[1], high)], "blue edge thin");
        for height in [low, high] {
            drawing.line(&[at(ends[0], height), at(ends[1], height)], "orange edge thick");
        }
    }
    drawing.line(&window.all(&profile), "ink edge");
    for (at, vertex) in corners.iter().zip(&path) {
        drawing.dot(window.at(upright(*at, shot.on_ground(*vertex).z)), 4.0, "blue dot");
    }
    Ok(vec![Panel::drawing("caps orange, the line's vertices on the terrain blue", drawing.svg())])
}
