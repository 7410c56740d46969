//! PNG tiles with heights in their colours: Terrarium and Mapbox Terrain-RGB.
//!
//! A PNG says nothing of its place: a world file beside it does, or `bounds`, else it is a local grid of cell 1 whose
//! south-west post stands at (0, 0). It refuses images that are not 8-bit RGB or RGBA as stored: grey values, palettes
//! and 16-bit channels are no encoded heights. Fully transparent pixels hold no data.

use super::content::MAX_POSTS;
use super::failure::{too_many_posts, unreadable};
use super::frame::{Frame, PostRange};
use super::grid::{GridFile, Header, RowSink};
use super::image_place;
use super::nodata::{Nodata, Precision};
use super::options::{DemOptions, PngEncoding};
use super::sidecar::Sidecar;
use super::site::{Input, Site};
use crate::error::{Error, Result};
use image::codecs::png::PngDecoder;
use image::{ImageDecoder, ImageError, Limits};
use std::io::{BufReader, Read, Seek};

/// Deflate cannot expand a byte into more.
const LARGEST_EXPANSION: u64 = 1040;

/// A PNG of encoded heights.
pub(super) struct HeightPng {
    decoder: Option<PngDecoder<BufReader<Input>>>,
    header: Header,
    encoding: PngEncoding,
    channels: usize,
    nodata: Nodata,
    file_length: u64,
}

impl HeightPng {
    /// Reads the header.
    pub(super) fn open(mut file: Input, site: &Site, options: &DemOptions, beside: &Sidecar) -> Result<Self> {
        let encoding = options.encoding.ok_or_else(|| {
            Error::new("a PNG does not say how its colours encode heights")
                .help("say it: encoding = \"terrarium\" or encoding = \"mapbox\"")
        })?;
        let file_length = file.length()?;
        let stored = channels(&mut file)?;
        let decoder = PngDecoder::with_limits(BufReader::new(file), limits()).map_err(damaged)?;
        let channels = usize::from(decoder.color_type().channel_count());
        if channels < stored || decoder.color_type().bytes_per_pixel() as usize != channels {
            return Err(Error::internal("the PNG decoder changed the pixels' kind"));
        }
        let (columns, rows) = decoder.dimensions();
        let size = (columns as usize, rows as usize);
        let (frame, is_placed, note) = place(site, size, options.bounds, beside.place)?;
        let header = Header {
            format: "PNG",
            sample: "uint8 x 3".into(),
            compression: "deflate".into(),
            layout: "rows".into(),
            nodata: None,
            frame,
            is_placed,
            crs_hint: None,
            unit: None,
            scaling: None,
            notes: vec![note],
        };
        let nodata = Nodata::new([None, beside.nodata, options.nodata], Precision::Double);
        Ok(Self { decoder: Some(decoder), header, encoding, channels, nodata, file_length })
    }

    fn pixel_bytes(&self) -> usize {
        self.header.frame.columns * self.header.frame.rows * self.channels
    }
}

impl GridFile for HeightPng {
    fn header(&self) -> &Header {
        &self.header
    }

    fn check_promise(&mut self, _part: &PostRange) -> Result<()> {
        let frame = &self.header.frame;
        let posts = frame.columns * frame.rows;
        if posts > MAX_POSTS {
            return Err(too_many_posts(&frame.whole()));
        }
        if self.pixel_bytes() as u64 / LARGEST_EXPANSION > self.file_length {
            return Err(Error::new(format!(
                "the image promises {} x {} pixels, more than its {} bytes can hold",
                frame.columns, frame.rows, self.file_length
            ))
            .help("it may be half a download: fetch it again"));
        }
        Ok(())
    }

    fn scan(&mut self, part: &PostRange, sink: &mut dyn RowSink) -> Result<()> {
        self.check_promise(part)?;
        let mut pixels = vec![0; self.pixel_bytes()];
        let decoder = self.decoder.take().ok_or_else(|| Error::internal("a PNG was scanned twice"))?;
        decoder.read_image(&mut pixels).map_err(damaged)?;
        let columns = self.header.frame.columns;
        let mut heights = vec![0.0; columns];
        for (row, line) in pixels.chunks_exact(columns * self.channels).enumerate() {
            for (height, pixel) in heights.iter_mut().zip(line.chunks_exact(self.channels)) {
                *height = self.nodata.height(height_of(self.encoding, pixel));
            }
            sink.take(row, 0, &heights);
        }
        Ok(())
    }
}

/// The height that a pixel encodes.
fn height_of(encoding: PngEncoding, pixel: &[u8]) -> f64 {
    let &[r, g, b, ref alpha @ ..] = pixel else {
        return f64::NAN;
    };
    if alpha.first() == Some(&0) {
        return f64::NAN;
    }
    let [r, g, b] = [r, g, b].map(f64::from);
    match encoding {
        PngEncoding::Terrarium => r * 256.0 + g + b / 256.0 - 32768.0,
        PngEncoding::Mapbox => (r * 65536.0 + g * 256.0 + b) / 10.0 - 10000.0,
    }
}

fn place(
    site: &Site,
    size: (usize, usize),
    bounds: Option<[f64; 4]>,
    beside: Option<[f64; 6]>,
) -> Result<(Frame, bool, String)> {
    if let Some((frame, said_by)) = image_place::place(site, size, beside)? {
        return Ok((frame, true, format!("placed by the {said_by} beside it")));
    }
    match bounds {
        Some(bounds) => Ok((Frame::within(size, bounds)?, false, "placed by the given bounds".into())),
        None => Ok((
            Frame::local(size)?,
            false,
            "the image says neither its place nor its CRS: a local grid, cell 1, south-west post at (0, 0)"
                .into(),
        )),
    }
}

/// The channels of an 8-bit RGB or RGBA image, as its header states them (a decoder would expand palettes).
fn channels(file: &mut Input) -> Result<usize> {
    let mut header = [0; 26];
    file.read_exact(&mut header).and_then(|()| file.rewind()).map_err(unreadable)?;
    let kind = match (header[24], header[25]) {
        (8, 2) => return Ok(3),
        (8, 6) => return Ok(4),
        (_, 0 | 4) => "grey values",
        (_, 3) => "indices into a palette",
        _ => "colours of more than 8 bits",
    };
    Err(Error::new(format!("its pixels are {kind}, but encoded heights are 8-bit RGB or RGBA"))
        .help("convert heights stored as grey values with: gdal_translate FILE OUT.tif"))
}

fn limits() -> Limits {
    let mut limits = Limits::default();
    limits.max_alloc = Some(64 << 20);
    limits
}

fn damaged(error: ImageError) -> Error {
    Error::new(format!("the PNG is damaged: {error}")).caused_by(error).help("fetch or export it again")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_encodings_give_their_documented_heights() {
        assert_eq!(height_of(PngEncoding::Terrarium, &[128, 10, 64]), 10.25);
        assert_eq!(height_of(PngEncoding::Mapbox, &[1, 134, 160]), 0.0);
        assert_eq!(height_of(PngEncoding::Mapbox, &[1, 134, 165, 255]), 0.5);
    }

    #[test]
    fn transparent_pixels_hold_no_data() {
        assert!(height_of(PngEncoding::Terrarium, &[128, 10, 64, 0]).is_nan());
    }
}
