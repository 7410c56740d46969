//! OpenEXR: one part of flat data, scan lines or tiles, of half, single or 32-bit integer values; RGB, RGBA or a
//! single channel.

use super::size::{check_promise, check_size};
use crate::compare::image::Image;
use crate::error::{Error, Result};
use ::exr::image::{AnyChannel, FlatSamples};
use ::exr::meta::MetaData;
use ::exr::meta::header::Header;
use ::exr::prelude::{ReadChannels, ReadLayers};
use std::io::Cursor;

pub(super) const MAGIC: &[u8] = b"\x76\x2f\x31\x01";

pub(super) fn decode(bytes: &[u8]) -> Result<Image> {
    let refuse = |error: ::exr::error::Error| {
        Error::new(format!("this EXR file cannot be read: {error}")).caused_by(error)
    };
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(refuse)?;
    let (width, height, names) = check(&meta, bytes.len())?;
    let read = ::exr::image::read::read().no_deep_data().largest_resolution_level().all_channels();
    let read = read.first_valid_layer().all_attributes().non_parallel();
    let picture = read.from_buffered(Cursor::new(bytes)).map_err(refuse)?;
    let channels = &picture.layer_data.channel_data.list;
    let find = |name: &&str| channels.iter().find(|channel| channel.name.eq(name));
    let channels: Vec<&AnyChannel<FlatSamples>> = names.iter().filter_map(|name| find(&&**name)).collect();
    let mut values = Vec::with_capacity(width * height * channels.len());
    for pixel in 0..width * height {
        for channel in &channels {
            values.extend(value(&channel.sample_data, pixel));
        }
    }
    Image::new(width, height, channels.len(), values)
}

/// The size, and the channels in their order; refuses what cannot be compared, and what the file cannot hold.
fn check(meta: &MetaData, file: usize) -> Result<(usize, usize, Vec<String>)> {
    let [header] = &meta.headers[..] else {
        return Err(Error::unsupported(format!("this EXR file has {} parts", meta.headers.len()))
            .help("one part can be compared: write the picture to a file of its own"));
    };
    let (width, height) = (header.layer_size.x(), header.layer_size.y());
    check_size(width, height, header.channels.list.len())?;
    check_block(header)?;
    check_promise((width * height * header.channels.bytes_per_pixel) as u64, file)?;
    let window = header.shared_attributes.display_window;
    if header.own_attributes.layer_position != window.position || header.layer_size != window.size {
        return Err(Error::unsupported("this EXR file's data window is not its display window")
            .help("write the whole picture, so that both are the same"));
    }
    Ok((width, height, names(header)?))
}

/// Refuses vast tiles and lines: memory for a whole one is taken before it is read.
fn check_block(header: &Header) -> Result<()> {
    const MOST_BYTES: usize = 1 << 28;
    let size = header.max_block_pixel_size();
    let bytes = size.x().checked_mul(size.y()).and_then(|n| n.checked_mul(header.channels.bytes_per_pixel));
    if bytes.is_none_or(|bytes| bytes > MOST_BYTES) {
        return Err(Error::unsupported(format!(
            "this EXR file has blocks of {} x {} pixels, which are too large to compare",
            size.x(),
            size.y()
        ))
        .help("write it in tiles, or in lines that are packed one by one"));
    }
    Ok(())
}

/// The channels of a colour in their order, or the only one.
fn names(header: &Header) -> Result<Vec<String>> {
    let has: Vec<String> = header.channels.list.iter().map(|channel| channel.name.to_string()).collect();
    let mut sorted: Vec<&str> = has.iter().map(String::as_str).collect();
    sorted.sort_unstable();
    match sorted[..] {
        ["B", "G", "R"] => Ok(["R", "G", "B"].map(String::from).to_vec()),
        ["A", "B", "G", "R"] => Ok(["R", "G", "B", "A"].map(String::from).to_vec()),
        [_] => Ok(has),
        _ => Err(Error::unsupported(format!("this EXR file has the channels {}", has.join(", ")))
            .help("R, G, B with or without A can be compared, or a single channel")),
    }
}

/// A pixel's value; `None` past the end.
fn value(samples: &FlatSamples, pixel: usize) -> Option<f64> {
    match samples {
        FlatSamples::F16(values) => values.get(pixel).map(|v| v.to_f64()),
        FlatSamples::F32(values) => values.get(pixel).map(|v| f64::from(*v)),
        FlatSamples::U32(values) => values.get(pixel).map(|v| f64::from(*v)),
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use ::exr::image::{AnyChannels, Encoding, Image as ExrImage, Layer};
    use ::exr::prelude::*;

    fn file(channels: Vec<AnyChannel<FlatSamples>>, size: (usize, usize), encoding: Encoding) -> Vec<u8> {
        let channels = AnyChannels::sort(channels.into_iter().collect());
        let layer = Layer::new(size, LayerAttributes::default(), encoding, channels);
        let mut file = Cursor::new(Vec::new());
        ExrImage::from_layer(layer).write().to_buffered(&mut file).unwrap();
        file.into_inner()
    }

    fn channel(name: &str, samples: FlatSamples) -> AnyChannel<FlatSamples> {
        AnyChannel::new(name, samples)
    }

    /// A file in tiles, packed.
    pub(in crate::compare::read) fn example() -> Vec<u8> {
        let channels = ["R", "G", "B"].map(|name| channel(name, FlatSamples::F32(vec![0.5; 6]))).to_vec();
        file(channels, (3, 2), Encoding::SMALL_FAST_LOSSLESS)
    }

    #[test]
    fn colours_come_in_their_order_from_lines_and_tiles_and_every_kind_of_number() {
        let half = |v: &[f32]| FlatSamples::F16(v.iter().map(|v| f16::from_f32(*v)).collect());
        for encoding in [Encoding::UNCOMPRESSED, Encoding::FAST_LOSSLESS, Encoding::SMALL_FAST_LOSSLESS] {
            let channels = vec![
                channel("R", FlatSamples::F32(vec![0.1, f32::INFINITY])),
                channel("G", half(&[0.5, -2.0])),
                channel("B", FlatSamples::U32(vec![7, u32::MAX])),
                channel("A", half(&[1.0, 0.25])),
            ];
            let image = decode(&file(channels, (2, 1), encoding)).unwrap();
            assert_eq!((image.width(), image.height(), image.channels()), (2, 1, 4));
            let wanted = [f64::from(0.1_f32), 0.5, 7.0, 1.0, f64::INFINITY, -2.0, 4_294_967_295.0, 0.25];
            assert_eq!(image.values().collect::<Vec<_>>(), wanted, "{encoding:?}");
        }
    }

    #[test]
    fn vast_tiles_and_pixels_that_are_not_there_are_refused_before_memory_is_taken() {
        let tiled = example();
        let at = tiled.windows(8).position(|window| window == b"tiledesc").unwrap() + 13;
        let mut vast = tiled.clone();
        // Found by fuzzing: 2 GB were asked for.
        vast[at..at + 8].copy_from_slice(&[0, 1, 0, 4, 0, 1, 0, 0]);
        let error = decode(&vast).unwrap_err();
        assert!(error.what().contains("blocks of 67109120 x 256 pixels"), "{error}");
        let lines =
            file(vec![channel("Y", FlatSamples::F32(vec![0.5; 64]))], (64, 1), Encoding::UNCOMPRESSED);
        let mut wide = lines.clone();
        for name in [&b"dataWindow\0box2i\0"[..], b"displayWindow\0box2i\0"] {
            let at = wide.windows(name.len()).position(|window| window == name).unwrap() + name.len() + 4;
            wide[at + 8..at + 12].copy_from_slice(&((1 << 24) - 1_u32).to_le_bytes());
        }
        let error = decode(&wide).unwrap_err();
        assert!(error.what().contains("cannot hold the 67108864 bytes of pixels"), "{error}");
    }

    #[test]
    fn a_picture_in_parts_or_in_a_window_of_another_size_or_place_is_refused() {
        let layer = |name: &str, at: (i32, i32)| {
            let gray = [channel("Y", FlatSamples::F32(vec![0.5; 6]))];
            let gray = AnyChannels::sort(gray.into_iter().collect());
            let attributes = LayerAttributes::named(name).with_position(Vec2(at.0, at.1));
            Layer::new((3, 2), attributes, Encoding::UNCOMPRESSED, gray)
        };
        let refused = |layers: Vec<Layer<AnyChannels<FlatSamples>>>, window: (usize, usize)| {
            let attributes = ImageAttributes::new(IntegerBounds::from_dimensions(window));
            let mut file = Cursor::new(Vec::new());
            ExrImage::from_layers(attributes, layers).write().to_buffered(&mut file).unwrap();
            decode(&file.into_inner()).map_err(|error| error.what().to_owned())
        };
        assert!(refused(vec![layer("one", (0, 0))], (3, 2)).is_ok());
        let parts = vec![layer("one", (0, 0)), layer("two", (0, 0))];
        assert_eq!(refused(parts, (3, 2)).unwrap_err(), "this EXR file has 2 parts");
        for (at, window) in [((1, 0), (3, 2)), ((0, 0), (4, 2)), ((0, 0), (3, 3))] {
            let error = refused(vec![layer("one", at)], window).unwrap_err();
            assert_eq!(error, "this EXR file's data window is not its display window");
        }
    }

    #[test]
    fn a_nan_is_kept_for_the_comparison_to_find() {
        let image = decode(&file(
            vec![channel("Z", FlatSamples::F32(vec![0.0, f32::NAN]))],
            (1, 2),
            Encoding::UNCOMPRESSED,
        ));
        let place = image.unwrap().first_nan().unwrap();
        assert_eq!((place.x, place.y, place.channel), (0, 1, 0));
    }

    #[test]
    fn other_channels_and_damaged_files_are_refused() {
        let one = || FlatSamples::F32(vec![0.0]);
        let odd = file(vec![channel("R", one()), channel("Z", one())], (1, 1), Encoding::UNCOMPRESSED);
        let error = decode(&odd).unwrap_err();
        assert_eq!(error.what(), "this EXR file has the channels R, Z");
        let whole = file(vec![channel("Y", one())], (1, 1), Encoding::UNCOMPRESSED);
        for length in [4, 40, whole.len() - 2] {
            let error = decode(&whole[..length]).unwrap_err();
            assert!(error.what().starts_with("this EXR file cannot be read"), "{error}");
        }
    }
}
