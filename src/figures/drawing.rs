//! Drawings as SVG: of structures, light or dark as the reader's screen is, in colours that people who do not tell red from green tell
//! apart (M. Okabe and K. Ito, *Color Universal Design*, 2008).

use crate::buffer::Buffer;
use crate::error::{Error, Result};
use crate::output::{base64, small_png};
use crate::space::Plan;
use maud::{Markup, PreEscaped, html};

const STYLE: &str = include_str!("drawing.css");

/// A point of a drawing: right and down, in its units.
pub(super) type At = [f64; 2];

/// A drawing as it is made. Classes say how something looks: a colour (`ink soft grid blue orange green pink gold sky`), then `edge`
/// (`thin thick dash`), `area` (`faint full`), `dot` or `open`.
pub(super) struct Drawing {
    size: [f64; 2],
    title: String,
    parts: Vec<Markup>,
}

impl Drawing {
    /// An empty one of a width and a height; the title is for those who do not see it.
    pub(super) fn new(title: impl Into<String>, size: [f64; 2]) -> Self {
        Self { size, title: title.into(), parts: Vec::new() }
    }

    /// Rings as one area, even-odd.
    pub(super) fn rings(&mut self, rings: &[Vec<At>], class: &str) {
        let path: String = rings.iter().map(|ring| path(ring) + "Z").collect();
        self.parts.push(html! { path class=(class) d=(path) {} });
    }

    /// A closed ring.
    pub(super) fn ring(&mut self, ring: &[At], class: &str) {
        self.rings(&[ring.to_vec()], class);
    }

    /// A line through points.
    pub(super) fn line(&mut self, points: &[At], class: &str) {
        if points.len() > 1 {
            self.parts.push(html! { path class=(class) d=(path(points)) {} });
        }
    }

    /// A line with a head at its end.
    pub(super) fn arrow(&mut self, [from, to]: [At; 2], class: &str) {
        let along = [to[0] - from[0], to[1] - from[1]];
        let length = crate::math::max((along[0] * along[0] + along[1] * along[1]).sqrt(), 1e-9);
        let [x, y] = along.map(|v| 7.0 * v / length);
        let head =
            [[to[0] - x - 0.4 * y, to[1] - y + 0.4 * x], to, [to[0] - x + 0.4 * y, to[1] - y - 0.4 * x]];
        self.line(&[from, to], class);
        self.line(&head, class);
    }

    /// A dot.
    pub(super) fn dot(&mut self, at: At, radius: f64, class: &str) {
        self.parts
            .push(html! { circle class=(class) cx=(fixed(at[0])) cy=(fixed(at[1])) r=(fixed(radius)) {} });
    }

    /// A word; the anchor is `start`, `middle` or `end`.
    pub(super) fn word(&mut self, at: At, anchor: &str, word: &str) {
        let [x, y] = at.map(fixed);
        self.parts.push(html! { text x=(x) y=(y) text-anchor=(anchor) { (word) } });
    }

    /// A small word.
    pub(super) fn small(&mut self, at: At, anchor: &str, word: &str) {
        let [x, y] = at.map(fixed);
        self.parts.push(html! { text.small x=(x) y=(y) text-anchor=(anchor) { (word) } });
    }

    /// A picture in a rectangle.
    pub(super) fn picture(&mut self, picture: &Buffer<[u8; 4]>, at: At, size: [f64; 2]) -> Result<()> {
        let png = small_png(picture)
            .map_err(|error| Error::internal(format!("a picture of a figure: {error}")).caused_by(error))?;
        let ([x, y], [width, height]) = (at.map(fixed), size.map(fixed));
        let source = format!("data:image/png;base64,{}", base64(&png));
        self.parts.push(html! {
            image x=(x) y=(y) width=(width) height=(height) preserveAspectRatio="none" href=(source) {}
        });
        Ok(())
    }

    /// The document.
    pub(super) fn svg(self) -> String {
        let [width, height] = self.size;
        let drawn = html! {
            svg.fig xmlns="http://www.w3.org/2000/svg" viewBox={ "0 0 " (width) " " (height) } role="img" aria-label=(self.title) {
                style { (PreEscaped(STYLE)) }
                rect.paper width=(width) height=(height) {}
                @for part in &self.parts { (part) }
            }
        };
        drawn.into_string() + "\n"
    }
}

/// A part of the plan as it lies in a drawing: north up, one scale.
#[derive(Debug, Clone, Copy)]
pub(super) struct Window {
    west_north: Plan,
    corner: At,
    scale: f64,
}

impl Window {
    /// The smallest part of the plan that holds the points, as large as it goes into a drawing's rectangle (left, top, width, height).
    pub(super) fn around(
        points: impl IntoIterator<Item = Plan>,
        [left, top, width, height]: [f64; 4],
    ) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in points {
            for (k, v) in [point.x, point.y].into_iter().enumerate() {
                low[k] = crate::math::min(low[k], v);
                high[k] = crate::math::max(high[k], v);
            }
        }
        let span = [0, 1].map(|k| crate::math::max(high[k] - low[k], 1e-9));
        let scale = crate::math::min(width / span[0], height / span[1]);
        let corner = [left + 0.5 * (width - scale * span[0]), top + 0.5 * (height - scale * span[1])];
        Self { west_north: Plan::new(low[0], high[1]), corner, scale }
    }

    /// Where a point lies.
    pub(super) fn at(&self, point: Plan) -> At {
        let away = point - self.west_north;
        [self.corner[0] + self.scale * away.x, self.corner[1] - self.scale * away.y]
    }

    /// Where points lie.
    pub(super) fn all(&self, points: &[Plan]) -> Vec<At> {
        points.iter().map(|point| self.at(*point)).collect()
    }
}

/// `M x y L x y ...`
fn path(points: &[At]) -> String {
    let point =
        |(k, [x, y]): (usize, &At)| format!("{}{} {}", if k == 0 { 'M' } else { 'L' }, fixed(*x), fixed(*y));
    points.iter().enumerate().map(point).collect()
}

/// A coordinate to a hundredth.
fn fixed(v: f64) -> String {
    format!("{v:.2}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_window_keeps_the_shape_and_has_north_up() {
        let corners = [Plan::new(0.0, 0.0), Plan::new(10.0, 5.0)];
        let window = Window::around(corners, [0.0, 0.0, 100.0, 100.0]);
        assert_eq!(window.at(corners[0]), [0.0, 75.0]);
        assert_eq!(window.at(corners[1]), [100.0, 25.0]);
    }

    #[test]
    fn words_cannot_break_a_document() {
        let mut drawing = Drawing::new("a < b", [10.0, 10.0]);
        drawing.word([1.0, 1.0], "start", "<&>");
        let text = drawing.svg();
        roxmltree::Document::parse(&text).unwrap();
        assert!(text.contains("&lt;&amp;&gt;"));
    }
}
