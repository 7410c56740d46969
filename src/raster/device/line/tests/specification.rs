//! What the specification defines, word by word, in rational arithmetic and in its own window coordinates: y up.

use super::drawing::{Ends, SIZE};
use dashu::base::Abs;
use dashu::integer::IBig;
use dashu::rational::{RBig, Relaxed};
use std::collections::BTreeSet;

type R = Relaxed;
type Point = [R; 2];

fn exact(v: f64) -> R {
    RBig::try_from(v).unwrap().relax()
}

fn half() -> R {
    exact(0.5)
}

/// "A tiny amount": by far less than what two different results of these tests differ by.
fn tiny() -> R {
    R::ONE / R::from(IBig::ONE << 400)
}

/// (x, y) - (e, e^2).
fn perturbed([x, y]: &Point) -> Point {
    [x.clone() - tiny(), y.clone() - tiny() * tiny()]
}

/// The four numbers that are negative in the diamond around a centre.
fn sides(p: &Point, centre: &Point) -> [R; 4] {
    let (x, y) = (p[0].clone() - centre[0].clone(), p[1].clone() - centre[1].clone());
    [
        x.clone() + y.clone() - half(),
        x.clone() - y.clone() - half(),
        y.clone() - x.clone() - half(),
        R::ZERO - x - y - half(),
    ]
}

fn is_inside(p: &Point, centre: &Point) -> bool {
    sides(p, centre).iter().all(|side| *side < R::ZERO)
}

fn meets(a: &Point, b: &Point, centre: &Point) -> bool {
    let (mut from, mut to) = (R::ZERO, R::ONE);
    for (at_a, at_b) in sides(a, centre).into_iter().zip(sides(b, centre)) {
        if at_a >= R::ZERO && at_b >= R::ZERO {
            return false;
        }
        if (at_a >= R::ZERO) != (at_b >= R::ZERO) {
            let enters = at_a >= R::ZERO;
            let t = at_a.clone() / (at_a - at_b);
            if enters {
                from = if t > from { t } else { from };
            } else {
                to = if t < to { t } else { to };
            }
        }
    }
    from < to
}

/// Columns and rows of the picture that a line of a whole width has.
pub(super) fn fragments([a, b]: Ends, width: i64) -> BTreeSet<[usize; 2]> {
    let size = SIZE as i64;
    let up = |[x, y]: [f64; 2]| [exact(x), exact(size as f64) - exact(y)];
    let (mut from, mut to) = (up(a), up(b));
    let extent = |k: usize| (to[k].clone() - from[k].clone()).abs();
    let is_x_major = extent(0) >= extent(1);
    let minor = usize::from(is_x_major);
    let shift = exact((width - 1) as f64 / 2.0);
    from[minor] = from[minor].clone() - shift.clone();
    to[minor] = to[minor].clone() - shift;
    let (from, to) = (perturbed(&from), perturbed(&to));
    let near = |axis: usize, centre: f64| {
        let (low, high) = if a[axis] < b[axis] { (a[axis], b[axis]) } else { (b[axis], a[axis]) };
        let beside = if axis == minor { width as f64 } else { 1.0 };
        centre > low - beside - 1.0 && centre < high + beside + 1.0
    };
    let mut all = BTreeSet::new();
    for column in -width..size + width {
        for row in -width..size + width {
            let (x, y) = (column as f64 + 0.5, row as f64 + 0.5);
            if !(near(0, x) && near(1, size as f64 - y)) {
                continue;
            }
            let centre = [exact(x), exact(y)];
            if !meets(&from, &to, &centre) || is_inside(&to, &centre) {
                continue;
            }
            for k in 0..width {
                let [column, row] = if is_x_major { [column, row + k] } else { [column + k, row] };
                if (0..size).contains(&column) && (0..size).contains(&row) {
                    all.insert([column as usize, (size - 1 - row) as usize]);
                }
            }
        }
    }
    all
}
