//! Lines on a small picture.

use crate::raster::device::{Fragment, LinePrimitive, LineStyle, Real, Stipple, Window};
use crate::scene::Device;

/// The picture's columns, and its rows.
pub(super) const SIZE: usize = 10;

pub(super) type Ends = [[f64; 2]; 2];

pub(super) fn picture() -> Window {
    Window { columns: 0..SIZE, rows: 0..SIZE }
}

/// Of depth 0.25 at the start and 0.75 at the end.
pub(super) fn line<T: Real>([[ax, ay], [bx, by]]: Ends) -> LinePrimitive<T> {
    LinePrimitive { ends: [[ax, ay, 0.25], [bx, by, 0.75]].map(|end| end.map(T::of)) }
}

pub(super) fn aliased(width: f64, stipple: Stipple) -> LineStyle {
    LineStyle::new(width, stipple, false, &Device { max_line_width_px: 64.0, ..Device::default() })
}

pub(super) fn smooth(width: f64, stipple: Stipple) -> LineStyle {
    LineStyle::new(width, stipple, true, &Device { max_line_width_px: 64.0, ..Device::default() })
}

/// One pixel wide, without gaps.
pub(super) fn plain() -> LineStyle {
    aliased(1.0, Stipple::SOLID)
}

pub(super) fn fragments(ends: Ends, style: &LineStyle, counter: u64, window: &Window) -> Vec<Fragment> {
    let mut all = Vec::new();
    line::<f64>(ends).draw(style, counter, window, &mut |fragment| all.push(fragment));
    all
}

/// Columns and rows, in the order in which they are drawn.
pub(super) fn pixels(ends: Ends, style: &LineStyle) -> Vec<[usize; 2]> {
    fragments(ends, style, 0, &picture()).iter().map(|f| [f.column, f.row]).collect()
}
