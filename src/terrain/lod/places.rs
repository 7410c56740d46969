//! Where the posts of a globe stand in space, found fast, and how far a triangle of the hierarchy is from those in it.
//!
//! Input: a globe's posts. Output: [`Places`], [`Deviation`]s. Refuses: nothing; a post without a height has no place.
//!
//! Both surfaces, as maps from columns and rows to space, are linear over every smallest triangle, and these nest: the largest distance between the points
//! that a place among the posts has on both is that at a post. No point of one surface is farther from the other than that, and where columns and rows are
//! evenly spaced it is the distance between the points of one place of the plan: what is draped is off by no more. What a chord cuts off the ellipsoid is in it.

use super::deviation::{Deviation, Slope, Window, columns};
use super::right_triangle::{Post, RightTriangle};
use crate::math;
use crate::terrain::GlobeMesh;
use crate::terrain::globe::RowOf;
use glam::DVec3;

/// What the places of a row's posts have in common: a post as high as h over the ellipsoid is `outward + h * up[0]` from the axis and
/// `along + h * up[1]` above the equator's plane.
struct Row {
    outward: f64,
    along: f64,
    up: [f64; 2],
    /// The row's first height; `None`: all are the pole's.
    first: Option<usize>,
    pole: f64,
}

/// The places of a globe's posts, geocentric.
pub(super) struct Places<'g> {
    globe: &'g GlobeMesh,
    /// Cosine and sine of each column's longitude.
    columns: Vec<[f64; 2]>,
    rows: Vec<Row>,
    last: Post,
}

impl<'g> Places<'g> {
    pub(super) fn new(globe: &'g GlobeMesh) -> Self {
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
        let last = count.map(|count| count as u32 - 1);
        Self { globe, columns: columns.collect(), rows: (0..count[1]).map(row).collect(), last }
    }

    /// How far roundings may take a distance: some of the last digits of coordinates.
    pub(super) fn slack(&self) -> f64 {
        let (low, high) = self.globe.heights();
        let ellipsoid = self.globe.posts().globe.ellipsoid;
        64.0 * f64::EPSILON * (ellipsoid.a + ellipsoid.b() + math::max(low.abs(), high.abs()))
    }

    /// The place of a post; NaN where it has no height.
    #[inline]
    fn at(&self, [column, row]: Post) -> DVec3 {
        let of = &self.rows[row as usize];
        let own = self.globe.posts().posts.columns();
        let height = match of.first {
            Some(first) => self.globe.posts().posts.heights()[first + column as usize % own],
            None => of.pole,
        };
        let [cos, sin] = self.columns[column as usize];
        let outward = of.outward + height * of.up[0];
        DVec3::new(outward * cos, outward * sin, of.along + height * of.up[1])
    }

    /// Whether all posts of a row between two columns are there.
    pub(super) fn is_row_whole(&self, row: u32, [low, high]: [u32; 2]) -> bool {
        (low..=high).all(|column| !self.at([column, row]).is_nan())
    }

    /// The deviation of a triangle over the posts of a window; of the smallest that can be split, what their halves' deviations do not tell. A triangle
    /// with a corner at a pole has its places beside those of the posts, too.
    pub(super) fn deviation(&self, triangle: &RightTriangle, window: &Window) -> Deviation {
        let corners = triangle.corners();
        let range = |k: usize| {
            let at = corners.map(|post| post[k]);
            (at[0].min(at[1]).min(at[2]), at[0].max(at[1]).max(at[2]))
        };
        let ((west, east), (south, north)) = (range(0), range(1));
        let is_inside = east <= self.last[0] && north <= self.last[1];
        let places = if is_inside { corners.map(|post| self.at(post)) } else { [DVec3::NAN; 3] };
        let aside = if is_inside { self.aside_at_a_pole(&corners, places) } else { 0.0 };
        if let Some(middle) =
            triangle.middle().filter(|_| is_inside && window.is_whole && triangle.layer() < 3)
        {
            let off = ((places[1] + places[2]) * 0.5 - self.at(middle)).length();
            return Deviation { most: math::max(off, aside), some_there: true, some_missing: false };
        }
        let slope = Slope::of(triangle, places);
        let most = if is_inside && slope.by.iter().any(|by| by.is_nan()) { f64::INFINITY } else { aside };
        let mut found = Deviation { most, some_missing: !is_inside, some_there: false };
        for row in south.max(window.low[1])..north.min(window.high[1]) + 1 {
            let (first, last) = columns(triangle, row);
            for column in first.max(window.low[0]).max(west)..=last.min(window.high[0]) {
                let place = self.at([column, row]);
                let off = (slope.at(column, row) - place).length();
                found.most = math::max(off, found.most);
                found.some_missing |= place.is_nan();
                found.some_there |= !place.is_nan();
            }
        }
        found
    }

    /// How far, on the ground, a triangle with a single corner at a pole has its places beside those of the posts. The corner stands between the columns of the
    /// others and not in its own: with a share w of it a place moves by w of half the columns' distance at most, on a parallel that is no larger than pi/2 (1 - w) of the
    /// others' largest: by pi/16 of the product at most.
    fn aside_at_a_pole(&self, corners: &[Post; 3], places: [DVec3; 3]) -> f64 {
        let is_at_pole = |k: usize| self.rows[corners[k][1] as usize].first.is_none();
        let [k] = (0..3).filter(|k| is_at_pole(*k)).collect::<Vec<_>>()[..] else { return 0.0 };
        let others = [1, 2].map(|next| (k + next) % 3);
        let [west, east] = others.map(|k| self.globe.posts().column(corners[k][0] as usize));
        let [one, other] = others.map(|k| places[k].truncate().length());
        let angle = (east - west).abs() / self.globe.posts().globe.ellipsoid.a;
        0.25 * angle * math::max(one, other)
    }
}
