//! Terrain by formula.

use super::noise::mountains;
use crate::error::Result;
use crate::math::{max, sin, tan};
use crate::scene::Posts;
use crate::scene_file::{TerrainGenerator, TerrainKind};
use crate::space::Plan;
use glam::DVec2;
use std::f64::consts::PI;

/// The terrain that `generator` describes, its middle at plan (0, 0).
///
/// # Errors
/// When it has fewer than 2 x 2 posts, or numbers so large that a position or height is not finite.
pub fn terrain(generator: &TerrainGenerator) -> Result<Posts> {
    let (columns, rows) = generator.posts;
    let half = |posts: usize| 0.5 * (posts.saturating_sub(1) as f64) * generator.cell_m;
    let first = Plan::new(-half(columns), -half(rows));
    let row = |j: usize| -> Vec<f64> {
        let place = |i: usize| first + DVec2::new(i as f64, j as f64) * generator.cell_m;
        (0..columns).map(|i| height(generator, place(i).to_vec(), first.y)).collect()
    };
    let heights = crate::parallel::map_indices(rows, row).concat();
    let steps = (DVec2::new(generator.cell_m, 0.0), DVec2::new(0.0, generator.cell_m));
    Posts::new(generator.posts, first, steps, heights)
}

/// The height at a place of the plan; the southern edge lies at y = `south`.
fn height(generator: &TerrainGenerator, p: DVec2, south: f64) -> f64 {
    let high = generator.height_m;
    match generator.kind {
        TerrainKind::Plane => high,
        TerrainKind::Ramp { slope_deg } => high + (p.y - south) * tan(slope_deg * (PI / 180.0)),
        TerrainKind::Sine { wavelength_m } => {
            let wave = |x: f64| sin(2.0 * PI * x / wavelength_m);
            high * (0.5 + 0.25 * (wave(p.x) + wave(p.y)))
        }
        TerrainKind::Cone { radius_m } => high * max(1.0 - (p.x * p.x + p.y * p.y).sqrt() / radius_m, 0.0),
        TerrainKind::Tent { radius_m } => high * max(1.0 - p.y.abs() / radius_m, 0.0),
        TerrainKind::Fbm { seed, wavelength_m, octaves } => high * mountains(seed, octaves, p / wavelength_m),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn posts(kind: TerrainKind) -> Posts {
        terrain(&TerrainGenerator {
            kind,
            posts: (65, 33),
            cell_m: 30.0,
            is_in_degrees: false,
            height_m: 1000.0,
        })
        .unwrap()
    }

    /// Height at column i, row j.
    fn z(posts: &Posts, i: usize, j: usize) -> f64 {
        posts.world(i, j).z
    }

    #[test]
    fn the_middle_of_a_terrain_is_at_plan_zero() {
        let posts = posts(TerrainKind::Plane);
        assert_eq!(posts.plan(32, 16), Plan::new(0.0, 0.0));
        assert_eq!(posts.first, Plan::new(-960.0, -480.0));
        assert!(posts.heights().iter().all(|z| *z == 1000.0));
    }

    #[test]
    fn a_ramp_rises_to_the_north_at_its_slope() {
        let posts = posts(TerrainKind::Ramp { slope_deg: 45.0 });
        assert_eq!(z(&posts, 0, 0), 1000.0);
        assert!((z(&posts, 5, 32) - 1960.0).abs() < 1e-9);
    }

    #[test]
    fn cone_and_tent_have_their_top_in_the_middle() {
        let (cone, tent) =
            (posts(TerrainKind::Cone { radius_m: 300.0 }), posts(TerrainKind::Tent { radius_m: 300.0 }));
        assert_eq!((z(&cone, 32, 16), z(&cone, 32, 26), z(&cone, 0, 16)), (1000.0, 0.0, 0.0));
        assert_eq!((z(&tent, 32, 16), z(&tent, 32, 26), z(&tent, 0, 16)), (1000.0, 0.0, 1000.0));
        assert_eq!(z(&cone, 37, 16), 500.0);
    }

    #[test]
    fn mountains_fill_their_heights_and_do_not_leave_them() {
        let kind = TerrainKind::Fbm { seed: 7, wavelength_m: 1500.0, octaves: 9 };
        let large = TerrainGenerator {
            kind,
            posts: (257, 257),
            cell_m: 30.0,
            is_in_degrees: false,
            height_m: 1000.0,
        };
        let posts = terrain(&large).unwrap();
        let low = posts.heights().iter().copied().fold(f64::INFINITY, crate::math::min);
        let high = posts.heights().iter().copied().fold(f64::NEG_INFINITY, crate::math::max);
        assert!((0.0..100.0).contains(&low) && (800.0..=1000.0).contains(&high), "{low}..{high}");
    }

    #[test]
    fn generated_heights_keep_their_bits() {
        let hash = |kind| {
            let bytes: Vec<u8> =
                posts(kind).heights().iter().flat_map(|z| z.to_bits().to_le_bytes()).collect();
            blake3::hash(&bytes).to_hex()[..16].to_string()
        };
        assert_eq!(
            [
                hash(TerrainKind::Sine { wavelength_m: 700.0 }),
                hash(TerrainKind::Fbm { seed: 7, wavelength_m: 900.0, octaves: 9 }),
            ],
            ["7b894d2c1016a549", "15e0aae428592da9"]
        );
    }

    #[test]
    fn numbers_that_overflow_are_refused() {
        let kind = TerrainKind::Ramp { slope_deg: 80.0 };
        assert!(
            terrain(&TerrainGenerator {
                kind,
                posts: (9, 9),
                cell_m: 1e308,
                is_in_degrees: false,
                height_m: 0.0
            })
            .is_err()
        );
    }
}
