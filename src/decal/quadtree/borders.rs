//! Where the borders of a tree's nodes are: one formula, for all levels.

use crate::math::min;
use crate::space::{Plan, PlanBox};

/// The deepest level: Zechmeister 2020 tries depths of 2 to 16 (section 5.2.3, Figure 5.13).
pub(super) const DEEPEST: u8 = 16;

/// Columns, and rows, of the deepest level.
const FINEST: u32 = 1 << DEEPEST;

/// A node's rectangle: one of the 4^level equal parts of the root's. They are not square, so that a tree fits a long and thin ring (section
/// 4.2.1).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Quad {
    level: u8,
    column: u16,
    row: u16,
}

impl Quad {
    /// The root's.
    pub(super) const ROOT: Self = Self { level: 0, column: 0, row: 0 };

    /// How often the root's rectangle has been divided.
    #[inline]
    pub(super) fn level(self) -> u8 {
        self.level
    }

    /// A quarter of it: 0 south-west, 1 south-east, 2 north-west, 3 north-east. There are none below the deepest level.
    #[inline]
    pub(super) fn child(self, quarter: u16) -> Self {
        Self { level: self.level + 1, column: 2 * self.column + quarter % 2, row: 2 * self.row + quarter / 2 }
    }

    /// Whether it is one of those from a south-western to a north-eastern one of its level.
    #[inline]
    pub(super) fn is_between(self, low: Self, high: Self) -> bool {
        (low.column..=high.column).contains(&self.column) && (low.row..=high.row).contains(&self.row)
    }
}

/// A column and a row of the deepest level.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Place {
    x: u32,
    y: u32,
}

impl Place {
    /// The quarter of a node of the level above in which the node of a level lies that holds the place.
    #[inline]
    pub(super) fn quarter(self, level: u8) -> u32 {
        let shift = u32::from(DEEPEST - level);
        2 * (self.y >> shift & 1) + (self.x >> shift & 1)
    }

    /// The part of a level that holds it.
    #[inline]
    pub(super) fn quad(self, level: u8) -> Quad {
        let shift = u32::from(DEEPEST - level);
        Quad { level, column: (self.x >> shift) as u16, row: (self.y >> shift) as u16 }
    }
}

/// The borders along one axis. They never fall as their number grows, and a border has the same bits on each level: so "the point is in this
/// node" and "the edge meets this node" are said of the same rectangle.
#[derive(Debug, Clone, Copy)]
struct Axis {
    low: f64,
    high: f64,
    /// Half the length: the whole one may be too large for a double.
    half: f64,
    /// Columns of the deepest level in a metre.
    columns: f64,
}

impl Axis {
    fn new(low: f64, high: f64) -> Self {
        let half = 0.5 * high - 0.5 * low;
        Self { low, high, half, columns: 0.5 * f64::from(FINEST) / half }
    }

    /// The lower border of a column of the deepest level; of the one behind the last, the end.
    #[inline]
    fn border(&self, column: u32) -> f64 {
        if column >= FINEST {
            return self.high;
        }
        // The factor is exact. Products and sums are rounded monotonically.
        min(self.low + self.half * (f64::from(column) * (2.0 / FINEST as f64)), self.high)
    }

    /// Whether a column holds a number between the ends: the last one has the end, too.
    #[inline]
    fn has(&self, column: u32, at: f64) -> bool {
        self.border(column) <= at && (column + 1 >= FINEST || at < self.border(column + 1))
    }

    /// The column of the deepest level that holds a number between the ends.
    #[inline]
    fn column(&self, at: f64) -> u32 {
        // The cast saturates.
        let guess = (((at - self.low) * self.columns) as u32).min(FINEST - 1);
        if self.has(guess, at) {
            return guess;
        }
        self.column_by_halves(at)
    }

    #[cold]
    fn column_by_halves(&self, at: f64) -> u32 {
        let (mut column, mut step) = (0, FINEST / 2);
        while step > 0 {
            if self.border(column + step) <= at {
                column += step;
            }
            step /= 2;
        }
        column
    }

    /// The two borders of a column of a level.
    #[inline]
    fn of(&self, level: u8, column: u16) -> (f64, f64) {
        let shift = DEEPEST - level;
        (self.border(u32::from(column) << shift), self.border((u32::from(column) + 1) << shift))
    }

    /// The border between the halves of a column of a level above the deepest.
    #[inline]
    fn middle(&self, level: u8, column: u16) -> f64 {
        self.border((2 * u32::from(column) + 1) << (DEEPEST - level - 1))
    }
}

/// The borders of a tree's nodes.
#[derive(Debug)]
pub(super) struct Borders {
    x: Axis,
    y: Axis,
}

impl Borders {
    /// Those of a tree whose root is a box.
    pub(super) fn new(root: &PlanBox) -> Self {
        Self { x: Axis::new(root.min.x, root.max.x), y: Axis::new(root.min.y, root.max.y) }
    }

    /// A node's rectangle.
    #[inline]
    pub(super) fn of(&self, quad: Quad) -> PlanBox {
        let (west, east) = self.x.of(quad.level, quad.column);
        let (south, north) = self.y.of(quad.level, quad.row);
        PlanBox { min: Plan::new(west, south), max: Plan::new(east, north) }
    }

    /// Where a node above the deepest level is divided.
    #[inline]
    pub(super) fn middle(&self, quad: Quad) -> Plan {
        Plan::new(self.x.middle(quad.level, quad.column), self.y.middle(quad.level, quad.row))
    }

    /// The south-east corner of a node.
    #[inline]
    pub(super) fn corner(&self, quad: Quad) -> Plan {
        let east = self.x.border((u32::from(quad.column) + 1) << (DEEPEST - quad.level));
        Plan::new(east, self.y.border(u32::from(quad.row) << (DEEPEST - quad.level)))
    }

    /// Where a point of the root's box is. A node has its southern and western border; the northern and the eastern one where no other node
    /// follows.
    #[inline]
    pub(super) fn place(&self, at: Plan) -> Place {
        Place { x: self.x.column(at.x), y: self.y.column(at.y) }
    }

    /// The part of the root's box that two boxes share; `None` if there is none.
    pub(super) fn shared(one: &PlanBox, other: &PlanBox) -> Option<PlanBox> {
        let shared = one.common(other);
        (!shared.is_empty()).then_some(shared)
    }
}
