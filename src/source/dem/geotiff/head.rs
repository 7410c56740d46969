//! The head of a GeoTIFF: its tags, judged and understood.
//!
//! Source: "TIFF 6.0", section 8; GDAL's documentation of its GeoTIFF driver for the two tags of its own.

use super::super::frame::Frame;
use super::super::geo_keys::GeoKeys;
use super::super::grid::Header;
use super::super::nodata::Nodata;
use super::super::options::DemOptions;
use super::super::sidecar::Sidecar;
use super::super::site::Site;
use super::bands::{Bands, refuse_picture};
use super::codec::{Compression, Predictor};
use super::layout::Layout;
use super::metadata::Metadata;
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
    /// The bands that say by 0 where there is no post, from 0.
    pub(super) alphas: Vec<usize>,
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
    /// Which of them is wanted.
    pub(super) which: usize,
}

impl Head {
    /// Reads the tags of a raster of heights; `site` serves to find a world file, the options' `bounds` stand in for a missing
    /// place.
    pub(super) fn read<R: Read + Seek>(
        directory: &Directory,
        source: &mut Source<R>,
        site: Option<&Site>,
        options: &DemOptions,
        beside: &Sidecar,
    ) -> Result<Self> {
        let size = raster_size(directory, source)?;
        let bands = Bands::read(directory, source, options.band)?;
        let coding = coding(directory, source, &bands)?;
        if coding.sample == Sample::Bit {
            return Err(Error::unsupported("samples of a single bit are no heights")
                .help("name the file of heights that belongs to it"));
        }
        refuse_picture(directory, source, matches!(coding.sample, Sample::U8 | Sample::U16), options.band)?;
        let layout = layout(directory, source, size, &coding, &bands)?;
        let keys = geo_keys(directory, source)?;
        let place = (site, options.bounds, beside.place);
        let place::Place { frame, is_placed, note } = place::frame(directory, source, &keys, size, place)?;
        let declared = directory.text(source, tag::GDAL_NODATA)?;
        let of_file = nodata(declared.as_deref())?;
        let metadata = Metadata::read(directory, source, bands.heights)?;
        let notes = [note, bands.note(options.band), metadata.note];
        let declared = declared.map(|text| text.trim().to_owned());
        let header = Header {
            format: if directory.big { "BigTIFF" } else { "GeoTIFF" },
            sample: coding.sample.name().into(),
            compression: coding.compression.name().into(),
            layout: layout.describe(),
            nodata: declared.or(beside.nodata.map(|v| v.to_string())),
            frame,
            is_placed,
            crs_hint: keys.crs_hint(),
            unit: metadata.unit.or_else(|| keys.vertical_unit()),
            scaling: metadata.scaling,
            notes: notes.into_iter().flatten().collect(),
        };
        let nodata = Nodata::new([of_file, beside.nodata, options.nodata], coding.sample.precision());
        Ok(Self { header, layout, coding, nodata, alphas: bands.alphas })
    }

    /// Reads the tags of a mask: of a band, from 0, whose samples are no heights.
    pub(super) fn of_mask<R: Read + Seek>(
        directory: &Directory,
        source: &mut Source<R>,
        band: usize,
    ) -> Result<Self> {
        let size = raster_size(directory, source)?;
        let bands = Bands::read(directory, source, Some(band + 1))?;
        let coding = coding(directory, source, &bands)?;
        let layout = layout(directory, source, size, &coding, &bands)?;
        let header = Header {
            format: "mask",
            sample: coding.sample.name().into(),
            compression: coding.compression.name().into(),
            layout: layout.describe(),
            nodata: None,
            frame: Frame::local(size)?,
            is_placed: false,
            crs_hint: None,
            unit: None,
            scaling: None,
            notes: Vec::new(),
        };
        let nodata = Nodata::new([None; 3], coding.sample.precision());
        Ok(Self { header, layout, coding, nodata, alphas: Vec::new() })
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

/// How samples are written.
fn coding<R: Read + Seek>(directory: &Directory, source: &mut Source<R>, bands: &Bands) -> Result<Coding> {
    let mut get = |tag, default| Ok::<_, Error>(directory.whole(source, tag)?.unwrap_or(default));
    if get(tag::FILL_ORDER, 1)? != 1 {
        return Err(Error::unsupported("the TIFF's bytes hold their bits in reverse (FillOrder 2)")
            .help("rewrite the file: gdal_translate FILE OUT.tif"));
    }
    let (code, predictor) = (get(tag::COMPRESSION, 1)?, get(tag::PREDICTOR, 1)?);
    let mut of_band = |tag| {
        let values = directory.wholes(source, tag, bands.heights as u64 + 1)?;
        Ok::<_, Error>(values.get(bands.heights).or(values.first()).copied().unwrap_or(1))
    };
    let sample = Sample::from_tags(of_band(tag::BITS)?, of_band(tag::SAMPLE_FORMAT)?)?;
    let (stride, which) = bands.in_pixel();
    let coding = Coding {
        endian: directory.endian,
        compression: Compression::from_tag(code)?,
        predictor: Predictor::from_tag(predictor, sample.is_floating())?,
        sample,
        stride,
        which,
    };
    if stride > 1 {
        check_equal_bits(directory, source, stride as u64)?;
    }
    Ok(coding)
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
    bands: &Bands,
) -> Result<Layout> {
    let layout = Layout::read(directory, source, size, coding.sample.bits() * coding.stride, bands.plane())?;
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

/// The value that the file declares.
fn nodata(declared: Option<&str>) -> Result<Option<f64>> {
    let text = declared.map(str::trim).filter(|t| !t.is_empty());
    let value = text.map(|text| {
        text.parse().map_err(|_| {
            Error::new(format!("the nodata value `{text}` is not a number"))
                .help("set it anew: gdal_edit.py -a_nodata VALUE FILE")
        })
    });
    value.transpose()
}
