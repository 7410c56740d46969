//! Inverse projection (She 2016): a pixel asks the plan for its colour, by samples between the plan points of its neighbours.
//!
//! What rays may end in (`sight`) makes a pixel's quadrilateral a set of such (`place`); edges of the outlines of lines and polygons
//! (`outlines`) then hold each sample, do not, or may (`judgment`), and a pixel is the mean of what its samples may be (`pixel`).

mod ground;
mod judgment;
mod outlines;
mod pixel;
mod place;
mod sight;

use super::envelope::COORDINATES;
use super::model::{Guess, View};
use super::picture;
use super::pixel::PixelRange;
use super::stages::{Seen, stages};
use crate::buffer::Buffer;
use crate::compare::{FeatureRun, Hypothesis, Stage, StageRange};
use crate::draw_list::DrawList;
use crate::footprint::Strokes;
use crate::math;
use crate::parallel;
use crate::resolve::Compositor;
use crate::space::{Screen, ViewFrame};
use crate::technique::inverse_projection::{Corners, Settings};
use crate::terrain::Mesh;
use crate::truth::{Probe, probe_around};
use glam::DVec2;
use ground::Ground;
use judgment::Judge;
use outlines::Outlines;
use pixel::{Judged, Painter, Rays};
use sight::{Eye, Sight};

/// Pixels around the picture whose rays are looked at too: neighbours of those at its border.
const BORDER: usize = 1;

/// What a pixel's rays may end in.
#[derive(Debug, Clone, Default)]
struct Probed {
    /// At its centre, for the stages.
    seen: Seen,
    /// At its centre.
    centre: Sight,
    /// At its upper left corner, where that is asked for.
    corner: Option<Sight>,
}

/// The picture by one guess.
pub(super) fn picture(
    settings: &Settings,
    view: &View,
    guess: &Guess,
) -> (Hypothesis, Vec<Stage>, Vec<FeatureRun>) {
    let (stage, frame) = (view.stage, view.frame);
    let mesh = &*stage.mesh_for(frame);
    let slack = 8.0 * COORDINATES * reach(mesh, frame);
    let along = |depth: f64| guess.envelope.along(frame, depth);
    let compositor = Compositor::new(stage.scene.compositing);
    let ground = Ground::new(&stage.scene.ground, mesh, compositor);
    let shift = guess.envelope.shift();
    let eye = Eye { view: frame, mesh, shift, along: &along, ground: &ground, slack };
    let probed = probed(settings, view, &eye);
    let outlines = Outlines::new(&stage.draw_list, &mesh.plan_bounds());
    let styles = stage.draw_list.styles().iter();
    let painter = Painter {
        judge: Judge { outlines: &outlines, rule: settings.point_in_polygon, slack },
        eye,
        settings,
        mode: stage.scene.compositing.mode,
        sky: compositor.paint(stage.scene.image.background),
        paints: styles.map(|style| compositor.paint(style.paint)).collect(),
        compositor,
    };
    let size @ [width, height] = [frame.width(), frame.height()];
    let progress = |share: f64| (view.progress)(0.5 + 0.5 * share);
    let rows = parallel::map_telling(height, &progress, |y| {
        let mut last = None;
        (0..width).map(|x| painter.judged(&rays(&probed, [x, y]), &mut last)).collect::<Vec<Judged>>()
    });
    let judged = rows.concat();
    let inner = |x: usize, y: usize| probed.at(x + BORDER, y + BORDER).seen.clone();
    let seen = (0..height).flat_map(|y| (0..width).map(move |x| inner(x, y))).collect();
    let mut all = stages(&Buffer::from_values(width, height, seen));
    all.extend(own_stages(&judged, stage.scene.origin.truncate()));
    let ranges: Vec<PixelRange> = judged.into_iter().map(|of| of.range).collect();
    let ranges = Buffer::from_values(size[0], size[1], ranges);
    let features = picture::feature_runs(&ranges, &stage.draw_list);
    (picture::hypothesis(guess.name.clone(), &ranges), all, features)
}

/// The size of the coordinates that plan points are computed from.
fn reach(mesh: &Mesh, frame: &ViewFrame) -> f64 {
    let bounds = mesh.plan_bounds();
    let plan = [bounds.min.x, bounds.min.y, bounds.max.x, bounds.max.y];
    let eye = frame.eye().to_vec().abs().max_element();
    plan.into_iter().fold(eye, |most, v| math::max(v.abs(), most))
}

/// What the rays of a picture with a border may end in.
fn probed(settings: &Settings, view: &View, eye: &Eye) -> Buffer<Probed> {
    let nothing = DrawList::default();
    let spots = [[0.5; 2], [0.0; 2]];
    let wants_corners = settings.corners == Corners::True;
    let probe = Probe {
        list: &nothing,
        strokes: Strokes::Style,
        spots: if wants_corners { &spots } else { &spots[..1] },
        shifts: &[eye.shift],
        // How depths move points along their rays is the eye's matter.
        depths_of_shifts: 0.0,
        along: &|_| 0.0,
        share: 0.0,
    };
    let at = |[x, y]: [usize; 2], spot: [f64; 2]| {
        let on = |pixel: usize, spot: f64| pixel as f64 - BORDER as f64 + spot;
        Screen::new(on(x, spot[0]), on(y, spot[1]))
    };
    probe_around(
        (view.stage, view.frame),
        BORDER,
        &probe,
        &|pixel, samples| Probed {
            seen: Seen::of(&samples[0], eye.along),
            centre: Sight::of(&samples[0], eye, at(pixel, spots[0])),
            corner: samples.get(1).map(|sample| Sight::of(sample, eye, at(pixel, spots[1]))),
        },
        &|share| (view.progress)(0.5 * share),
    )
}

/// The rays of a pixel.
fn rays(probed: &Buffer<Probed>, [x, y]: [usize; 2]) -> Rays<'_> {
    let of = |x: usize, y: usize| probed.at(x, y);
    let (column, row) = (x + BORDER, y + BORDER);
    let centre = &of(column, row).centre;
    let corner = |x: usize, y: usize| of(x, y).corner.as_ref().unwrap_or(&of(x, y).centre);
    let is_centre_a_corner = of(column, row).corner.is_none();
    // Screen rows run down.
    let (lower, upper, offset) = if is_centre_a_corner { (row, row - 1, 0.5) } else { (row + 1, row, 0.0) };
    let corners = [(column, lower), (column + 1, lower), (column + 1, upper), (column, upper)];
    let on = |at: usize| at as f64 - BORDER as f64 + offset;
    Rays {
        centre,
        corners: corners.map(|(x, y)| corner(x, y)),
        places: corners.map(|(x, y)| Screen::new(on(x), on(y))),
        is_centre_a_corner,
    }
}

/// The stages that the technique has besides those of all: pixels' quadrilaterals (absolute, as files have them), classes and edges.
fn own_stages(judged: &[Judged], origin: DVec2) -> Vec<Stage> {
    let classes = (0..).zip(judged).flat_map(|(pixel, of)| {
        let possible = (0..3).filter(|class| of.classes[*class]);
        possible.map(move |class| (pixel, class as f64)).collect::<Vec<_>>()
    });
    let absolute = |of: [f64; 8]| std::array::from_fn::<f64, 8, _>(|k| of[k] + origin[k % 2]);
    let quads = |end: usize| judged.iter().flat_map(|of| absolute(of.quad[end])).collect();
    let edges = |end: usize| judged.iter().map(move |of| of.edges[end] as f64).collect();
    let between = |components: usize, lo, hi| StageRange::Between { components, lo, hi };
    let stages = [
        ("quad", between(8, quads(0), quads(1))),
        ("class", StageRange::OneOf(classes.collect())),
        ("edges", between(1, edges(0), edges(1))),
    ];
    stages.map(|(buffer, range)| Stage { buffer: buffer.to_owned(), range }).into()
}
