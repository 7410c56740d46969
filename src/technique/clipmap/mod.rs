//! Clipmap texture: J. Taibo, A. Jaspe, A. Seoane, M. Agus, L. Hernández (2014), "Practical line rasterization for multi-resolution
//! textures", Smart Tools and Apps for Graphics.
//!
//! Input: a [`Stage`]. Output: a picture whose ground carries a texture of the vectors:
//! 1. the layers are kept in memory as one of the paper's solutions needs them (`geometry`, 4.1 to 4.4), lines tessellated into strips
//!    ([`tessellation`], 4.2);
//! 2. the texture is virtual: levels cut into tiles ([`texture`], 2); a frame finds which tiles its pixels touch (`sampling`, `frame`);
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
//! Refuses: nothing but more vertices or features than can be numbered.

mod cache;
mod frame;
mod geometry;
mod prepare;
mod quadtree;
pub mod raster;
#[cfg(test)]
mod rational;
mod sampling;
mod sequences;
mod simple;
pub mod tessellation;
pub mod texture;
pub mod tile;

pub use cache::CacheCounts;
pub use prepare::Prepare;
pub use sequences::{Sequences, StripOf};

use super::contract::{Frame, FrameOptions, Prepared};
use crate::error::Result;
use crate::scene::file::Named;
use crate::space::ViewFrame;
use crate::stage::Stage;

/// Whether the technique can draw the scene: it can.
///
/// # Errors
/// None yet; other techniques have reasons.
pub fn applies(_stage: &Stage) -> Result<()> {
    Ok(())
}

impl Prepare<'_> {
    /// Draws a frame of a view, with the tiles that earlier frames have left; the picture is the same without them. Says
    /// what the cache did.
    pub fn frame_of(&self, view: &ViewFrame, options: &FrameOptions) -> Result<(Frame, CacheCounts)> {
        frame::draw(self, view, options)
    }
}

impl Prepared for Prepare<'_> {
    fn frame(&self, view: &ViewFrame, options: &FrameOptions) -> Result<Frame> {
        Ok(self.frame_of(view, options)?.0)
    }

    fn structure_bytes(&self) -> usize {
        self.geometry.bytes() + self.geometry.index_bytes()
    }

    fn parameters(&self) -> Vec<(&'static str, String)> {
        let s = &self.settings;
        vec![
            ("virtual_size", s.virtual_size.to_string()),
            ("clip_size", s.clip_size.to_string()),
            ("cache_mib", s.cache_mib.to_string()),
            ("texel", s.texel.word().into()),
            ("solution", s.solution.word().into()),
            ("joints", s.joints.word().into()),
            ("angle_deg", s.angle_deg.to_string()),
            ("threshold_texels", s.threshold_texels.to_string()),
            ("lines", s.lines.word().into()),
            ("line_filter", s.line_filter.word().into()),
            ("wide_lines", s.wide_lines.word().into()),
            ("polygons", s.polygons.word().into()),
            ("overlaps", s.overlaps.word().into()),
            ("offsets", s.offsets.word().into()),
            ("pixel_width", s.pixel_width.word().into()),
            ("filter", s.filter.word().into()),
            ("anisotropy", s.anisotropy.to_string()),
            ("level_bias", s.level_bias.to_string()),
        ]
    }

    fn buffer_names(&self) -> &'static [&'static str] {
        &[
            "vertices",
            "strips",
            "triangle",
            "depth",
            "plan",
            "level",
            "tile",
            "texels",
            "tile-keys",
            "tiles",
            "color",
        ]
    }
}
