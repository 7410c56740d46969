//! What posts are measured by: heights over a plane, and where the posts of a globe stand in space, found fast.
//!
//! Input: a grid's or a globe's posts. Output: [`Heights`], [`Places`]. Refuses: nothing; a post without a height has no place.
//!
//! Both surfaces, as maps from columns and rows to space, are linear over every smallest triangle, and these nest: the largest distance between the points
//! that a place among the posts has on both is that at a post. No point of one surface is farther from the other than that, and where columns and rows are
//! evenly spaced it is the distance between the points of one place of the plan: what is draped is off by no more. What a chord cuts off the ellipsoid is in it.

use super::right_triangle::{Post, RightTriangle};
use super::tile::Measure;
use crate::math;
use crate::terrain::globe::RowOf;
use crate::terrain::{GlobeMesh, Grid};
use glam::DVec3;
use std::sync::Arc;

/// The heights of a grid's posts.
#[derive(Debug)]
pub(super) struct Heights {
    grid: Arc<Grid>,
    slack: f64,
}

impl Heights {
    pub fn new(grid: &Arc<Grid>) -> Self {
        let (low, high) = grid.heights();
        // A plane's coefficients and its heights at posts have a few roundings of numbers up to four times a height.
        let slack = 32.0 * f64::EPSILON * math::max(low.abs(), high.abs());
        Self { grid: Arc::clone(grid), slack }
    }
}

impl Measure for Heights {
    type Value = f64;

    #[inline]
    fn at(&self, [column, row]: Post) -> f64 {
        let (posts, column, row) = (self.grid.posts(), column as usize, row as usize);
        let is_there = column < posts.columns() && row < posts.rows();
        if is_there { posts.heights()[row * posts.columns() + column] } else { f64::NAN }
    }

    fn append(&self, row: u32, [first, last]: [u32; 2], to: &mut Vec<f64>) {
        let posts = self.grid.posts();
        let start = row as usize * posts.columns();
        to.extend_from_slice(&posts.heights()[start + first as usize..=start + last as usize]);
    }

    fn least(&self, _: &RightTriangle, _: [f64; 3]) -> f64 {
        0.0
    }

    fn has_least(&self, _: [u32; 2]) -> bool {
        false
    }

    fn slack(&self) -> f64 {
        self.slack
    }
}

/// What the places of a row's posts have in common: a post as high as h over the ellipsoid is `outward + h * up[0]` from the axis and
/// `along + h * up[1]` above the equator's plane.
#[derive(Debug)]
struct Row {
    outward: f64,
    along: f64,
    up: [f64; 2],
    /// The row's first height; `None`: all are the pole's.
    first: Option<usize>,
    pole: f64,
}

/// The places of a globe's posts, geocentric.
#[derive(Debug)]
pub(super) struct Places {
    globe: Arc<GlobeMesh>,
    /// Cosine and sine of each column's longitude.
    columns: Vec<[f64; 2]>,
    rows: Vec<Row>,
    slack: f64,
}

impl Places {
    pub fn new(globe: &Arc<GlobeMesh>) -> Self {
        let posts = globe.posts();
        let (own, count) = (posts.posts.columns(), globe.size());
        let columns = (0..count[0]).map(|i| {
            let (lon, _) = posts.globe.geographic(posts.posts.plan(i % own, 0));
            [math::cos(lon), math::sin(lon)]
        });
        let row = |j: usize| {
            let at = crate::space::Plan::new(0.0, globe.y_of(j));
            let (_, lat) = posts.globe.geographic(at);
            let [x, _, z] = posts.globe.ellipsoid.geocentric(0.0, lat).to_array();
            let up = [math::cos(lat), math::sin(lat)];
            match globe.row(j) {
                RowOf::Posts(row) => Row { outward: x, along: z, up, first: Some(row * own), pole: f64::NAN },
                // All columns meet there.
                RowOf::Pole(pole) => {
                    let pole = posts.poles[pole].unwrap_or(f64::NAN);
                    Row { outward: 0.0, along: z, up: [0.0, up[1]], first: None, pole }
                }
            }
        };
        let rows = (0..count[1]).map(row).collect();
        let (low, high) = globe.heights();
        let ellipsoid = posts.globe.ellipsoid;
        // Some of the last digits of coordinates.
        let slack = 64.0 * f64::EPSILON * (ellipsoid.a + ellipsoid.b() + math::max(low.abs(), high.abs()));
        Self { globe: Arc::clone(globe), columns: columns.collect(), rows, slack }
    }

    /// The place of a post of a row, by its height there; NaN where it has none.
    #[inline(always)]
    fn place(&self, of: &Row, column: usize, height: f64) -> DVec3 {
        let [cos, sin] = self.columns[column];
        let outward = of.outward + height * of.up[0];
        DVec3::new(outward * cos, outward * sin, of.along + height * of.up[1])
    }

    /// The height of a post of a row.
    #[inline(always)]
    fn height(&self, of: &Row, column: usize) -> f64 {
        let posts = &self.globe.posts().posts;
        // The last column of a full circle is the first one.
        let own = if column < posts.columns() { column } else { column - posts.columns() };
        of.first.map_or(of.pole, |first| posts.heights()[first + own])
    }

    /// How far, on the ground, a triangle with a single corner at a pole has its places beside those of the posts. The corner stands between the columns of the
    /// others and not in its own: with a share w of it a place moves by w of half the columns' distance at most, on a parallel that is no larger than pi/2 (1 - w) of the
    /// others' largest: by pi/16 of the product at most.
    fn aside_at_a_pole(&self, corners: &[Post; 3], places: [DVec3; 3]) -> f64 {
        let is_at_pole = corners.map(|post| self.rows[post[1] as usize].first.is_none());
        let Some(k) = is_at_pole.iter().position(|is| *is) else { return 0.0 };
        if is_at_pole.iter().filter(|is| **is).count() > 1 {
            return 0.0;
        }
        let others = [1, 2].map(|next| (k + next) % 3);
        let [west, east] = others.map(|k| self.globe.posts().column(corners[k][0] as usize));
        let [one, other] = others.map(|k| places[k].truncate().length());
        let angle = (east - west).abs() / self.globe.posts().globe.ellipsoid.a;
        0.25 * angle * math::max(one, other)
    }
}

impl Measure for Places {
    type Value = DVec3;

    #[inline]
    fn at(&self, [column, row]: Post) -> DVec3 {
        match self.rows.get(row as usize) {
            Some(of) if (column as usize) < self.columns.len() => {
                self.place(of, column as usize, self.height(of, column as usize))
            }
            _ => DVec3::NAN,
        }
    }

    fn append(&self, row: u32, [first, last]: [u32; 2], to: &mut Vec<DVec3>) {
        let of = &self.rows[row as usize];
        let columns = first as usize..=last as usize;
        to.extend(columns.map(|column| self.place(of, column, self.height(of, column))));
    }

    fn least(&self, triangle: &RightTriangle, corners: [DVec3; 3]) -> f64 {
        self.aside_at_a_pole(&triangle.corners(), corners)
    }

    fn has_least(&self, rows: [u32; 2]) -> bool {
        rows.iter().any(|row| self.rows[*row as usize].first.is_none())
    }

    fn slack(&self) -> f64 {
        self.slack
    }
}
