//! What is kept from frame to frame: the layers in memory, the virtual texture, and tiles.

use super::cache::TileCache;
use super::geometry::Geometry;
use super::texture::{ClipRegion, TileKey, VirtualTexture};
use super::tile::{TileCounts, TileMaker, Workbench};
use crate::error::Result;
use crate::parallel;
use crate::scene::Clipmap;
use crate::space::Plan;
use crate::stage::Stage;
use std::sync::{Mutex, PoisonError};

/// The technique with its layers in memory.
#[derive(Debug)]
pub struct Prepare<'s> {
    pub(super) stage: &'s Stage,
    pub(super) settings: Clipmap,
    pub(super) texture: VirtualTexture,
    pub(super) geometry: Geometry,
    /// Tiles that were made for earlier frames.
    cache: Mutex<TileCache>,
}

impl<'s> Prepare<'s> {
    /// Keeps the layers as the solution needs them.
    ///
    /// # Errors
    /// When there are more vertices or features than can be numbered.
    pub fn new(stage: &'s Stage) -> Result<Self> {
        let scene = &stage.scene;
        let settings = scene.technique.clipmap;
        let texture = VirtualTexture::over(&stage.mesh.plan_bounds(), settings.virtual_size);
        let geometry = Geometry::new(&scene.layers, &settings, scene.compositing, &texture.bounds())?;
        Ok(Self { stage, settings, texture, geometry, cache: Mutex::default() })
    }

    /// What makes tiles, for a size of a pixel in metres.
    pub fn maker(&self, pixel_m: f64) -> TileMaker<'_> {
        let (settings, device) = (self.settings, self.stage.scene.device);
        TileMaker { geometry: &self.geometry, texture: self.texture, settings, device, pixel_m }
    }

    /// Makes all tiles that are at hand around a point of the plan, in all levels, as if none had been made: what 5.3 calls a complete
    /// reconstruction of the texture cache. Says how many there are, and what was drawn.
    pub fn reconstruct(&self, center: Plan) -> (usize, TileCounts) {
        let region = ClipRegion::new(&self.texture, center, self.settings.clip_size);
        let levels = (0..self.texture.levels()).map(|level| (level, region.window(&self.texture, level)));
        let keys: Vec<TileKey> = levels.flat_map(|(level, window)| window.keys(level)).collect();
        let maker = self.maker(1.0);
        let make = |bench: &mut Option<Workbench>, key: &TileKey| maker.make_on(*key, bench).counts;
        let counts = parallel::map_with(&keys, || None, make);
        (keys.len(), counts.into_iter().fold(TileCounts::default(), TileCounts::plus))
    }

    /// Changes all widths in metres by a factor (5.1): nothing but a number where lines are drawn or tessellated on the fly; else pairs of
    /// vertices are scaled (methods 1, 2, 3a) or, where the lines are kept beside them (solution 3a), made anew (method 3b). False
    /// where that cannot be done: then the technique has to be prepared anew.
    pub fn change_width(&mut self, factor: f64) -> bool {
        self.cache = Mutex::default();
        self.geometry.change_width(factor)
    }

    /// Bytes that the solution keeps of lines and outlines, and bytes of the index that finds them.
    pub fn memory(&self) -> (usize, usize) {
        (self.geometry.stroke_bytes(), self.geometry.index_bytes())
    }

    /// The bytes that the cache may hold.
    pub(super) fn budget(&self) -> usize {
        (self.settings.cache_mib * 1_048_576.0) as usize
    }

    /// The cache, which another frame that is drawn meanwhile does without.
    pub(super) fn take_cache(&self) -> TileCache {
        std::mem::take(&mut *self.cache.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Keeps a frame's tiles for later frames.
    pub(super) fn return_cache(&self, cache: TileCache) {
        *self.cache.lock().unwrap_or_else(PoisonError::into_inner) = cache;
    }
}
