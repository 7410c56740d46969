//! The posts of a globe's terrain: where they stand, what closes a full circle, and what becomes of the poles.

use crate::crs::{Crs, PlanSpace};
use crate::error::{Error, Result};
use crate::math::{max, min};
use crate::scene::{GlobePosts, Posts, Surface};
use crate::space::{Globe, Plan};
use glam::{DVec2, DVec3};

/// Posts this share of a step from where they would be are there.
const SLACK: f64 = 0.01;

/// A cap at a pole is no higher than so many steps of latitude: the half cell that posts in the middle of cells leave.
const CAP: f64 = 0.5;

/// Degrees that a terrain may span and yet have a local zero of its own: of larger ones it is the globe's centre.
const REGIONAL: f64 = 90.0;

/// The surface of a terrain in longitude and latitude, its plan, and the place of the plan that it is relative to.
pub(in crate::source::load) fn terrain(
    surface: Surface,
    crs: Crs,
    note: &mut dyn FnMut(String),
) -> Result<(GlobePosts, PlanSpace, DVec2)> {
    let unit = crs.degrees_per_unit().unwrap_or(1.0);
    let posts = degrees(surface, unit)?;
    let (posts, is_closed) = around(posts, note)?;
    let span = if is_closed { 360.0 } else { (posts.columns() - 1) as f64 * posts.east().x };
    let space = PlanSpace::globe(posts.first.x + 0.5 * span, crs)?;
    let ellipsoid = space.ellipsoid().ok_or_else(|| Error::internal("a globe without an ellipsoid"))?;
    let (posts, poles) = to_the_poles(posts, is_closed, note)?;
    let scale = ellipsoid.a.to_radians();
    let first = posts.first.to_vec() * scale;
    let steps = (posts.east() * scale, posts.north() * scale);
    let size = (posts.columns(), posts.rows());
    let local = |first: DVec2, heights| Posts::new(size, Plan::from(first), steps, heights);
    let globe = Globe { ellipsoid, plan_origin: DVec2::ZERO, world_origin: DVec3::ZERO };
    let placed = GlobePosts { posts: local(first, posts.into_heights())?, globe, is_closed, poles };
    let bounds = placed.plan_bounds();
    let anchor = super::super::extent::middle(bounds);
    let extent = (bounds.max - bounds.min) / scale;
    let world_origin = if max(extent.x, extent.y) > REGIONAL {
        DVec3::ZERO
    } else {
        let (lon, lat) = globe.geographic(Plan::from(anchor));
        ellipsoid.geocentric(lon, lat).round()
    };
    let globe = Globe { plan_origin: anchor, world_origin, ..globe };
    let posts = local(first - anchor, placed.posts.into_heights())?;
    Ok((GlobePosts { posts, globe, ..placed }, space, anchor))
}

/// Refuses a terrain so deep that the ellipsoid's normals meet above it: its order would be another there than in the plan.
pub(in crate::source::load) fn above_the_middle(posts: &GlobePosts) -> Result<()> {
    let ellipsoid = posts.globe.ellipsoid;
    // The least radius of curvature is that of a meridian at the equator, of a long ellipsoid that of the poles.
    let deepest =
        -min(ellipsoid.b() * ellipsoid.b() / ellipsoid.a, ellipsoid.a * ellipsoid.a / ellipsoid.b());
    let heights = posts.posts.heights().iter().chain(posts.poles.iter().flatten());
    let lowest = heights.fold(f64::INFINITY, |lowest, height| min(*height, lowest));
    if lowest > deepest {
        return Ok(());
    }
    Err(Error::new(format!("the terrain reaches {lowest:e} m, deeper than the middle of the globe"))
        .help("check the file's heights and its nodata value, and `terrain.vertical_scale`"))
}

/// Generated posts, which stand in metres around (0, 0), as posts in degrees of WGS 84.
pub(in crate::source::load) fn generated(posts: Posts) -> Result<(Surface, Crs)> {
    let crs = Crs::crs84()?;
    let ellipsoid = PlanSpace::globe(0.0, crs.clone())?.ellipsoid();
    let per_degree = ellipsoid.map_or(1.0, |ellipsoid| ellipsoid.a.to_radians());
    let (first, size) = (posts.first.to_vec() / per_degree, (posts.columns(), posts.rows()));
    let steps = (posts.east() / per_degree, posts.north() / per_degree);
    Ok((Surface::Grid(Posts::new(size, Plan::from(first), steps, posts.into_heights())?), crs))
}

/// The posts in degrees; refuses what is no grid of meridians and parallels.
fn degrees(surface: Surface, unit: f64) -> Result<Posts> {
    let Surface::Grid(posts) = surface else {
        return Err(Error::unsupported(
            "a globe is made of a grid of posts, and this terrain is of scattered points",
        )
        .help("make a grid of them (gdal_grid), or leave out plan = \"globe\""));
    };
    let (east, north) = (posts.east(), posts.north());
    if east.y != 0.0 || north.x != 0.0 {
        return Err(Error::unsupported("the posts' rows and columns are no parallels and meridians")
            .help("warp the file upright: gdalwarp -t_srs EPSG:4326"));
    }
    let first = Plan::from(posts.first.to_vec() * unit);
    let size = (posts.columns(), posts.rows());
    Posts::new(size, first, (east * unit, north * unit), posts.into_heights())
}

/// The posts without a last column that stands where the first one does, and whether they go all around.
fn around(posts: Posts, note: &mut dyn FnMut(String)) -> Result<(Posts, bool)> {
    let (columns, step) = (posts.columns(), posts.east().x);
    let gap = 360.0 - (columns - 1) as f64 * step;
    if gap < -SLACK * step {
        return Err(Error::new(format!(
            "the terrain spans {} degrees of longitude, more than a turn",
            360.0 - gap
        ))
        .help("give it a `window` of at most 360 degrees"));
    }
    if gap > SLACK * step {
        return Ok((posts, gap <= (1.0 + SLACK) * step));
    }
    let differs = |row: &[f64]| row[0].to_bits() != row[columns - 1].to_bits();
    let differing = posts.heights().chunks_exact(columns).filter(|row| differs(row)).count();
    if differing > 0 {
        note(format!(
            "the first and the last column are one meridian, with other heights in {differing} rows: those of the first count"
        ));
    }
    let heights =
        posts.heights().chunks_exact(columns).flat_map(|row| &row[..columns - 1]).copied().collect();
    let posts = Posts::new((columns - 1, posts.rows()), posts.first, (posts.east(), posts.north()), heights)
        .map_err(|error| error.help("a globe needs at least two meridians"))?;
    Ok((posts, true))
}

/// The posts without rows at the poles, and the heights of the poles that the surface reaches.
fn to_the_poles(
    posts: Posts,
    is_closed: bool,
    note: &mut dyn FnMut(String),
) -> Result<(Posts, [Option<f64>; 2])> {
    let (columns, rows, step) = (posts.columns(), posts.rows(), posts.north().y);
    let last = posts.first.y + (rows - 1) as f64 * step;
    let gaps = [90.0 + posts.first.y, 90.0 - last];
    if min(gaps[0], gaps[1]) < -SLACK * step {
        return Err(Error::new(format!(
            "the terrain's rows reach from latitude {} to {last}, beyond a pole",
            posts.first.y
        ))
        .help("longitude comes first, then latitude; give a `window` between -90 and 90"));
    }
    let row = |j: usize| &posts.heights()[j * columns..(j + 1) * columns];
    let mut poles = [None; 2];
    let mut kept = 0..rows;
    for (side, (gap, name)) in gaps.into_iter().zip(["south", "north"]).enumerate() {
        let outermost = row(if side == 0 { 0 } else { rows - 1 });
        let known = || outermost.iter().copied().filter(|height| !height.is_nan());
        let count = known().count();
        let mean = (count > 0).then(|| known().sum::<f64>() / count as f64);
        if gap <= SLACK * step {
            poles[side] = mean;
            let range = known().fold(0.0, max) - known().fold(0.0, min);
            if known().any(|height| Some(height) != mean) && range > 0.0 {
                note(format!("the posts of the {name} pole are one place: it has their mean height"));
            }
            if side == 0 { kept.start += 1 } else { kept.end -= 1 }
        } else if is_closed && gap <= (CAP + SLACK) * step {
            poles[side] = mean;
            note(format!(
                "the rows end half a cell from the {name} pole: it has the mean height of the last row"
            ));
        }
    }
    if kept.len() < 2 {
        return Err(Error::new("a globe needs at least two rows of posts beside those at the poles")
            .help("give a finer grid"));
    }
    let heights = posts.heights()[kept.start * columns..kept.end * columns].to_vec();
    let first = posts.plan(0, kept.start);
    let posts = Posts::new((columns, kept.len()), first, (posts.east(), posts.north()), heights)?;
    Ok((posts, poles))
}
