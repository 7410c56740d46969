//! Clipmap texture: J. Taibo, A. Jaspe, A. Seoane, M. Agus, L. Hernández (2014), "Practical line rasterization for multi-resolution
//! textures", Smart Tools and Apps for Graphics.
//!
//! Input: a [`Stage`]. Output: a picture whose ground carries a texture of the vectors:
//! 1. the items are kept in memory as one of the paper's solutions needs them (`geometry`, 4.1 to 4.4), lines tessellated into strips
//!    ([`tessellation`], 4.2);
//! 2. the texture is virtual: levels cut into tiles ([`texture`], 2); a frame finds which tiles its pixels touch (`sampling`, `pixel`, `frame`);
//! 3. those are made, each once ([`tile`]): layers in order, thin lines as line primitives, the others as polygons (Algorithm 2),
//!    rasterized in one of several ways ([`raster`]), and kept (`cache`);
//! 4. each pixel samples the texture at its centre and composes it over the ground.
//!
//! Where the paper is silent:
//! - The texture covers the square around the terrain from its north-western corner. Levels go down to one texel.
//! - Texels hold premultiplied paint; composing them over the ground is what composing each item would be (with `additive` they saturate
//!   before the ground is known).
//! - An item is blended as a whole: where it covers a texel several times, as often as it does (`overlaps = "blend"`) or once.
//! - What the paper's scene graph holds for polygons is not said: fills are rings, scan-converted exactly as they are (triangles of a
//!   constrained Delaunay triangulation would round where rings cross). Outlines that are inset or offset are cut to their polygon.
//! - A layer's width in pixels is one in metres at the distance of what the middle of the picture shows (3: "as a function of the
//!   distance between camera and terrain"), or so many texels in every level (`pixel_width = "texels"`, Fig. 1).
//! - Strips that are stored (solutions 2, 3a, 4b) have round joins and caps of sides that stay within 1/2048 of half the width of the circle,
//!   whatever the level; on the fly (4a), as finely as the level needs.
//! - tiny-skia fills an item as one path: with it polygons are blended once, whatever `overlaps` says.
//! - Line primitives have neither joins nor caps, nor have Algorithm 1's strips caps; `joints = "style"` has both.
//!
//! Refuses: nothing but more vertices than can be numbered.

mod cache;
mod frame;
mod geometry;
mod pixel;
pub mod raster;
#[cfg(test)]
mod rational;
mod sampling;
mod sequences;
mod settings;
mod simple;
mod step;
mod sweep;
mod table;
pub mod tessellation;
pub mod texture;
pub mod tile;

pub use cache::CacheCounts;
pub use sequences::{Sequences, StripOf};
pub use settings::{
    Joints, LineFilter, LinePrimitives, OffsetForm, Overlaps, PixelWidth, PolygonRaster, Settings, Solution,
    TILE_TEXELS, TexelFormat, TextureFilter, WideLines,
};
pub use step::Step;

use super::{Declaration, Explanation, Frame, FrameOptions, Parameters, Prepared};
use crate::buffer::{Look, PlaneKind};
use crate::error::{Error, Result};
use crate::parallel;
use crate::parameter::Named;
use crate::scene::{Line, StrokeForm, TechniqueSettings, Width};
use crate::space::{Plan, ViewFrame};
use crate::stage::Stage;
use cache::TileCache;
use geometry::Geometry;
use std::sync::{Mutex, PoisonError};
use texture::{ClipRegion, TileKey, VirtualTexture};
use tile::{TileCounts, TileMaker, Workbench};

/// The technique, said once.
pub const DECLARATION: Declaration = Declaration {
    parameters: Parameters::of::<Settings>(),
    further: &[],
    paper: "Taibo et al. 2014, \"Practical line rasterization for multi-resolution textures\".",
    title: "Clipmap texture (Taibo)",
    contradiction: settings::contradiction,
    planes: &[
        PlaneKind::new("vertices", Look::Table).in_plan(),
        PlaneKind::new("strips", Look::Table),
        PlaneKind::TRIANGLE,
        PlaneKind::DEPTH,
        PlaneKind::PLAN,
        PlaneKind::new("level", Look::Level),
        PlaneKind::new("tile", Look::Number),
        PlaneKind::new("texels", Look::Count),
        PlaneKind::new("tile-keys", Look::Table),
        PlaneKind::new("tiles", Look::CodeValues),
        PlaneKind::COLOR,
    ],
    client: include_str!("client.md"),
    stroke_form,
    sweep: sweep::SWEEP,
    applies,
    prepare: |stage, _| Ok(Box::new(Prepare::new(stage)?)),
};

/// Strips as `joints` says, which have no caps; widths in pixels are round where the style counts.
fn stroke_form(said: &TechniqueSettings, line: &Line) -> StrokeForm {
    let settings: Settings = said.get();
    match (settings.solution, settings.joints, line.width) {
        (Solution::Lines, ..) => StrokeForm { join: "none", miter_limit: None, cap: "butt" },
        (_, Joints::Style, Width::Pixels(_)) => StrokeForm::ROUND,
        (_, Joints::Style, Width::Metres(_)) => StrokeForm::of_style(line),
        (_, joints, _) => StrokeForm { join: joints.word(), miter_limit: None, cap: "butt" },
    }
}

/// The technique with its lines and areas in memory.
#[derive(Debug)]
pub struct Prepare<'s> {
    stage: &'s Stage,
    settings: Settings,
    texture: VirtualTexture,
    geometry: Geometry<'s>,
    /// Tiles that were made for earlier frames.
    cache: Mutex<TileCache>,
}

impl<'s> Prepare<'s> {
    /// Keeps lines and areas as the solution needs them.
    ///
    /// # Errors
    /// When there are more vertices than can be numbered.
    pub fn new(stage: &'s Stage) -> Result<Self> {
        let scene = &stage.scene;
        let settings: Settings = scene.technique.get();
        let texture = VirtualTexture::over(&stage.mesh.plan_bounds(), settings.virtual_size);
        let geometry = Geometry::new(&stage.draw_list, &settings, scene.compositing)?;
        Ok(Self { stage, settings, texture, geometry, cache: Mutex::default() })
    }

    /// Draws a frame of a view, with the tiles that earlier frames have left; the picture is the same without them. Says
    /// what the cache did.
    pub fn frame_of(&self, view: &ViewFrame, options: &FrameOptions) -> Result<(Frame, CacheCounts)> {
        frame::draw(self, view, options)
    }

    /// The steps of a pixel (column, row) of a view's picture, and its code values; see [`super::explain`].
    pub fn steps_of(&self, view: &ViewFrame, pixel: [usize; 2]) -> (Vec<Step>, [u8; 4]) {
        frame::explain(self, view, &[pixel]).pop().unwrap_or_default()
    }

    /// The virtual texture.
    pub fn texture(&self) -> &VirtualTexture {
        &self.texture
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
    fn budget(&self) -> usize {
        (self.settings.cache_mib * 1_048_576.0) as usize
    }

    /// The cache, which another frame that is drawn meanwhile does without.
    fn take_cache(&self) -> TileCache {
        std::mem::take(&mut *self.cache.lock().unwrap_or_else(PoisonError::into_inner))
    }

    fn return_cache(&self, cache: TileCache) {
        *self.cache.lock().unwrap_or_else(PoisonError::into_inner) = cache;
    }
}

/// Whether the technique can draw the scene.
///
/// # Errors
/// The reason why it cannot.
pub fn applies(stage: &Stage) -> Result<()> {
    let Some(layer) = stage.scene.layers.iter().find(|layer| layer.has_width_in_pixels()) else {
        return Ok(());
    };
    if stage.mesh.globe().is_none() {
        return Ok(());
    }
    Err(Error::unsupported(format!(
        "clipmap gives a line a width in world space, the same all over its texture (Taibo et al. 2014, 3), and on a globe a texel is another length at each latitude and in each \
         direction: layer `{}` has width_px",
        layer.name
    ))
    .help("give the layer width_m, or leave the technique out"))
}

impl Prepared for Prepare<'_> {
    fn frame(&self, view: &ViewFrame, options: &FrameOptions) -> Result<Frame> {
        Ok(self.frame_of(view, options)?.0)
    }

    fn steps(&self, view: &ViewFrame, pixel: [usize; 2]) -> Result<Explanation> {
        let (steps, code) = self.steps_of(view, pixel);
        Ok(Explanation::new(steps, code))
    }

    fn steps_of_all(&self, view: &ViewFrame, pixels: &[[usize; 2]]) -> Result<Vec<Explanation>> {
        Ok(Explanation::all(frame::explain(self, view, pixels)))
    }

    fn structure_bytes(&self) -> usize {
        self.geometry.bytes() + self.geometry.index_bytes()
    }
}
