//! The triangle-clipping DAGs of quads, each made when a view first uses the quad (3.2, 3.3: they are paged in with the quad's vertices).
//!
//! Input: the scene's lines in grid coordinates. Output: a [`PolylineLods`] for each quad that is asked for. Refuses: nothing.

use super::dag::{Arrays, Chains, Layers, PolylineLods, SubPolylineLods};
use super::grid_map::GridMap;
use super::mesh::MeshInUse;
use crate::draw_list::{DrawList, Role};
use crate::error::Result;
use crate::parallel;
use crate::terrain::lod::Quad;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Lines and what was made of them so far.
#[derive(Debug)]
pub(super) struct Store {
    chains: Chains,
    quads: Mutex<BTreeMap<Quad, Arc<PolylineLods>>>,
    /// Of quads that were drawn by another quad's data: which one that was, and where lines enter them. No longer valid where they borrow from another.
    entrances: Mutex<BTreeMap<Quad, (Quad, Arc<SubPolylineLods>)>>,
}

/// What is there is only put in whole: after a panic elsewhere it is as good as before.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Store {
    /// The lines of a draw list: an item's strokes, what a stroke that is an area is along, or the border of a fill; of the items that `is_line` names.
    pub(super) fn new(list: &DrawList, map: &GridMap, is_line: impl Fn(u32) -> bool) -> Self {
        let chains = list.numbered().filter(|(item, _)| is_line(*item)).flat_map(|(item, of)| {
            let style = list.style_of(item);
            let chains = match style.role {
                Role::Fill if style.swath.is_some() => list.centre_lines(of),
                Role::Fill | Role::Outside => list.border(of),
                Role::Outline | Role::Line | Role::Point => list.strokes(of),
            };
            chains.iter().map(move |chain| (item, map.path(list.path_of(chain))))
        });
        Self { chains: Chains::new(chains), quads: Mutex::default(), entrances: Mutex::default() }
    }

    /// The item that a line is drawn for.
    pub(super) fn item_of(&self, chain: u32) -> u32 {
        self.chains.all()[chain as usize].id
    }

    /// What crosses some quads, in their order; what is not there is made, in parallel.
    pub(super) fn of(&self, mesh: &MeshInUse, quads: &[Quad]) -> Vec<Arc<PolylineLods>> {
        let known = |quad: &Quad| locked(&self.quads).get(quad).cloned();
        let missing: Vec<Quad> = quads.iter().filter(|quad| known(quad).is_none()).copied().collect();
        let made = parallel::map(&missing, |quad| Arc::new(self.made(mesh, *quad)));
        locked(&self.quads).extend(missing.into_iter().zip(made));
        let all = locked(&self.quads);
        quads.iter().filter_map(|quad| all.get(quad).cloned()).collect()
    }

    fn made(&self, mesh: &MeshInUse, quad: Quad) -> PolylineLods {
        let splits = |cell| mesh.splits_sw_ne(cell);
        let layers = if mesh.has_levels() { Layers::All } else { Layers::Smallest(&splits) };
        PolylineLods::new(quad.into(), layers, &self.chains)
    }

    /// What crosses a quad, with all its layers; made anew and not kept.
    pub(super) fn with_all_layers(&self, quad: Quad) -> PolylineLods {
        PolylineLods::new(quad.into(), Layers::All, &self.chains)
    }

    /// Where lines enter a quad that is drawn by another one's data; `None`: it is not known, or was drawn by another's.
    pub(super) fn entrances(&self, quad: Quad, data: Quad) -> Option<Arc<SubPolylineLods>> {
        let all = locked(&self.entrances);
        all.get(&quad).filter(|(of, _)| *of == data).map(|(_, entrances)| Arc::clone(entrances))
    }

    /// Keeps where lines enter quads that are drawn by the data of one.
    pub(super) fn keep_entrances(&self, data: Quad, of: impl Iterator<Item = (Quad, Arc<SubPolylineLods>)>) {
        locked(&self.entrances).extend(of.map(|(quad, entrances)| (quad, (data, entrances))));
    }

    /// The structures of some quads as arrays.
    ///
    /// # Errors
    /// When an array has more rows than can be numbered.
    pub(super) fn arrays(&self, mesh: &MeshInUse, quads: &[Quad]) -> Result<Arrays> {
        let lods = self.of(mesh, quads);
        Arrays::new(lods.iter().map(|lods| &**lods), &self.chains)
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        let quads: usize = locked(&self.quads).values().map(|lods| lods.bytes()).sum();
        let entrances: usize = locked(&self.entrances).values().map(|(_, entrances)| entrances.bytes()).sum();
        self.chains.bytes() + quads + entrances
    }
}
