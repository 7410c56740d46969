//! Pictures as texels: PNG, JPEG and WebP, told by their first bytes.
//!
//! JPEG is read by code without parts for single processors, so that its colours have the same bits everywhere. A picture that is
//! damaged or cut is refused: a half would be drawn as if it were the whole.

use crate::buffer::Buffer;
use crate::error::{Error, Result};
use crate::scene::Color;
use image::{ImageError, ImageFormat, ImageReader, Limits};
use std::fs::File;
use std::io::{self, BufReader, Read, Seek};
use std::path::Path;
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

/// The most texels of an image (1 GiB of colours).
const MOST_TEXELS: usize = 1 << 25;

/// The most bytes of a JPEG.
const LONGEST_JPEG: u64 = 1 << 28;

const HELP: &str =
    "imagery is a PNG, JPEG or WebP; make one of others with: gdal_translate -of PNG FILE OUT.png";

/// The texels of a picture.
pub(super) fn texels(path: &Path) -> Result<Buffer<Color>> {
    let unreadable = |error| Error::io("the image cannot be read", error).help(HELP);
    let mut file = File::open(path).map_err(unreadable)?;
    let mut magic = Vec::new();
    (&mut file).take(16).read_to_end(&mut magic).and_then(|_| file.rewind()).map_err(unreadable)?;
    if magic.starts_with(&[0xff, 0xd8, 0xff]) {
        return jpeg(file);
    }
    let format = image::guess_format(&magic).ok();
    let format = format.filter(|format| matches!(format, ImageFormat::Png | ImageFormat::WebP));
    let Some(format) = format else {
        return Err(Error::unsupported("the image is of an unknown kind").help(HELP));
    };
    let mut reader = ImageReader::with_format(BufReader::new(file), format);
    let mut limits = Limits::default();
    limits.max_alloc = Some(8 * MOST_TEXELS as u64);
    reader.limits(limits);
    let damaged = |error: ImageError| {
        Error::new(format!("the image cannot be read: {error}")).caused_by(error).help(HELP)
    };
    let image = reader.decode().map_err(damaged)?;
    let (width, height) = (image.width() as usize, image.height() as usize);
    check_size(width, height)?;
    // 16 bits hold 8-bit values exactly: v * 257 / 65535 = v / 255.
    let colors = image.into_rgba16();
    let color = |pixel: &image::Rgba<u16>| Color(pixel.0.map(|v| f64::from(v) / 65535.0));
    Ok(Buffer::from_values(width, height, colors.pixels().map(color).collect()))
}

fn check_size(width: usize, height: usize) -> Result<()> {
    if width.saturating_mul(height) <= MOST_TEXELS {
        return Ok(());
    }
    Err(Error::unsupported(format!("{width} x {height} texels are too many"))
        .help(format!("at most {MOST_TEXELS} in all: make the image smaller")))
}

/// Whether a JPEG's end comes after its pixels begin. (The decoder fills in what is missing.)
fn is_whole(bytes: &[u8]) -> bool {
    let mut at = 2;
    while let Some(&[0xff, marker]) = bytes.get(at..at + 2) {
        let length = match (marker, bytes.get(at + 2..at + 4)) {
            // Among pixels, 0xff is followed by 0 or by a marker.
            (0xda, _) => return bytes[at..].windows(2).any(|pair| pair == [0xff, 0xd9]),
            // A filling byte, and markers without a segment.
            (0xff, _) => 1,
            (0x01 | 0xd0..=0xd7, _) => 2,
            (_, Some(&[high, low])) => 2 + usize::from(u16::from_be_bytes([high, low])),
            (_, _) => return false,
        };
        at += length;
    }
    false
}

fn jpeg(file: File) -> Result<Buffer<Color>> {
    let mut bytes = Vec::new();
    let unreadable = |error: io::Error| Error::io("the image cannot be read", error);
    file.take(LONGEST_JPEG + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > LONGEST_JPEG {
        return Err(Error::unsupported(format!("the JPEG has more than {LONGEST_JPEG} bytes"))
            .help("make the image smaller"));
    }
    if !is_whole(&bytes) {
        return Err(Error::new("the JPEG ends too early").help("it may be half a download: fetch it again"));
    }
    let options = DecoderOptions::default()
        .jpeg_set_out_colorspace(ColorSpace::RGB)
        .set_strict_mode(true)
        .set_max_width(1 << 16)
        .set_max_height(1 << 16);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    let damaged = |error| {
        Error::new(format!("the JPEG cannot be read: {error:?}"))
            .help("it may be half a download: fetch it again")
    };
    decoder.decode_headers().map_err(damaged)?;
    let (width, height) = decoder.info().map_or((0, 0), |info| (info.width.into(), info.height.into()));
    check_size(width, height)?;
    let pixels = decoder.decode().map_err(damaged)?;
    if pixels.len() != 3 * width * height || pixels.is_empty() {
        return Err(Error::unsupported("the JPEG's colours are of a kind that is not read").help(HELP));
    }
    let color = |pixel: &[u8; 3]| {
        let [r, g, b] = pixel.map(|v| f64::from(v) / 255.0);
        Color([r, g, b, 1.0])
    };
    Ok(Buffer::from_values(width, height, pixels.as_chunks().0.iter().map(color).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Cursor;

    /// A grey JPEG of blocks of 8 x 8 equal pixels, side by side.
    fn grey_jpeg(blocks: &[u8]) -> Vec<u8> {
        let mut out = vec![0xff, 0xd8, 0xff, 0xdb, 0, 67, 0];
        out.extend([1; 64]);
        let width = (8 * blocks.len() as u16).to_be_bytes();
        out.extend([0xff, 0xc0, 0, 11, 8, 0, 8, width[0], width[1], 1, 1, 0x11, 0]);
        // Differences: 12 classes, each a code of 4 bits. The rest of a block: its end, a code of one bit.
        out.extend([0xff, 0xc4, 0, 31, 0, 0, 0, 0, 12, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
        out.extend(0..12);
        out.extend([0xff, 0xc4, 0, 20, 0x10, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
        out.extend([0xff, 0xda, 0, 8, 1, 1, 0, 0, 63, 0]);
        let (mut bits, mut before) = (Vec::new(), 0_i32);
        for grey in blocks {
            let value = 8 * (i32::from(*grey) - 128);
            let difference = value - before;
            before = value;
            let class = 32 - difference.unsigned_abs().leading_zeros();
            let code = if difference < 0 { difference + (1 << class) - 1 } else { difference };
            bits.extend((0..4).rev().map(|i| class >> i & 1 == 1));
            bits.extend((0..class).rev().map(|i| code >> i & 1 == 1));
            bits.push(false);
        }
        for byte in bits.chunks(8) {
            let byte = (0..8).fold(0, |n, i| n << 1 | u8::from(byte.get(i).copied().unwrap_or(true)));
            out.push(byte);
            if byte == 0xff {
                out.push(0);
            }
        }
        out.extend([0xff, 0xd9]);
        out
    }

    fn read(bytes: &[u8]) -> Result<Buffer<Color>> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("picture");
        std::fs::write(&path, bytes).unwrap();
        texels(&path)
    }

    fn encoded(format: ImageFormat) -> Vec<u8> {
        let pixels = image::RgbaImage::from_raw(2, 1, vec![255, 0, 51, 255, 1, 2, 3, 102]).unwrap();
        let mut out = Cursor::new(Vec::new());
        pixels.write_to(&mut out, format).unwrap();
        out.into_inner()
    }

    #[test]
    fn png_and_webp_have_the_colours_that_they_store() {
        for format in [ImageFormat::Png, ImageFormat::WebP] {
            let texels = read(&encoded(format)).unwrap();
            assert_eq!((texels.width(), texels.height()), (2, 1));
            assert_eq!(texels.at(0, 0).0, [1.0, 0.0, 0.2, 1.0]);
            assert_eq!(texels.at(1, 0).0[3], 0.4);
        }
    }

    #[test]
    fn a_jpeg_has_the_greys_of_its_blocks() {
        let greys = [128, 129, 0, 255, 51];
        let texels = read(&grey_jpeg(&greys)).unwrap();
        assert_eq!((texels.width(), texels.height()), (40, 8));
        for (block, grey) in greys.iter().enumerate() {
            let expected = f64::from(*grey) / 255.0;
            assert_eq!(texels.at(8 * block + 3, 5).0, [expected, expected, expected, 1.0], "{grey}");
        }
    }

    #[test]
    fn what_is_cut_or_no_picture_is_refused() {
        let jpeg = grey_jpeg(&[10, 200, 30, 90]);
        for bytes in [
            &jpeg[..jpeg.len() / 2],
            &jpeg[..jpeg.len() - 6],
            &jpeg[..20],
            b"GIF89a",
            b"",
            &encoded(ImageFormat::WebP)[..20],
        ] {
            assert!(!read(bytes).unwrap_err().is_internal());
        }
        // A header of 65,535 x 65,535 pixels is refused before memory is set aside.
        let mut huge = jpeg;
        let frame = huge.windows(2).position(|w| w == [0xff, 0xc0]).unwrap();
        huge[frame + 5..frame + 9].fill(0xff);
        assert!(read(&huge).unwrap_err().to_string().contains("too many"));
    }
}
