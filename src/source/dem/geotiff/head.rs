//! The head of a GeoTIFF: its tags, judged and understood.
//!
//! Source: "TIFF 6.0", section 8; GDAL's documentation of its GeoTIFF driver for the two tags of its own.

use super::super::geo_keys::GeoKeys;
use super::super::grid::Header;
use super::super::nodata::Nodata;
use super::super::site::Site;
use super::codec::{Compression, Predictor};
use super::layout::Layout;
use super::place;
use super::sample::Sample;
use super::tags::{Directory, Endian, Source, tag};
use crate::error::{Error, Result};
use std::io::{Read, Seek};

/// All that the tags say.
pub(super) struct Head {
    pub(super) header: Header,
    pub(super) layout: Layout,
    pub(super) coding: Coding,
    pub(super) nodata: Nodata,
    /// Factor and offset from samples to heights.
    pub(super) scaling: Option<(f64, f64)>,
}

/// How samples are written.
#[derive(Debug, Clone, Copy)]
pub(super) struct Coding {
    pub(super) endian: Endian,
    pub(super) compression: Compression,
    pub(super) predictor: Predictor,
    pub(super) sample: Sample,
    /// Samples a pixel in a block.
    pub(super) stride: usize,
}

impl Head {
    /// Reads the tags; `site` serves to find a world file, `bounds` stands in for a missing place.
    pub(super) fn read<R: Read + Seek>(
        source: &mut Source<R>,
        site: Option<&Site>,
        bounds: Option<[f64; 4]>,
    ) -> Result<Self> {
        let directory = Directory::read(source)?;
        let size = raster_size(&directory, source)?;
        let (coding, bands) = coding(&directory, source)?;
        let layout = layout(&directory, source, size, &coding)?;
        let keys = geo_keys(&directory, source)?;
        let (frame, note) = place::frame(&directory, source, &keys, size, (site, bounds))?;
        let declared = directory.text(source, tag::GDAL_NODATA)?;
        let nodata = nodata(declared.as_deref(), coding.sample)?;
        let scaling = scaling(&directory, source)?;
        let notes = [note, note_bands(bands), note_units(&keys), note_scaling(scaling)];
        let header = Header {
            format: if directory.big { "BigTIFF" } else { "GeoTIFF" },
            sample: coding.sample.name().into(),
            compression: coding.compression.name().into(),
            layout: layout.describe(),
            nodata: declared.map(|text| text.trim().to_owned()),
            frame,
            crs_hint: keys.crs_hint(),
            notes: notes.into_iter().flatten().collect(),
        };
        Ok(Self { header, layout, coding, nodata, scaling })
    }
}

fn raster_size<R: Read + Seek>(directory: &Directory, source: &mut Source<R>) -> Result<(usize, usize)> {
    let mut read = |tag, name: &str| {
        let value = directory.whole(source, tag)?.unwrap_or(0);
        if value == 0 || value > 1 << 31 {
            return Err(Error::new(format!("the TIFF's {name} of {value} samples is absurd"))
                .help("the header is damaged: fetch the file again"));
        }
        Ok(value as usize)
    };
    Ok((read(tag::WIDTH, "width")?, read(tag::HEIGHT, "height")?))
}

/// How samples are written, and how many bands there are.
fn coding<R: Read + Seek>(directory: &Directory, source: &mut Source<R>) -> Result<(Coding, u64)> {
    let mut get = |tag, default| Ok::<_, Error>(directory.whole(source, tag)?.unwrap_or(default));
    let bands = get(tag::SAMPLES_PER_PIXEL, 1)?;
    if bands == 0 || bands > 1 << 12 {
        return Err(Error::new(format!("the TIFF's {bands} bands are absurd"))
            .help("extract the heights: gdal_translate -b 1 FILE OUT.tif"));
    }
    if get(tag::FILL_ORDER, 1)? != 1 {
        return Err(Error::unsupported("the TIFF's bytes hold their bits in reverse (FillOrder 2)")
            .help("rewrite the file: gdal_translate FILE OUT.tif"));
    }
    let sample = Sample::from_tags(get(tag::BITS, 1)?, get(tag::SAMPLE_FORMAT, 1)?)?;
    let interleaved = get(tag::PLANAR, 1)? != 2;
    let coding = Coding {
        endian: directory.endian,
        compression: Compression::from_tag(get(tag::COMPRESSION, 1)?)?,
        predictor: Predictor::from_tag(get(tag::PREDICTOR, 1)?, sample.is_floating())?,
        sample,
        stride: if interleaved { bands as usize } else { 1 },
    };
    if interleaved && bands > 1 {
        check_equal_bits(directory, source, bands)?;
    }
    Ok((coding, bands))
}

/// Refuses interleaved bands of different sizes.
fn check_equal_bits<R: Read + Seek>(directory: &Directory, source: &mut Source<R>, bands: u64) -> Result<()> {
    let bits = directory.wholes(source, tag::BITS, bands)?;
    if bits.windows(2).all(|pair| pair[0] == pair[1]) {
        return Ok(());
    }
    Err(Error::unsupported("the TIFF's bands have samples of different sizes")
        .help("extract the heights: gdal_translate -b 1 FILE OUT.tif"))
}

/// The blocks; their lengths must be said where they are packed.
fn layout<R: Read + Seek>(
    directory: &Directory,
    source: &mut Source<R>,
    size: (usize, usize),
    coding: &Coding,
) -> Result<Layout> {
    let layout = Layout::read(directory, source, size, coding.sample.size() * coding.stride)?;
    if coding.compression != Compression::None && !layout.has_lengths() {
        return Err(Error::new("the TIFF does not say how long its compressed blocks are")
            .help("rewrite the file: gdal_translate FILE OUT.tif"));
    }
    Ok(layout)
}

fn geo_keys<R: Read + Seek>(directory: &Directory, source: &mut Source<R>) -> Result<GeoKeys> {
    const MOST: u64 = 1 << 16;
    let keys = directory.wholes(source, tag::GEO_KEYS, MOST)?;
    let keys: Vec<u16> = keys.into_iter().map(|k| k as u16).collect();
    let numbers = directory.doubles(source, tag::GEO_NUMBERS)?;
    let text = directory.text(source, tag::GEO_TEXT)?.unwrap_or_default();
    Ok(GeoKeys::new(&keys, &numbers, &text))
}

fn nodata(declared: Option<&str>, sample: Sample) -> Result<Nodata> {
    let text = declared.map(str::trim).filter(|t| !t.is_empty());
    let value = text.map(|text| {
        text.parse().map_err(|_| {
            Error::new(format!("the nodata value `{text}` is not a number"))
                .help("set it anew: gdal_edit.py -a_nodata VALUE FILE")
        })
    });
    Ok(Nodata::new(value.transpose()?, sample.precision()))
}

/// Factor and offset of the first band in GDAL's metadata: height = sample * factor + offset.
fn scaling<R: Read + Seek>(directory: &Directory, source: &mut Source<R>) -> Result<Option<(f64, f64)>> {
    let Some(xml) = directory.text(source, tag::GDAL_METADATA)? else {
        return Ok(None);
    };
    let factor = metadata_item(&xml, "scale").unwrap_or(1.0);
    let offset = metadata_item(&xml, "offset").unwrap_or(0.0);
    Ok(((factor, offset) != (1.0, 0.0)).then_some((factor, offset)))
}

/// The number in `<Item ... sample="0" role="ROLE">number</Item>`.
fn metadata_item(xml: &str, role: &str) -> Option<f64> {
    let role = format!("role=\"{role}\"");
    xml.split("<Item ").skip(1).find_map(|item| {
        let (attributes, rest) = item.split_once('>')?;
        if !attributes.contains(&role) || !attributes.contains("sample=\"0\"") {
            return None;
        }
        let number: f64 = rest.split_once('<')?.0.trim().parse().ok()?;
        number.is_finite().then_some(number)
    })
}

fn note_bands(bands: u64) -> Option<String> {
    (bands > 1).then(|| format!("the file has {bands} bands: the first is taken as heights"))
}

fn note_units(keys: &GeoKeys) -> Option<String> {
    let unit = keys.foreign_vertical_unit()?;
    Some(format!("the file declares heights in {unit}; they are taken as metres (set vertical_scale)"))
}

fn note_scaling(scaling: Option<(f64, f64)>) -> Option<String> {
    let (factor, offset) = scaling?;
    Some(format!("heights are samples x {factor} + {offset}, as the file declares"))
}
