//! The terrain's table.

use super::{data_file, rectangle};
use crate::error::Result;
use crate::parameter::Named;
use crate::scene::{Color, Detail, Diagonal, LevelOfDetail, Light};
use crate::scene_file::names::{ShadeName, TerrainName};
use crate::scene_file::section::{Section, Taken};
use crate::scene_file::spec::{
    GroundColorsSpec, GroundSpec, TerrainGenerator, TerrainKind, TerrainSource, TerrainSpec,
};
use glam::DVec3;

/// The most posts that a generated terrain may have.
const MOST_POSTS: usize = 1 << 28;

/// A degree of longitude on the equator of WGS 84.
const METRES_PER_DEGREE: f64 = 6_378_137.0 * std::f64::consts::PI / 180.0;

pub(super) fn terrain(section: &mut Section<'_>) -> Result<TerrainSpec> {
    let diagonal = section.name("diagonal")?.unwrap_or_default();
    Ok(TerrainSpec {
        source: source(section)?,
        window: rectangle(section, "window")?,
        offset: section.displacement("offset")?.unwrap_or(DVec3::ZERO),
        crs: section.text("crs")?,
        bounds: rectangle(section, "bounds")?,
        encoding: section.name("encoding")?,
        band: section.integer("band")?,
        nodata: section.number("nodata")?,
        diagonal,
        lod: level_of_detail(section, diagonal)?,
        vertical_scale: section.number("vertical_scale")?.unwrap_or(1.0),
        ground: ground(section)?,
    })
}

fn source(section: &mut Section<'_>) -> Result<TerrainSource> {
    let taken = section.texts_at("source")?;
    if !taken.is_empty() {
        let files = taken.into_iter().map(|taken| data_file(section.origin(), taken));
        return Ok(TerrainSource::Files(files.collect()));
    }
    if let Some((key, place)) = section.first_of(&["window", "crs", "bounds", "encoding", "band", "nodata"]) {
        return Err(
            section.error_at(place, format!("`terrain.{key}` goes with a `source`, not with `generate`"))
        );
    }
    let node = section.take_or_empty("generate");
    Section::read(section.origin(), node, generator).map(TerrainSource::Generate)
}

fn ground(section: &mut Section<'_>) -> Result<GroundSpec> {
    let color = section.color("color")?.unwrap_or(Color::from_rgba8([0xc8, 0xb8, 0x9a, 0xff]));
    let colors = match section.text_at("imagery")? {
        Some(taken) => GroundColorsSpec::Imagery(data_file(section.origin(), taken)),
        None => GroundColorsSpec::Constant(color),
    };
    let light = match section.name("shade")?.unwrap_or(ShadeName::Flat) {
        ShadeName::Hillshade => {
            let node = section.take_or_empty("light");
            Some(Section::read(section.origin(), node, light)?)
        }
        ShadeName::Flat => match section.first_of(&["light"]) {
            Some((_, place)) => {
                let what = "`terrain.light` goes with shade = \"hillshade\" only";
                return Err(section.error_at(place, what));
            }
            None => None,
        },
    };
    Ok(GroundSpec { colors, light })
}

fn level_of_detail(section: &mut Section<'_>, diagonal: Diagonal) -> Result<Option<LevelOfDetail>> {
    if let Some((_, place)) = section.first_of(&["lod"]).filter(|_| diagonal != Diagonal::Alternating) {
        let what =
            format!("cells that are split \"{}\" do not nest in a level-of-detail mesh", diagonal.word());
        return Err(section.error_at(place, what).help("write diagonal = \"alternating\" under [terrain]"));
    }
    let read = |section: &mut Section<'_>| {
        let detail = match section.integer("level")? {
            Some(level) => Detail::Level(level),
            None => Detail::ErrorPx(section.number("error_px")?.unwrap_or(0.0)),
        };
        Ok(LevelOfDetail { detail, borrow: section.number("borrow")?.unwrap_or(0.0) })
    };
    section.take("lod").map(|node| Section::read(section.origin(), node, read)).transpose()
}

fn light(section: &mut Section<'_>) -> Result<Light> {
    let default = Light::default();
    Ok(Light {
        azimuth_deg: section.number("azimuth_deg")?.unwrap_or(default.azimuth_deg),
        elevation_deg: section.number("elevation_deg")?.unwrap_or(default.elevation_deg),
    })
}

fn generator(section: &mut Section<'_>) -> Result<TerrainGenerator> {
    let name = section.name("kind")?.unwrap_or(TerrainName::Plane);
    let posts = posts(section)?;
    let cell_deg = section.number("cell_deg")?;
    let cell_m = match cell_deg {
        Some(degrees) => degrees * METRES_PER_DEGREE,
        None => section.number("cell_m")?.unwrap_or(30.0),
    };
    let level = matches!(name, TerrainName::Plane | TerrainName::Ramp);
    let height_m = section.number("height_m")?.unwrap_or(if level { 0.0 } else { 500.0 });
    refuse_foreign(section, name)?;
    let sides = (extent(posts.0, cell_m), extent(posts.1, cell_m));
    Ok(TerrainGenerator {
        kind: kind(section, name, sides)?,
        posts,
        cell_m,
        is_in_degrees: cell_deg.is_some(),
        height_m,
    })
}

fn extent(posts: usize, cell_m: f64) -> f64 {
    (posts - 1) as f64 * cell_m
}

fn posts(section: &mut Section<'_>) -> Result<(usize, usize)> {
    let Some(Taken { value: [columns, rows], place }) = section.integers_at("posts")? else {
        return Ok((257, 257));
    };
    if columns * rows > MOST_POSTS {
        return Err(
            section.error_at(&place, format!("{columns} x {rows} posts are too many: at most 2^28 in all"))
        );
    }
    Ok((columns, rows))
}

/// The keys of one kind are no keys of another.
fn refuse_foreign(section: &Section<'_>, name: TerrainName) -> Result<()> {
    let own: &[&str] = match name {
        TerrainName::Plane => &[],
        TerrainName::Ramp => &["slope_deg"],
        TerrainName::Sine => &["wavelength_m"],
        TerrainName::Cone | TerrainName::Tent => &["radius_m"],
        TerrainName::Fbm => &["seed", "wavelength_m", "octaves"],
    };
    // A seed may stay while one tries the kinds: the others have nothing to pick.
    let foreign: Vec<&str> = ["slope_deg", "wavelength_m", "radius_m", "octaves"]
        .into_iter()
        .filter(|key| !own.contains(key))
        .collect();
    section.first_of(&foreign).map_or(Ok(()), |(key, place)| {
        Err(section.error_at(place, format!("this kind of terrain has no `{key}`")))
    })
}

fn kind(section: &mut Section<'_>, name: TerrainName, (east, north): (f64, f64)) -> Result<TerrainKind> {
    let seed = section.integer("seed")?.unwrap_or(1);
    let longer = if east > north { east } else { north };
    let quarter = 0.25 * if east > north { north } else { east };
    Ok(match name {
        TerrainName::Plane => TerrainKind::Plane,
        TerrainName::Ramp => TerrainKind::Ramp { slope_deg: section.number("slope_deg")?.unwrap_or(10.0) },
        TerrainName::Sine => {
            TerrainKind::Sine { wavelength_m: section.number("wavelength_m")?.unwrap_or(0.25 * longer) }
        }
        TerrainName::Cone => TerrainKind::Cone { radius_m: section.number("radius_m")?.unwrap_or(quarter) },
        TerrainName::Tent => TerrainKind::Tent { radius_m: section.number("radius_m")?.unwrap_or(quarter) },
        TerrainName::Fbm => TerrainKind::Fbm {
            seed,
            wavelength_m: section.number("wavelength_m")?.unwrap_or(0.5 * longer),
            octaves: section.integer("octaves")?.unwrap_or(9),
        },
    })
}
