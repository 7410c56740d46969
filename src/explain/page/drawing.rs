//! Pictures of a pixel: on the screen, in the plan; as SVG. A unit of a drawing is a thousandth of its pixel, or of its side.

use super::super::account::{Account, hex};
use super::super::close_up::BESIDE;
use super::super::scenery::{Piece, Shape};
use crate::error::{Error, Result};
use crate::math;
use crate::output::{base64, small_png};
use maud::{Markup, html};

/// Units of a pixel's side.
const UNIT: f64 = 1000.0;

/// Units of the side of a drawing of the plan.
const PLAN: f64 = 1000.0;

/// Parts of items that a drawing has at most.
const MOST_SHAPES: usize = 400;

/// Colours that people with any kind of colour vision tell apart (Okabe and Ito 2008).
const PALETTE: [&str; 7] = ["#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7a6a00"];

/// The colour in which an account's drawings have an item's borders.
pub(super) fn color_of_item(account: &Account, item: u32) -> &'static str {
    let items = drawn_items(account);
    PALETTE[items.binary_search(&item).unwrap_or_else(|at| at) % PALETTE.len()]
}

/// The pixel on the screen.
///
/// # Errors
/// Internal errors only.
pub(super) fn screen(account: &Account) -> Result<Markup> {
    let [x, y] = account.pixel.map(|v| v as f64);
    let at = |[sx, sy]: [f64; 2]| [(sx - x) * UNIT, (sy - y) * UNIT];
    let (from, side) = (-BESIDE * UNIT, (1.0 + 2.0 * BESIDE) * UNIT);
    let label = format!("What is in pixel {x},{y}: the terrain's triangles and the borders of features");
    let picture = match &account.close_up {
        None => None,
        Some(picture) => Some(data_url(&small_png(picture).map_err(no_picture)?)),
    };
    Ok(html! {
        svg.screen viewBox=(format!("{from} {from} {side} {side}")) role="img" aria-label=(label) {
            @if let Some(url) = picture {
                image href=(url) x=(from) y=(from) width=(side) height=(side) preserveAspectRatio="none" {}
            }
            (pieces(account, &|piece| &piece.screen, &at))
            (parts(account, &|shape| &shape.screen, &at))
            rect.halo x="0" y="0" width=(UNIT) height=(UNIT) {}
            rect.pixel x="0" y="0" width=(UNIT) height=(UNIT) {}
            (samples(account, &|step| step.screen, &at))
        }
    })
}

/// The same in the plan, north up.
pub(super) fn plan(account: &Account) -> Option<Markup> {
    let frame = Frame::of(account)?;
    let at = |place| frame.at(place);
    let [x, y] = account.pixel;
    let label = format!(
        "Pixel {x},{y} in the plan, north up, {} metres a side",
        super::super::margin::short(frame.side)
    );
    Some(html! {
        svg.plan viewBox=(format!("0 0 {PLAN} {PLAN}")) role="img" aria-label=(label) {
            (pieces(account, &|piece| &piece.plan, &at))
            (parts(account, &|shape| &shape.plan, &at))
            (samples(account, &|step| step.plan, &at))
            (frame.scale())
        }
    })
}

/// A square of the plan.
struct Frame {
    west: f64,
    north: f64,
    side: f64,
}

/// What a pixel sees is drawn if it is not farther from where its centre looks than so many sizes of the pixel there.
const FAR: f64 = 6.0;

impl Frame {
    /// Around what a pixel sees near where its centre looks.
    fn of(account: &Account) -> Option<Self> {
        let own = account.scenery.pieces.iter().filter(|piece| piece.share > 0.0);
        let points: Vec<[f64; 2]> = own.flat_map(|piece| piece.plan.iter().copied()).collect();
        let centre = account.centre.as_ref();
        let middle = centre.map(|centre| centre.plan).or_else(|| points.first().copied())?;
        let size = |[dx, dy]: [[f64; 2]; 2]| dx[0].abs() + dx[1].abs() + dy[0].abs() + dy[1].abs();
        let reach = centre.and_then(|centre| centre.pixel).map_or(f64::INFINITY, |pixel| FAR * size(pixel));
        let is_near = |at: &&[f64; 2]| (0..2).all(|k| (at[k] - middle[k]).abs() <= reach);
        let steps = account.techniques.iter().flat_map(|by| &by.steps);
        let samples: Vec<[f64; 2]> = steps.filter_map(|step| step.plan).collect();
        let near = points.iter().chain(&samples).filter(is_near).chain([&middle]);
        let (mut low, mut high) = (middle, middle);
        for at in near {
            for k in 0..2 {
                low[k] = math::min(at[k], low[k]);
                high[k] = math::max(at[k], high[k]);
            }
        }
        let side = 1.25 * math::max(high[0] - low[0], high[1] - low[1]);
        let [x, y] = [0, 1].map(|k| 0.5 * (low[k] + high[k]));
        (side > 0.0 && side.is_finite()).then_some(Self { west: x - 0.5 * side, north: y + 0.5 * side, side })
    }

    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [(x - self.west) / self.side * PLAN, (self.north - y) / self.side * PLAN]
    }

    /// A bar that is a round number of metres long.
    fn scale(&self) -> Markup {
        let mut length = 1e-6;
        while length * 10.0 < 0.4 * self.side {
            length *= 10.0;
        }
        let length =
            [5.0, 2.0, 1.0].into_iter().map(|k| k * length).find(|l| *l <= 0.4 * self.side).unwrap_or(length);
        let units = length / self.side * PLAN;
        html! {
            g.scale {
                path d=(format!("M30 960v15H{:.0}v-15", 30.0 + units)) {}
                text x="30" y="940" { (super::super::margin::short(length)) " m" }
            }
        }
    }
}

fn no_picture(error: std::io::Error) -> Error {
    Error::internal("a close-up is no PNG").caused_by(error)
}

/// A PNG within a page.
pub(super) fn data_url(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", base64(png))
}

/// Where the corners of something lie, and where that is in a drawing.
type Place<'a, T> = &'a dyn Fn(&T) -> &[[f64; 2]];
type At<'a> = &'a dyn Fn([f64; 2]) -> [f64; 2];

/// Corners as a part of an SVG path; nothing where they are all beside the drawing.
fn path(corners: &[[f64; 2]], is_closed: bool, at: At) -> String {
    let corners: Vec<[f64; 2]> = corners.iter().map(|corner| at(*corner)).collect();
    let (low, high) = (-BESIDE * UNIT, (1.0 + BESIDE) * UNIT);
    let is_beside = |axis: usize| {
        corners.iter().all(|corner| corner[axis] < low) || corners.iter().all(|corner| corner[axis] > high)
    };
    if corners.is_empty() || is_beside(0) || is_beside(1) {
        return String::new();
    }
    let mut path = String::from("M");
    for (k, corner) in corners.iter().enumerate() {
        let [x, y] = corner.map(|v| v.clamp(-1e5, 1e5).round());
        path += &format!("{}{x} {y}", if k == 0 { "" } else { "L" });
    }
    path + if is_closed { "Z" } else { "" }
}

/// What is seen: the pixel's own pieces one by one, those around it together.
fn pieces(account: &Account, corners: Place<Piece>, at: At) -> Markup {
    let (own, others): (Vec<&Piece>, Vec<&Piece>) =
        account.scenery.pieces.iter().partition(|piece| piece.share > 0.0);
    let others: String = others.iter().map(|piece| path(corners(piece), true, at)).collect();
    html! {
        path.piece d=(others) {}
        @for piece in own {
            path.piece.own d=(path(corners(piece), true, at)) {
                title {
                    @match piece.triangle { Some(id) => { "triangle " (id) }, None => "the sky" }
                    ": " (format!("{:.2}", 100.0 * piece.share)) " % of the pixel"
                }
            }
        }
    }
}

/// The parts of items' borders, each item's together.
fn parts(account: &Account, corners: Place<Shape>, at: At) -> Markup {
    let shapes = &account.scenery.shapes[..account.scenery.shapes.len().min(MOST_SHAPES)];
    let of = |item: u32, is_area: bool| -> String {
        let shapes = shapes.iter().filter(|shape| shape.item == item && shape.is_area == is_area);
        shapes.map(|shape| path(corners(shape), is_area, at)).collect()
    };
    html! {
        @for item in drawn_items(account) {
            @let color = color_of_item(account, item);
            @for (is_area, fill) in [(true, color), (false, "none")] {
                @let path = of(item, is_area);
                @if !path.is_empty() { path.part d=(path) stroke=(color) fill=(fill) {} }
            }
        }
    }
}

/// The items whose borders are drawn.
pub(super) fn drawn_items(account: &Account) -> Vec<u32> {
    let mut items: Vec<u32> = account.scenery.shapes.iter().map(|shape| shape.item).collect();
    items.sort_unstable();
    items.dedup();
    items
}

/// Where the samples of each technique lie.
fn samples(
    account: &Account,
    place: &dyn Fn(&super::super::account::Step) -> Option<[f64; 2]>,
    at: At,
) -> Markup {
    html! {
        @for by in &account.techniques {
            g.samples data-of=(by.technique) {
                @for step in &by.steps {
                    @if let Some([x, y]) = place(step).map(at).filter(|at| at.iter().all(|v| v.abs() < 1e5)) {
                        circle cx=(x.round()) cy=(y.round()) r="14" {}
                    }
                }
            }
        }
    }
}

/// The truth's interval of each channel as a bar, and each technique's value on it.
pub(super) fn bars(account: &Account) -> Markup {
    let truth = &account.truth;
    let is_opaque = truth.low[3] > 1.0 - 1e-6 && account.techniques.iter().all(|by| by.code[3] == 255);
    let channels = if is_opaque { 3 } else { 4 };
    html! {
        div.bars {
            @for c in 0..channels {
                (bar(["red", "green", "blue", "alpha"][c], [truth.low[c], truth.high[c]].map(|v| 255.0 * v), account, c))
            }
        }
    }
}

/// Units of a bar's length, and of what it leaves free at its ends.
const BAR: (f64, f64) = (400.0, 24.0);

fn bar(name: &str, [low, high]: [f64; 2], account: &Account, channel: usize) -> Markup {
    let values = account.techniques.iter().map(|by| f64::from(by.code[channel]));
    let (mut least, mut most) = (low, high);
    for value in values.clone() {
        (least, most) = (math::min(value, least), math::max(value, most));
    }
    let span = math::max(most - least, 4.0);
    let start = 0.5 * (least + most - span);
    let x = |value: f64| BAR.1 + (value - start) / span * (BAR.0 - 2.0 * BAR.1);
    let width = math::max(x(high) - x(low), 3.0);
    html! {
        figure.bar {
            figcaption { (name) " " span { (format!("{least:.1} to {most:.1} of 255")) } }
            svg viewBox="0 0 400 62" role="img" aria-label=(format!("{name}: right between {low:.2} and {high:.2}")) {
                path.axis d="M8 31H392" {}
                rect.interval x=(format!("{:.1}", x(low) - 0.5 * (width - (x(high) - x(low))))) y="21" width=(format!("{width:.1}")) height="20" {
                    title { "right: " (format!("{low:.3} to {high:.3}")) }
                }
                @for (k, value) in values.enumerate() {
                    g.value data-of=(account.techniques[k].technique) {
                        path d=(format!("M{:.1} 16v30", x(value))) {}
                        text x=(format!("{:.1}", x(value) + 7.0 * ((k / 2) % 3) as f64 - 7.0)) y=(if k % 2 == 0 { 60 } else { 12 }) { (k + 1) }
                        title { (account.techniques[k].technique) ": " (value) }
                    }
                }
            }
        }
    }
}

/// A colour to look at.
pub(super) fn swatch(color: [f64; 4]) -> Markup {
    html! { span.swatch style=(format!("--c:{}", hex(color))) {} }
}
