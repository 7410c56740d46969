//! The edges of one row in the order of their columns, for items with many edges: what stands west of a texel is carried along from
//! column to column instead of being collected anew for each.

use super::fixed::{BITS, Edge, Fixed, ONE};
use super::winding::{Fragment, Texel, Windings};

/// A part of an edge in one texel of the row (in column 0 of all: west of the tile).
#[derive(Debug, Clone, Copy)]
struct EdgePart {
    /// The column, counted from the one west of the tile.
    column: u32,
    top: Fixed,
    bottom: Fixed,
    sign: i32,
    /// Whether it lies within the texel; otherwise on its eastern side, where it only matters to what is east of it.
    is_within: bool,
}

/// A row of a tile.
#[derive(Debug, Default)]
pub(super) struct Sweep {
    is_ready: bool,
    parts: Vec<EdgePart>,
    /// The parts of columns before this have been passed.
    column: u32,
    /// So many parts have been passed.
    passed: usize,
    /// The winding number at the north-western corner of the column, and changes along its western side: height and sign.
    corner: i32,
    steps: Vec<(i64, i32)>,
}

impl Sweep {
    /// Forgets the row.
    pub(super) fn clear(&mut self) {
        self.is_ready = false;
    }

    /// Gets ready for a row of `width` texels, if it is not; `edges` are those that pass through it.
    pub(super) fn prepare(&mut self, row: usize, width: i32, edges: impl Iterator<Item = Edge>) {
        if std::mem::replace(&mut self.is_ready, true) {
            return;
        }
        self.parts.clear();
        for edge in edges {
            self.add(&edge, row, i64::from(width));
        }
        // Stable: parts of a column stay in the order of the edges.
        self.parts.sort_by_key(|part| part.column);
        self.restart();
    }

    fn restart(&mut self) {
        (self.column, self.passed, self.corner) = (0, 0, 0);
        self.steps.clear();
    }

    /// Cuts an edge at the sides of the columns, as [`super::exact`] does for a texel alone.
    fn add(&mut self, edge: &Edge, row: usize, width: i64) {
        let part = edge.in_row(row as i64);
        let (least, most) = (part.top.x.min(part.bottom.x), part.top.x.max(part.bottom.x));
        let y_at = |x: i64| edge.y_at(x).clamp(part.top.y, part.bottom.y);
        let mut push = |column: i64, (top, bottom): (Fixed, Fixed), is_within: bool| {
            if top.y < bottom.y {
                self.parts.push(EdgePart {
                    column: (column + 1) as u32,
                    top,
                    bottom,
                    sign: edge.sign,
                    is_within,
                });
            }
        };
        if most <= 0 {
            return push(-1, (part.top, part.bottom), false);
        }
        if least == most && least & (ONE - 1) == 0 {
            let column = (least >> BITS) - 1;
            return if column < width {
                push(column, (part.top, part.bottom), false)
            };
        }
        let runs_east = part.top.x <= part.bottom.x;
        let first = (least >> BITS).max(-1);
        let last = ((most - 1) >> BITS).min(width - 1);
        for column in first..=last {
            let (west, east) = (column << BITS, (column + 1) << BITS);
            let (mut top, mut bottom) = (part.top, part.bottom);
            if least < west && column >= 0 {
                let cut = Fixed { x: west, y: y_at(west) };
                if runs_east { top = cut } else { bottom = cut }
            }
            if most > east {
                let cut = Fixed { x: east, y: y_at(east) };
                if runs_east { bottom = cut } else { top = cut }
            }
            push(column, (top, bottom), column >= 0);
        }
    }

    /// Adds all that has a part in a texel of the row, or stands west of it, to `texel`; crossing an edge changes windings by `adds`.
    pub(super) fn gather(&mut self, row: usize, column: usize, adds: Windings, texel: &mut Texel) {
        let column = column as u32 + 1;
        if column < self.column {
            self.restart();
        }
        while let Some(part) = self.parts.get(self.passed).filter(|part| part.column < column) {
            self.steps.extend([(part.top.y, part.sign), (part.bottom.y, -part.sign)]);
            self.passed += 1;
        }
        self.column = column;
        self.merge((row as i64) << BITS);

        let times = |sign: i32| adds.map(|v| v * sign);
        let start = Fixed { x: i64::from(column - 1) << BITS, y: (row as i64) << BITS };
        let unit = |v: i64| v as f64 / ONE as f64;
        texel.add_corner(times(self.corner));
        for &(y, sign) in &self.steps {
            texel.add_step(unit(y - start.y), times(sign));
        }
        let here = self.parts[self.passed..].iter().take_while(|part| part.column == column);
        for part in here.filter(|part| part.is_within) {
            let point = |p: Fixed| [unit(p.x - start.x), unit(p.y - start.y)];
            let (top, bottom) = (point(part.top), point(part.bottom));
            texel.fragments.push(Fragment { top, bottom, adds: times(part.sign) });
        }
    }

    /// Joins steps at one height; those at the row's northern side belong to the corner.
    fn merge(&mut self, north: i64) {
        self.steps.sort_unstable_by_key(|step| step.0);
        let mut kept = 0;
        let mut next = 0;
        while next < self.steps.len() {
            let y = self.steps[next].0;
            let mut sum = 0;
            while let Some(step) = self.steps.get(next).filter(|step| step.0 == y) {
                sum += step.1;
                next += 1;
            }
            if y <= north {
                self.corner += sum;
            } else if sum != 0 {
                self.steps[kept] = (y, sum);
                kept += 1;
            }
        }
        self.steps.truncate(kept);
    }
}
