//! A grid in one CRS -> a grid along the axes of a plan in another.
//!
//! Bilinear between the four posts of the source around each place; no data where any of the four has none. The posts
//! stand at whole multiples of the cell from the anchor, the cell keeps the source's resolution. A source may lie on any turn of
//! longitude, across the antimeridian or all around the globe: there its last column is followed by its first.

use super::extent::middle;
use crate::crs::{PlanFrom, Turn};
use crate::error::{Error, Result};
use crate::math::max;
use crate::parallel;
use crate::scene::Posts;
use crate::source::dem::MAX_POSTS;
use crate::space::{Plan, PlanBox};
use glam::DVec2;

/// A grid in local coordinates and what they are relative to.
pub(super) struct Resampled {
    pub(super) posts: Posts,
    pub(super) anchor: DVec2,
}

/// Resamples a grid; `map` leads from its coordinates to the plan.
pub(super) fn resample(source: &Posts, map: &PlanFrom) -> Result<Resampled> {
    let bounds = image_of_border(source, map)?;
    let anchor = middle(bounds);
    let cell = cell(source, map)?;
    let low = ((bounds.min.to_vec() - anchor) / cell).ceil();
    let high = ((bounds.max.to_vec() - anchor) / cell).floor();
    let size = high - low + DVec2::ONE;
    if !(size.x >= 2.0 && size.y >= 2.0 && size.x * size.y <= MAX_POSTS as f64) {
        return Err(Error::unsupported(format!(
            "resampled, the terrain would have {} x {} posts",
            size.x, size.y
        ))
        .help("leave `crs` out, or read a part of the terrain (`window`)"));
    }
    let (columns, rows) = (size.x as usize, size.y as usize);
    let turned = Turned::of(source, map);
    let row = |j: usize| -> Vec<f64> {
        let place = |i: usize| anchor + (low + DVec2::new(i as f64, j as f64)) * cell;
        (0..columns).map(|i| height(source, map, &turned, place(i))).collect()
    };
    let heights = parallel::map_indices(rows, row).concat();
    if heights.iter().all(|z| z.is_nan()) {
        return Err(Error::new("no post of the resampled terrain holds data"));
    }
    let steps = (DVec2::new(cell.x, 0.0), DVec2::new(0.0, cell.y));
    let posts = Posts::new((columns, rows), Plan::from(low * cell), steps, heights)?;
    Ok(Resampled { posts, anchor })
}

/// The rectangle of the plan around the source's outer posts.
fn image_of_border(source: &Posts, map: &PlanFrom) -> Result<PlanBox> {
    let (last_i, last_j) = (source.columns() - 1, source.rows() - 1);
    let along = (0..=last_i).flat_map(|i| [(i, 0), (i, last_j)]);
    let across = (0..=last_j).flat_map(|j| [(0, j), (last_i, j)]);
    let mut bounds = PlanBox::EMPTY;
    for (i, j) in along.chain(across) {
        bounds.include(Plan::from(map.apply_unrolled(source.plan(i, j).to_vec())?));
    }
    Ok(bounds)
}

/// The source's spacing in the plan, at its middle, to three digits.
fn cell(source: &Posts, map: &PlanFrom) -> Result<DVec2> {
    let middle = source.plan((source.columns() - 1) / 2, (source.rows() - 1) / 2);
    let at = |p: Plan| map.apply_unrolled(p.to_vec());
    let east = at(middle + source.east())? - at(middle)?;
    let north = at(middle + source.north())? - at(middle)?;
    let lengths = DVec2::new(east.length(), north.length());
    let turned = east.x.abs() < east.y.abs();
    let lengths = if turned { DVec2::new(lengths.y, lengths.x) } else { lengths };
    Ok(DVec2::new(three_digits(lengths.x), three_digits(lengths.y)))
}

fn three_digits(v: f64) -> f64 {
    format!("{v:.2e}").parse().unwrap_or(v)
}

/// The turns of longitude that a grid counts in.
struct Turned {
    turn: Option<Turn>,
    /// Whether the grid goes around the globe, so that a step east of its last column is its first one.
    is_closed: bool,
}

impl Turned {
    fn of(source: &Posts, map: &PlanFrom) -> Self {
        let turn = map.file().turn();
        let is_a_turn = |turn: Turn| {
            let width = source.east() * source.columns() as f64;
            width.y == 0.0 && (width.x - turn.length).abs() < CLOSED * source.east().x
        };
        Self { turn, is_closed: turn.is_some_and(is_a_turn) }
    }

    /// A displacement from the first post, on the turn around the grid's middle.
    fn within(&self, source: &Posts, off: DVec2) -> DVec2 {
        let Some(turn) = self.turn else { return off };
        let half = source.east().x * 0.5 * (source.columns() - 1) as f64;
        let turns = ((off.x - half) / turn.length).round();
        DVec2::new(off.x - turn.length * turns, off.y)
    }
}

/// A grid whose columns make a turn but for this share of a cell goes around the globe.
const CLOSED: f64 = 0.01;

/// The source's height at a place of the plan; NaN outside and beside holes.
fn height(source: &Posts, map: &PlanFrom, turned: &Turned, plan: DVec2) -> f64 {
    let Ok(place) = map.invert_unrolled(plan) else {
        return f64::NAN;
    };
    let off = turned.within(source, place - source.first.to_vec());
    let area = source.east().perp_dot(source.north());
    let column = snapped(off.perp_dot(source.north()) / area);
    let row = snapped(source.east().perp_dot(off) / area);
    let (columns, rows) = (source.columns(), source.rows());
    let (column, cells) = match turned.is_closed {
        true if column < 0.0 => (column + columns as f64, columns),
        true => (column, columns),
        false => (column, columns - 1),
    };
    let (Some((i, f)), Some((j, g))) = (split(column, cells), split(row, rows - 1)) else {
        return f64::NAN;
    };
    let z = |i: usize, j: usize| source.heights()[j * columns + i % columns];
    let south = z(i, j) * (1.0 - f) + z(i + 1, j) * f;
    let north = z(i, j + 1) * (1.0 - f) + z(i + 1, j + 1) * f;
    south * (1.0 - g) + north * g
}

/// A place of the grid, moved to the post that it misses by rounding only.
fn snapped(v: f64) -> f64 {
    let nearest = v.round();
    let slack = 1e-9 * max(nearest.abs(), 1.0);
    if (v - nearest).abs() <= slack { nearest } else { v }
}

/// The cell, and how far into it.
fn split(v: f64, cells: usize) -> Option<(usize, f64)> {
    if !(v >= 0.0 && v <= cells as f64) {
        return None;
    }
    let cell = (v as usize).min(cells - 1);
    Some((cell, v - cell as f64))
}
