//! Terrain and vectors made from numbers, the same bits on every machine: only + - * / sqrt and [`crate::math`].
//!
//! Input: what a scene file's `generate` says. Output: [`Posts`](crate::scene::Posts) around plan (0, 0), and
//! features of a rectangle of the plan. Refuses nothing that a scene file can say, but numbers whose products
//! overflow.

mod apportion;
mod case_study;
mod jagged;
mod mosaic;
mod noise;
mod parcels;
mod paths;
mod random;
mod roads;
mod terrain;

pub use terrain::terrain;

use crate::scene::{Attribute, Column, Feature, Shape};
use crate::scene_file::{VectorGenerator, VectorKind};
use crate::space::{Plan, PlanBox};

/// The features that `generator` describes, in plan coordinates; `terrain` is the rectangle of the plan that they fill
/// where the generator names none.
///
/// ```
/// use drapery::scene_file::{VectorGenerator, VectorKind};
/// use drapery::space::{Plan, PlanBox};
/// let generator = VectorGenerator { kind: VectorKind::Roads { segment_m: None }, seed: 1, count: 500, window: None };
/// let roads = drapery::source::generate::features(&generator, PlanBox::around([Plan::new(0.0, 0.0), Plan::new(9e3, 9e3)]));
/// assert!(roads.len() > 5);
/// ```
pub fn features(generator: &VectorGenerator, terrain: PlanBox) -> Vec<Feature> {
    let window = window(generator, terrain);
    let shapes: Vec<Shape> = match generator.kind {
        VectorKind::Roads { segment_m } => roads::roads(generator, segment_m, window),
        VectorKind::Paths { segment_m } => paths::paths(generator, segment_m, window),
        VectorKind::Parcels => parcels::parcels(generator, window),
        VectorKind::Mosaic { class, holes } => mosaic::mosaic(generator, class, holes, window),
        VectorKind::CaseStudy { study, data, scale } => {
            case_study::shapes(study, data, scale, generator.seed, window)
        }
    };
    shapes.into_iter().enumerate().map(|(index, shape)| Feature { index, style: 0, shape }).collect()
}

/// The columns of attributes that the generator's `features` have: the `class` of a mosaic's polygons, the `class` and `area_m2` of a case study's;
/// `features` are those that [`features()`] made of the same arguments.
pub fn columns(generator: &VectorGenerator, terrain: PlanBox, features: &[Feature]) -> Vec<Column> {
    match generator.kind {
        VectorKind::Mosaic { class, .. } => {
            let classes = mosaic::classes(generator, class, window(generator, terrain));
            vec![Column {
                name: "class".into(),
                values: classes.into_iter().map(Attribute::Integer).collect(),
            }]
        }
        VectorKind::CaseStudy { data, .. } => case_study::columns(data, generator.seed, features),
        VectorKind::Roads { .. } | VectorKind::Paths { .. } | VectorKind::Parcels => Vec::new(),
    }
}

/// The rectangle to fill.
fn window(generator: &VectorGenerator, terrain: PlanBox) -> PlanBox {
    let rectangle = |[x0, y0, x1, y1]: [f64; 4]| PlanBox { min: Plan::new(x0, y0), max: Plan::new(x1, y1) };
    generator.window.map_or(terrain, rectangle)
}

#[cfg(test)]
mod tests {
    use super::*;

    pub(super) fn window() -> PlanBox {
        PlanBox::around([Plan::new(-3000.0, -1000.0), Plan::new(5000.0, 4000.0)])
    }

    pub(super) fn inside(p: Plan) -> bool {
        PlanBox::around([p]).meets(&window())
    }

    /// A hash of the bits of all coordinates.
    pub(super) fn bits(lines: &[Vec<Plan>]) -> String {
        let numbers = lines.iter().flatten().flat_map(|p| [p.x, p.y]);
        let bytes: Vec<u8> = numbers.flat_map(|x| x.to_bits().to_le_bytes()).collect();
        blake3::hash(&bytes).to_hex()[..16].to_string()
    }
}
