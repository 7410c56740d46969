//! Curves as small plots, one a technique: logarithmic both ways, zeros on the axis.

use super::super::stability::Curve;
use super::super::text::number;
use crate::math;
use maud::{Markup, html};

/// The plot's rectangle in its picture: left, top, right, bottom.
const FIELD: [f64; 4] = [46.0, 22.0, 290.0, 150.0];
/// The room for zeros below the logarithms.
const ZERO: f64 = 12.0;
/// What tells machines apart beside their colours.
const DASHES: [&str; 4] = ["none", "6 4", "2 3", "8 3 2 3"];

/// The part of the page with all plots.
pub(super) fn section(curves: &[Curve]) -> Markup {
    let mut subjects: Vec<&str> = Vec::new();
    curves.iter().for_each(|curve| {
        if !subjects.contains(&curve.over) {
            subjects.push(curve.over);
        }
    });
    html! {
        section id="stability" {
            h2 { "Numerical stability" }
            p { "How the error grows with what makes a scene hard, on each machine. Zeros lie on the axis. Techniques that refuse the scenes have no plot." }
            (legend(curves))
            @for over in subjects {
                @let of: Vec<&Curve> = curves.iter().filter(|curve| curve.over == over).collect();
                h3 { (of[0].error) " over " (over) }
                div.plots { @for plot in plots(&of) { (plot) } }
            }
        }
    }
}

fn legend(curves: &[Curve]) -> Markup {
    html! {
        p.legend {
            @for (number, name) in machines(curves.iter()).iter().enumerate() {
                span {
                    svg viewBox="0 0 34 12" aria-hidden="true" { path.s style={ "--c:var(--c" (number % 4) ")" } stroke-dasharray=(DASHES[number % 4]) d="M1 6L33 6" {} }
                    " " (name)
                }
            }
        }
    }
}

fn machines<'a>(curves: impl Iterator<Item = &'a Curve>) -> Vec<&'static str> {
    let mut names = Vec::new();
    curves.for_each(|curve| {
        if !names.contains(&curve.machine) {
            names.push(curve.machine);
        }
    });
    names
}

/// A plot a technique; all have the same axes.
fn plots(curves: &[&Curve]) -> Vec<Markup> {
    let all = || curves.iter().flat_map(|curve| &curve.points);
    let axes = [Axis::around(all().map(|point| point[0])), Axis::around(all().map(|point| point[1]))];
    let machines = machines(curves.iter().copied());
    let mut techniques: Vec<&str> = curves.iter().map(|curve| curve.technique).collect();
    techniques.dedup();
    let plot = |technique: &&str| {
        let of: Vec<(usize, &Curve)> = curves
            .iter()
            .filter(|curve| curve.technique == *technique)
            .map(|curve| (machines.iter().position(|name| *name == curve.machine).unwrap_or(0), *curve))
            .collect();
        svg(technique, &axes, &of)
    };
    techniques.iter().map(plot).collect()
}

fn svg(technique: &str, axes: &[Axis; 2], curves: &[(usize, &Curve)]) -> Markup {
    let [left, top, right, bottom] = FIELD;
    let place = |point: &[f64; 2]| {
        [left + axes[0].place(point[0]) * (right - left), bottom - axes[1].place(point[1]) * (bottom - top)]
    };
    html! {
        svg viewBox="0 0 300 172" role="img" aria-label=(technique) {
            text.strong x="46" y="14" { (technique) }
            @for (share, word) in axes[1].marks() {
                @let y = bottom - share * (bottom - top);
                path.grid d={ "M" (left) " " (fixed(y)) "L" (right) " " (fixed(y)) } {}
                text x=(left - 5.0) y=(fixed(y + 4.0)) text-anchor="end" { (word) }
            }
            @for (share, word) in axes[0].marks() {
                text x=(fixed(left + share * (right - left))) y=(bottom + 15.0) text-anchor="middle" { (word) }
            }
            path.frame d={ "M" (left) " " (top) "L" (left) " " (bottom) "L" (right) " " (bottom) } {}
            @for (number, curve) in curves {
                @let places: Vec<[f64; 2]> = curve.points.iter().map(place).collect();
                g style={ "--c:var(--c" (number % 4) ")" } {
                    title { (curve.machine) ": " (told(curve)) }
                    path.s stroke-dasharray=(DASHES[number % 4]) d=(path(&places)) {}
                    @for [x, y] in &places { circle.m cx=(fixed(*x)) cy=(fixed(*y)) r="2.6" {} }
                }
            }
        }
    }
}

fn told(curve: &Curve) -> String {
    let point = |[over, error]: &[f64; 2]| format!("{} at {}", number(*error), number(*over));
    curve.points.iter().map(point).collect::<Vec<_>>().join(", ")
}

fn path(places: &[[f64; 2]]) -> String {
    let step = |(k, [x, y]): (usize, &[f64; 2])| {
        format!("{}{} {}", if k == 0 { 'M' } else { 'L' }, fixed(*x), fixed(*y))
    };
    places.iter().enumerate().map(step).collect()
}

fn fixed(value: f64) -> String {
    format!("{value:.1}")
}

/// A logarithmic axis from a power of ten to a power of ten, with a place for zeros.
struct Axis {
    low: i32,
    high: i32,
    has_zero: bool,
}

impl Axis {
    fn around(values: impl Iterator<Item = f64>) -> Self {
        let (mut low, mut high, mut has_zero) = (i32::MAX, i32::MIN, false);
        for value in values {
            if value > 0.0 {
                let exponent = math::ln(value) / std::f64::consts::LN_10;
                (low, high) =
                    (low.min((exponent + 1e-9).floor() as i32), high.max((exponent - 1e-9).ceil() as i32));
            }
            has_zero |= value <= 0.0;
        }
        if low > high {
            return Self { low: -1, high: 0, has_zero };
        }
        Self { low, high: high.max(low + 1), has_zero }
    }

    /// Where a value lies, from 0 to 1.
    fn place(&self, value: f64) -> f64 {
        if value <= 0.0 {
            return 0.0;
        }
        let share = (math::ln(value) / std::f64::consts::LN_10 - f64::from(self.low))
            / f64::from(self.high - self.low);
        let zero = if self.has_zero { ZERO / 128.0 } else { 0.0 };
        zero + (1.0 - zero) * share
    }

    /// Powers of ten and where they lie: at most six.
    fn marks(&self) -> Vec<(f64, String)> {
        let step = (self.high - self.low + 5) / 6;
        let powers = (self.low..=self.high).step_by(step.max(1) as usize);
        let value = |exponent: i32| math::exp(f64::from(exponent) * std::f64::consts::LN_10);
        let word = |exponent: i32| {
            if (-2..=3).contains(&exponent) {
                format!("1e{exponent}").parse::<f64>().map_or(String::new(), |v| format!("{v}"))
            } else {
                format!("1e{exponent}")
            }
        };
        let zero = self.has_zero.then(|| (0.0, "0".to_owned()));
        zero.into_iter().chain(powers.map(|exponent| (self.place(value(exponent)), word(exponent)))).collect()
    }
}
