//! PNGs with encoded heights.

use super::super::{DemOptions, PngEncoding, read};
use super::{posts, read_bytes, refusal, with_file};
use crate::space::Plan;
use image::{ExtendedColorType, ImageEncoder};

/// A PNG whose pixel (c, r) encodes 100 c + r in Mapbox's way.
pub(super) fn mapbox() -> Vec<u8> {
    let mut pixels = Vec::new();
    for (c, r) in (0..3).flat_map(|r| (0..4).map(move |c| (c, r))) {
        let code = 100_000 + (100 * c + r) * 10_u32;
        pixels.extend(&code.to_be_bytes()[1..]);
    }
    encode(&pixels, (4, 3), ExtendedColorType::Rgb8)
}

/// A PNG of 8-bit colours.
pub(super) fn rgb(pixels: &[u8], size: (u32, u32)) -> Vec<u8> {
    encode(pixels, size, ExtendedColorType::Rgb8)
}

fn encode(pixels: &[u8], (columns, rows): (u32, u32), kind: ExtendedColorType) -> Vec<u8> {
    let mut bytes = Vec::new();
    image::codecs::png::PngEncoder::new(&mut bytes).write_image(pixels, columns, rows, kind).unwrap();
    bytes
}

fn options(bounds: Option<[f64; 4]>) -> DemOptions {
    DemOptions { encoding: Some(PngEncoding::Mapbox), bounds, ..DemOptions::default() }
}

#[test]
fn a_png_without_a_place_is_a_local_grid() {
    let dem = read_bytes("a.png", &mapbox(), &options(None)).unwrap();
    assert!(dem.notes[0].contains("local grid") && dem.crs_hint.is_none());
    let posts = posts(dem);
    assert_eq!(posts.first, Plan::new(0.0, 0.0));
    assert_eq!(posts.world(1, 0).z, 102.0);
    assert_eq!(posts.world(3, 2).z, 300.0);
}

#[test]
fn bounds_or_a_world_file_give_its_place() {
    let placed = posts(read_bytes("a.png", &mapbox(), &options(Some([0.0, 0.0, 8.0, 6.0]))).unwrap());
    assert_eq!((placed.first, placed.east().x), (Plan::new(1.0, 1.0), 2.0));
    let placed = with_file("a.png", &mapbox(), |path| {
        std::fs::write(path.with_extension("pgw"), "5\n0\n0\n-5\n100\n200\n").unwrap();
        posts(read(&path, &options(None)).unwrap())
    });
    assert_eq!((placed.first, placed.east().x), (Plan::new(100.0, 190.0), 5.0));
}

#[test]
fn a_broken_world_file_is_named() {
    let message = with_file("a.png", &mapbox(), |path| {
        std::fs::write(path.with_extension("pgw"), "5\n0\nx\n").unwrap();
        read(&path, &options(None)).unwrap_err().to_string()
    });
    assert!(message.contains("a.pgw:3:1"), "{message}");
}

#[test]
fn the_encoding_must_be_said() {
    let message = refusal("a.png", &mapbox(), &DemOptions::default());
    assert!(message.contains("encoding = \"terrarium\""), "{message}");
}

#[test]
fn other_pixels_than_8_bit_colours_are_refused() {
    for (kind, bytes, name) in
        [(ExtendedColorType::L8, 1, "grey"), (ExtendedColorType::Rgb16, 6, "more than 8 bits")]
    {
        let png = encode(&vec![0; 4 * bytes], (2, 2), kind);
        let message = refusal("a.png", &png, &options(None));
        assert!(message.contains(name), "{message}");
    }
}

#[test]
fn a_png_cannot_promise_more_than_it_holds() {
    let mut png = mapbox();
    png[16..24].copy_from_slice(&[0, 0, 0x20, 0, 0, 0, 0x20, 0]);
    refusal("a.png", &png, &options(None));
    let mut cut = mapbox();
    cut.truncate(cut.len() - 20);
    refusal("a.png", &cut, &options(None));
}
