//! Pictures as PNG.

use crate::buffer::Buffer;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use std::io::{self, Write};

/// Writes a picture as an 8-bit RGBA PNG. Compressed for speed: a run writes many, and hashes are of the pixels, not
/// of the file.
///
/// # Errors
/// Those of the writer, and a picture that PNG cannot hold.
pub fn write_png(picture: &Buffer<[u8; 4]>, to: &mut dyn Write) -> io::Result<()> {
    write(picture, CompressionType::Fast, to)
}

/// Writes codes of 16 bits as an RGBA PNG.
///
/// # Errors
/// As [`write_png`].
pub fn write_codes16(codes: &Buffer<[u16; 4]>, to: &mut dyn Write) -> io::Result<()> {
    let bytes: Vec<u8> = codes.values().iter().flatten().flat_map(|code| code.to_ne_bytes()).collect();
    encode((&bytes, ExtendedColorType::Rgba16), [codes.width(), codes.height()], CompressionType::Fast, to)
}

/// The bytes of a PNG that is to be carried around within another file: compressed for size.
///
/// # Errors
/// As [`write_png`].
pub fn small_png(picture: &Buffer<[u8; 4]>) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    write(picture, CompressionType::Default, &mut bytes)?;
    Ok(bytes)
}

fn write(picture: &Buffer<[u8; 4]>, compression: CompressionType, to: &mut dyn Write) -> io::Result<()> {
    let bytes = picture.values().as_flattened();
    encode((bytes, ExtendedColorType::Rgba8), [picture.width(), picture.height()], compression, to)
}

fn encode(
    (bytes, kind): (&[u8], ExtendedColorType),
    [width, height]: [usize; 2],
    compression: CompressionType,
    to: &mut dyn Write,
) -> io::Result<()> {
    let size = |n: usize| u32::try_from(n).map_err(io::Error::other);
    PngEncoder::new_with_quality(to, compression, FilterType::Adaptive)
        .write_image(bytes, size(width)?, size(height)?, kind)
        .map_err(io::Error::other)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_read_back_with_its_transparency() {
        let values = (0..35u8).map(|v| [v, 255 - v, v.wrapping_mul(37), v * 7]).collect();
        let picture = Buffer::from_values(7, 5, values);
        let mut file = Vec::new();
        write_png(&picture, &mut file).unwrap();
        for file in [file, small_png(&picture).unwrap()] {
            let back = image::load_from_memory(&file).unwrap().into_rgba8();
            assert_eq!(back.dimensions(), (7, 5));
            assert_eq!(back.as_raw(), picture.values().as_flattened());
        }
    }
}
