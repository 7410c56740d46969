//! PNG of 8 or 16 bits (fewer bits, palettes and grey become colours).

use super::size::{MOST_PIXELS, check_promise, check_size};
use crate::compare::image::{Image, Samples};
use crate::error::{Error, Result};
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};
use std::io::Cursor;

pub(super) const MAGIC: &[u8] = b"\x89PNG\r\n\x1a\n";

/// Room for the largest picture: four 16-bit values a pixel.
const MOST_BYTES: u64 = 8 * MOST_PIXELS as u64;

pub(super) fn decode(bytes: &[u8]) -> Result<Image> {
    let picture = open(bytes)?;
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let color = picture.color();
    let has_16_bits = color.bytes_per_pixel() > color.channel_count();
    let (channels, samples) = match (color.has_alpha(), has_16_bits) {
        (true, true) => (4, Samples::Codes16(picture.into_rgba16().into_raw())),
        (true, false) => (4, Samples::Codes8(picture.into_rgba8().into_raw())),
        (false, true) => (3, Samples::Codes16(picture.into_rgb16().into_raw())),
        (false, false) => (3, Samples::Codes8(picture.into_rgb8().into_raw())),
    };
    Image::of(width, height, channels, samples)
}

/// Width, height and pixels in codes of 16 bits.
pub(in crate::compare) fn codes(bytes: &[u8]) -> Result<(usize, usize, Vec<[u16; 4]>)> {
    let picture = open(bytes)?;
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    Ok((width, height, picture.into_rgba16().into_raw().as_chunks().0.to_vec()))
}

fn open(bytes: &[u8]) -> Result<DynamicImage> {
    let refuse =
        |error: image::ImageError| Error::new(format!("this PNG cannot be read: {error}")).caused_by(error);
    let mut reader = ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png);
    let mut limits = Limits::default();
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(refuse)?;
    let (width, height) = decoder.dimensions();
    let (width, height) = (width as usize, height as usize);
    check_size(width, height, 4)?;
    let bits = u64::from(decoder.original_color_type().bits_per_pixel());
    check_promise((width * height) as u64 * bits / 8, bytes.len())?;
    DynamicImage::from_decoder(decoder).map_err(refuse)
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};

    fn decoded(codes: &[u8], width: u32, color: ExtendedColorType) -> Image {
        let mut file = Vec::new();
        PngEncoder::new(&mut file).write_image(codes, width, 1, color).unwrap();
        decode(&file).unwrap()
    }

    #[test]
    fn codes_of_8_bits_are_255ths_exactly() {
        let codes: Vec<u8> = (0..=255).flat_map(|v| [v, 255 - v, v, 255]).collect();
        let image = decoded(&codes, 256, ExtendedColorType::Rgba8);
        let wanted: Vec<f64> = codes.iter().map(|v| f64::from(*v) / 255.0).collect();
        assert_eq!((image.width(), image.channels(), &image.reals(4)[..]), (256, 4, &wanted[..]));
    }

    #[test]
    fn codes_of_16_bits_are_65535ths() {
        let codes: Vec<u8> = [1_u16, 258, 65535].iter().flat_map(|v| v.to_ne_bytes()).collect();
        let image = decoded(&codes, 1, ExtendedColorType::Rgb16);
        assert_eq!((image.channels(), &image.reals(3)[..]), (3, &[1.0 / 65535.0, 258.0 / 65535.0, 1.0][..]));
    }

    #[test]
    fn grey_is_a_colour() {
        assert_eq!(decoded(&[51], 1, ExtendedColorType::L8).reals(3)[..], [0.2, 0.2, 0.2]);
        assert_eq!(decoded(&[51, 102], 1, ExtendedColorType::La8).reals(4)[..], [0.2, 0.2, 0.2, 0.4]);
    }

    #[test]
    fn pixels_that_the_file_cannot_hold_are_refused() {
        let mut file = Vec::new();
        PngEncoder::new(&mut file).write_image(&[0; 4], 1, 1, ExtendedColorType::Rgba8).unwrap();
        let mut head = file[12..29].to_vec();
        head[4..12].copy_from_slice(&[0, 0, 0x10, 0, 0, 0, 0x10, 0]);
        file[12..29].copy_from_slice(&head);
        file[29..33].copy_from_slice(&crc32(&head).to_be_bytes());
        let error = decode(&file).unwrap_err();
        assert!(error.what().contains("cannot hold the 67108864 bytes of pixels"), "{error}");
    }

    /// The checksum of a chunk of a PNG.
    fn crc32(bytes: &[u8]) -> u32 {
        let step = |crc: u32| if crc & 1 == 1 { 0xedb8_8320 ^ (crc >> 1) } else { crc >> 1 };
        !bytes.iter().fold(!0, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), |crc, _| step(crc)))
    }

    #[test]
    fn a_damaged_file_is_refused() {
        let mut file = Vec::new();
        PngEncoder::new(&mut file).write_image(&[0; 400], 10, 10, ExtendedColorType::Rgba8).unwrap();
        for length in [8, 20, file.len() / 2] {
            let error = decode(&file[..length]).unwrap_err();
            assert!(error.what().starts_with("this PNG cannot be read"), "{error}");
        }
    }
}
