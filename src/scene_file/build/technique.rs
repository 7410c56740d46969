//! The parameters of the techniques.

use crate::error::Result;
use crate::scene::{Clipmap, InverseProjection, StencilVolume, TechniqueSettings};
use crate::scene_file::section::{Section, Taken};

pub(super) fn technique(section: &mut Section<'_>) -> Result<TechniqueSettings> {
    let node = section.take_or_empty("clipmap");
    let clipmap = Section::read(section.origin(), node, clipmap)?;
    let node = section.take_or_empty("inverse-projection");
    let inverse_projection = Section::read(section.origin(), node, inverse_projection)?;
    let node = section.take_or_empty("stencil-volume");
    let stencil_volume = Section::read(section.origin(), node, stencil_volume)?;
    Ok(TechniqueSettings { clipmap, inverse_projection, stencil_volume })
}

fn stencil_volume(section: &mut Section<'_>) -> Result<StencilVolume> {
    let default = StencilVolume::default();
    Ok(StencilVolume {
        method: section.name("method")?.unwrap_or(default.method),
        overflow: section.name("overflow")?.unwrap_or(default.overflow),
        far: section.name("far")?.unwrap_or(default.far),
        caps: section.name("caps")?.unwrap_or(default.caps),
        joins: section.name("joins")?.unwrap_or(default.joins),
        grouping: section.name("grouping")?.unwrap_or(default.grouping),
        samples: section.integer("samples")?.unwrap_or(default.samples),
        object: section.integer("object")?,
    })
}

fn inverse_projection(section: &mut Section<'_>) -> Result<InverseProjection> {
    let default = InverseProjection::default();
    Ok(InverseProjection {
        samples: section.integer("samples")?.unwrap_or(default.samples),
        corners: section.name("corners")?.unwrap_or(default.corners),
        point_in_polygon: section.name("point_in_polygon")?.unwrap_or(default.point_in_polygon),
        silhouette: section.name("silhouette")?.unwrap_or(default.silhouette),
    })
}

fn clipmap(section: &mut Section<'_>) -> Result<Clipmap> {
    let default = Clipmap::default();
    let cache = section.number_at("cache_mib")?;
    let settings = Clipmap {
        virtual_size: section.integer("virtual_size")?.unwrap_or(default.virtual_size),
        clip_size: section.integer("clip_size")?.unwrap_or(default.clip_size),
        center: section.numbers("center")?,
        cache_mib: cache.as_ref().map_or(default.cache_mib, |taken| taken.value),
        texel: section.name("texel")?.unwrap_or(default.texel),
        solution: section.name("solution")?.unwrap_or(default.solution),
        joints: section.name("joints")?.unwrap_or(default.joints),
        angle_deg: section.number("angle_deg")?.unwrap_or(default.angle_deg),
        threshold_texels: section.number("threshold_texels")?.unwrap_or(default.threshold_texels),
        lines: section.name("lines")?.unwrap_or(default.lines),
        line_filter: section.name("line_filter")?.unwrap_or(default.line_filter),
        wide_lines: section.name("wide_lines")?.unwrap_or(default.wide_lines),
        polygons: section.name("polygons")?.unwrap_or(default.polygons),
        overlaps: section.name("overlaps")?.unwrap_or(default.overlaps),
        offsets: section.name("offsets")?.unwrap_or(default.offsets),
        pixel_width: section.name("pixel_width")?.unwrap_or(default.pixel_width),
        filter: section.name("filter")?.unwrap_or(default.filter),
        anisotropy: section.integer("anisotropy")?.unwrap_or(default.anisotropy),
        level_bias: section.number("level_bias")?.unwrap_or(default.level_bias),
    };
    let tile_mib = settings.tile_bytes() as f64 / MIB;
    match cache {
        Some(Taken { value, place }) if value < tile_mib => {
            let what = format!("a `technique.clipmap.cache_mib` of {value} holds no tile");
            Err(section
                .error_at(&place, what)
                .help(format!("one tile takes {tile_mib} MiB; the default is 1024")))
        }
        _ => Ok(settings),
    }
}

/// Bytes of a MiB.
const MIB: f64 = 1_048_576.0;
