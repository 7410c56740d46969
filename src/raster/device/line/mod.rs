//! Line segments on the screen -> fragments, as OpenGL draws them (specification 2.1, section 3.4; 4.6, section 14.5).
//!
//! Input: a [`LinePrimitive`] (clipped, in pixels of the screen, snapped as the device snaps), a [`LineStyle`], the
//! line stipple's counter, a [`Window`] of pixels. Output: a [`Fragment`] for each pixel that the line covers
//! there: by the diamond-exit rule, decided exactly (`diamond.rs`), in order from the line's start; or anti-aliased
//! (`rectangle.rs`), dash by dash from the start, each row by row. What is drawn does not depend on the window.
//!
//! OpenGL's window has its y axis up, the screen of `docs/semantics.md` has it down: a row of pixels is the same row
//! seen from the other end, `y` becomes `height - y`. So "lowest" means the greatest row, and the infinitesimal step
//! (-e, -e^2) by which end points are moved is (-e, +e^2) in screen coordinates: left, and by much less down.
//!
//! What the specification leaves open:
//! - fragments of a wide line that replication adds have the depth of their own centres, projected on the segment that
//!   was given;
//! - widths that lie between two whole numbers round away from zero;
//! - the counter of a segment that was clipped ("indeterminate") starts where the clipped segment starts, and what is
//!   cut away does not count; what lies between the guard band and the picture's border does.
//!
//! Refuses: nothing; a segment of no length has no fragments.

mod diamond;
mod rectangle;
mod segment;
mod style;
#[cfg(test)]
mod tests;

pub use segment::LinePrimitive;
pub use style::{LineStyle, Stipple};

use super::fragment::Fragment;
use super::number::Real;
use super::scan::Window;
use diamond::Diamonds;

impl<T: Real> LinePrimitive<T> {
    /// By how much the line stipple's counter grows from the line's start to its end, fragments outside any window
    /// included.
    pub fn steps(&self, style: &LineStyle) -> u64 {
        if style.is_smooth() {
            rectangle::steps(self.plane())
        } else {
            Diamonds::new(self.plane(), style.whole_width()).map_or(0, |diamonds| diamonds.steps())
        }
    }

    /// Calls `visit` with the fragments in a window of the picture's pixels.
    /// `counter` is the line stipple's at the start: 0 for each line of its own (GL_LINES), in a strip (GL_LINE_STRIP)
    /// the sum of the [steps](Self::steps) before. A pixel at which an anti-aliased line's stipple begins again is
    /// visited once a dash.
    pub fn draw(&self, style: &LineStyle, counter: u64, window: &Window, visit: &mut dyn FnMut(Fragment)) {
        let mut emit = |[column, row]: [usize; 2], coverage: f64| {
            let depth = self.depth_at(column as f64 + 0.5, row as f64 + 0.5).get();
            visit(Fragment { column, row, depth, coverage });
        };
        if style.is_smooth() {
            rectangle::visit(self.plane(), style, counter, window, &mut emit);
        } else if let Some(diamonds) = Diamonds::new(self.plane(), style.whole_width()) {
            diamonds.visit(style.stipple(), counter, window, &mut |pixel| emit(pixel, 1.0));
        }
    }
}
