//! A few pixels, large, with what lies in them.

use super::drawing::{At, Drawing};
use super::shot::Shot;
use crate::buffer::Buffer;
use crate::error::Result;
use crate::space::Plan;
use crate::technique::Kind;

/// The pixels of a shot, each so many units wide and high.
pub(super) struct PixelGrid<'a> {
    shot: &'a Shot,
    side: f64,
}

impl<'a> PixelGrid<'a> {
    /// All pixels of a shot's picture.
    pub(super) fn new(shot: &'a Shot, side: f64) -> Self {
        Self { shot, side }
    }

    /// An empty drawing of them.
    pub(super) fn drawing(&self, title: &str) -> Drawing {
        let [width, height] = [self.shot.view.width(), self.shot.view.height()].map(|n| n as f64);
        Drawing::new(title, [self.side * width, self.side * height])
    }

    /// Where a point of the plan is seen.
    pub(super) fn at(&self, point: Plan) -> At {
        let seen = self.shot.view.screen_from_world(self.shot.on_ground(point));
        seen.map_or([f64::NAN; 2], |at| [self.side * at.x, self.side * at.y])
    }

    /// Where points of the plan are seen.
    pub(super) fn all(&self, points: &[Plan]) -> Vec<At> {
        points.iter().map(|point| self.at(*point)).collect()
    }

    /// A pixel's square.
    pub(super) fn square(&self, [x, y]: [usize; 2]) -> Vec<At> {
        let corners = [[0, 0], [1, 0], [1, 1], [0, 1]];
        corners.iter().map(|[dx, dy]| [x + dx, y + dy].map(|v| v as f64 * self.side)).collect()
    }

    /// Draws a picture of them.
    pub(super) fn picture(&self, drawing: &mut Drawing, picture: &Buffer<[u8; 4]>) -> Result<()> {
        let size = [picture.width(), picture.height()].map(|n| n as f64 * self.side);
        drawing.picture(picture, [0.0, 0.0], size)
    }

    /// Draws the lines between them.
    pub(super) fn lines(&self, drawing: &mut Drawing) {
        let [width, height] = [self.shot.view.width(), self.shot.view.height()];
        let at = |x: usize, y: usize| [x as f64 * self.side, y as f64 * self.side];
        (0..=width).for_each(|x| drawing.line(&[at(x, 0), at(x, height)], "grid edge thin"));
        (0..=height).for_each(|y| drawing.line(&[at(0, y), at(width, y)], "grid edge thin"));
    }

    /// Draws samples: full where a stencil volume holds them. One a pixel at its centre, or nine each in pixels that `is_wanted`.
    pub(super) fn samples(
        &self,
        drawing: &mut Drawing,
        [text, more]: [&str; 2],
        n: usize,
        is_wanted: &dyn Fn([usize; 2]) -> bool,
    ) -> Result<()> {
        let samples = format!("technique.stencil-volume.samples={n}");
        let shot = Shot::of(text, &[more, &samples])?;
        let counts = shot.frame(Kind::StencilVolume, &["stencil"])?.whole::<1>("stencil")?;
        let columns = n * shot.view.width();
        for (k, [count]) in counts.iter().enumerate() {
            let [x, y] = [k % columns, k / columns];
            if is_wanted([x / n, y / n]) {
                let at = [x, y].map(|v| (v as f64 + 0.5) * self.side / n as f64);
                let class = if *count > 0 { "orange dot" } else { "soft open" };
                drawing.dot(at, 4.0 / n as f64 + 1.0, class);
            }
        }
        Ok(())
    }
}
