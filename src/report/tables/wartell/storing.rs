//! What a scene's lines take in the paper's forms of storage, and how long it takes to make their structures (3.2, 3.3).
//!
//! Input: a stage. Output: [`StorageTable`]. Refuses: what the technique refuses.

use super::rows::{Form, StorageTable, Stored};
use crate::error::Result;
use crate::measure::{Times, Watch, timed};
use crate::parallel;
use crate::stage::Stage;
use crate::technique::geometry_overlay::{PointForm, Prepare, Storage, StoredLayers};
use crate::terrain::lod::{CELLS, Quad};

/// The forms in the paper's order: as it was measured, each reduction, both.
const FORMS: [(PointForm, StoredLayers); 4] = [
    (PointForm::Cartesian, StoredLayers::All),
    (PointForm::Projectors, StoredLayers::All),
    (PointForm::Cartesian, StoredLayers::TwoFinest),
    (PointForm::Projectors, StoredLayers::TwoFinest),
];

/// Measures the quads over so many columns and rows of posts, each thing `repeat` times (at least once).
pub(super) fn storage(
    stage: &Stage,
    posts: [usize; 2],
    repeat: u32,
    watch: &dyn Watch,
) -> Result<StorageTable> {
    watch.start("storage");
    let index = || timed(watch, || Prepare::new(stage));
    let (mut prepared, first) = index()?;
    let mut times = vec![first];
    for _ in 1..repeat {
        let (made, ms) = index()?;
        times.push(ms);
        prepared = made;
    }
    let levels = levels(posts);
    let stored = |quads: &[Quad]| stored(&prepared, quads, levels, repeat, watch);
    Ok(StorageTable {
        covering_triangles: 2 * CELLS.ilog2() + 1,
        index_ms: Times::of(times),
        root: stored(&quads(posts, levels..levels + 1))?,
        all: stored(&quads(posts, 0..levels + 1))?,
    })
}

/// The level of the quad that holds all posts.
fn levels(posts: [usize; 2]) -> u32 {
    let side = posts.iter().max().map_or(1, |most| *most as u32 - 1).next_power_of_two();
    (side / CELLS).max(1).ilog2()
}

/// The quads of some levels that reach into the posts.
fn quads(posts: [usize; 2], levels: std::ops::Range<u32>) -> Vec<Quad> {
    let of_level = |level: u32| {
        let [columns, rows] = posts.map(|count| (count as u32 - 1).div_ceil(CELLS << level));
        (0..rows).flat_map(move |y| (0..columns).map(move |x| Quad { level, x, y }))
    };
    levels.flat_map(of_level).collect()
}

fn stored(prepared: &Prepare, quads: &[Quad], root: u32, repeat: u32, watch: &dyn Watch) -> Result<Stored> {
    let (mut times, mut all) = (Vec::new(), Vec::new());
    for _ in 0..repeat.max(1) {
        let (made, ms) =
            timed(watch, || Ok(parallel::map(quads, |quad| prepared.stored(*quad, quad.level == root))))?;
        times.push(ms);
        all = made;
    }
    let (mut storage, mut held_bytes, mut crossed) = (Storage::default(), 0, 0);
    for of in all.iter().filter(|of| of.storage.all.clippings > 0) {
        storage += of.storage;
        held_bytes += of.held_bytes as u64;
        crossed += 1;
    }
    Ok(Stored {
        quads: crossed,
        build_ms: Times::of(times),
        points: storage.points,
        clipping_points: storage.all.points,
        clippings: storage.all.clippings,
        forms: FORMS.map(|form| told(&storage, form)),
        held_bytes,
    })
}

/// A form with its factor.
fn told(storage: &Storage, (points, layers): (PointForm, StoredLayers)) -> Form {
    let bytes = storage.bytes(points, layers);
    let first = storage.bytes(FORMS[0].0, FORMS[0].1);
    Form {
        points: match points {
            PointForm::Cartesian => "cartesian",
            PointForm::Projectors => "projectors",
        },
        layers: match layers {
            StoredLayers::All => "all",
            StoredLayers::TwoFinest => "two-finest",
        },
        coordinate_bytes: bytes.coordinates,
        topology_bytes: bytes.topology,
        factor: first.total() as f64 / bytes.total().max(1) as f64,
    }
}
