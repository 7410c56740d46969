//! Pictures are no heights.

use super::super::{DemOptions, read};
use super::tiff_writer::{Kind, Tiff, Values};
use super::{png, posts, read_bytes, refusal, with_file};
use crate::source::dem::PngEncoding;
use image::{ExtendedColorType, ImageEncoder};

fn tiff(kind: Kind, bands: usize, photometric: u16) -> Tiff {
    let mut tiff = Tiff { bands, ..Tiff::new((7, 5), kind, |c, r| (c + r) as f64) };
    tiff.tags.push((262, Values::Shorts(vec![photometric])));
    tiff
}

#[test]
fn a_palette_or_a_photograph_is_refused_as_heights() {
    for (picture, expected) in [
        (tiff(Kind::U8, 1, 3), "palette"),
        (tiff(Kind::U16, 1, 3), "palette"),
        (tiff(Kind::U8, 3, 2), "red, green and blue"),
        (tiff(Kind::U16, 3, 2), "red, green and blue"),
        (tiff(Kind::U8, 4, 5), "inks"),
        (tiff(Kind::U8, 3, 6), "brightness"),
    ] {
        let message = refusal("a.tif", &picture.bytes(), &DemOptions::default());
        assert!(message.contains(expected) && message.contains("not heights"), "{message}");
    }
}

#[test]
fn a_palette_that_is_kept_beside_the_file_is_one_too() {
    let aux = "<PAMDataset><PAMRasterBand band=\"1\"><ColorInterp>Palette</ColorInterp></PAMRasterBand></PAMDataset>";
    let message = with_file("a.tif", &tiff(Kind::U8, 1, 1).bytes(), |path| {
        std::fs::write(path.with_file_name("a.tif.aux.xml"), aux).unwrap();
        read(&path, &DemOptions::default()).unwrap_err().to_string()
    });
    assert!(message.contains("palette"), "{message}");
}

#[test]
fn a_table_of_colours_makes_a_palette_unless_a_band_is_called_heights() {
    let mut keyed = tiff(Kind::U8, 1, 1);
    keyed.tags.push((320, Values::Shorts(vec![0; 768])));
    assert!(refusal("a.tif", &keyed.bytes(), &DemOptions::default()).contains("palette"));
    let asked = DemOptions { band: Some(1), ..DemOptions::default() };
    assert_eq!(posts(read_bytes("a.tif", &keyed.bytes(), &asked).unwrap()).world(6, 0).z, 10.0);
}

#[test]
fn bands_of_heights_are_read_whatever_a_writer_calls_them() {
    for heights in [tiff(Kind::U8, 1, 1), tiff(Kind::U8, 1, 0), tiff(Kind::I16, 3, 2), tiff(Kind::F32, 3, 1)]
    {
        let posts = posts(read_bytes("a.tif", &heights.bytes(), &DemOptions::default()).unwrap());
        assert_eq!(posts.world(6, 0).z, 10.0);
    }
    let asked = DemOptions { band: Some(1), ..DemOptions::default() };
    let posts = posts(read_bytes("a.tif", &tiff(Kind::U8, 3, 2).bytes(), &asked).unwrap());
    assert_eq!(posts.world(6, 0).z, 10.0);
}

#[test]
fn a_transparent_pixel_of_a_png_is_no_post_by_its_alpha_or_by_a_transparent_colour() {
    let options = DemOptions { encoding: Some(PngEncoding::Mapbox), ..DemOptions::default() };
    let mut pixels = [1, 134, 160, 255].repeat(6);
    pixels[7] = 0;
    let mut bytes = Vec::new();
    let encoder = image::codecs::png::PngEncoder::new(&mut bytes);
    encoder.write_image(&pixels, 3, 2, ExtendedColorType::Rgba8).unwrap();
    let by_alpha = posts(read_bytes("a.png", &bytes, &options).unwrap());
    let voids = |posts: &crate::scene::Posts| posts.heights().iter().map(|h| h.is_nan()).collect::<Vec<_>>();
    assert_eq!(voids(&by_alpha), [false, false, false, false, true, false]);
    // A tRNS chunk after IHDR: the colour of the height 102 m is transparent.
    let mut keyed = png::mapbox();
    let code: u32 = 100_000 + 1020;
    let [_, r, g, b] = code.to_be_bytes();
    let mut chunk = b"tRNS".to_vec();
    chunk.extend([0, r, 0, g, 0, b]);
    let mut checksum = flate2::Crc::new();
    checksum.update(&chunk);
    let sum = checksum.sum().to_be_bytes();
    let whole = [&6_u32.to_be_bytes()[..], &chunk, &sum].concat();
    keyed.splice(33..33, whole);
    let by_colour = posts(read_bytes("a.png", &keyed, &options).unwrap());
    assert!(by_colour.world(1, 0).z.is_nan() && by_colour.world(0, 0).z == 2.0);
}
