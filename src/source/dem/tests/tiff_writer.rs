//! A small TIFF writer: any sample kind, strips or tiles, packings, predictors, byte orders, classic or Big.

use std::io::Write;

/// A TIFF to be written; `samples` from the first row, `bands` of them a pixel.
#[derive(Debug, Clone)]
pub(super) struct Tiff {
    pub(super) size: (usize, usize),
    pub(super) samples: Vec<f64>,
    pub(super) kind: Kind,
    /// Columns and rows of a tile; `None`: strips of `strip_rows`.
    pub(super) tile: Option<(usize, usize)>,
    pub(super) strip_rows: usize,
    pub(super) packing: u16,
    pub(super) predictor: u16,
    pub(super) big_endian: bool,
    pub(super) big: bool,
    pub(super) bands: usize,
    pub(super) planar: bool,
    pub(super) nodata: Option<&'static str>,
    /// More tags, all doubles or all shorts or text.
    pub(super) tags: Vec<(u16, Values)>,
    /// Blocks that are left out.
    pub(super) left_out: Vec<usize>,
    /// The samples of the second and later bands; 0 where there are none.
    pub(super) other_bands: Vec<Vec<f64>>,
    /// The directories after the first, with their rasters.
    pub(super) more: Vec<Tiff>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    Bit,
    U8,
    I8,
    U16,
    I16,
    U32,
    I32,
    F16,
    F32,
    F64,
}

#[derive(Debug, Clone)]
pub(super) enum Values {
    Shorts(Vec<u16>),
    Longs(Vec<u64>),
    Doubles(Vec<f64>),
    Text(String),
}

impl Tiff {
    /// A single-band uncompressed little-endian TIFF of strips, cell 10, its south-west corner at (100, 200).
    pub(super) fn new(size: (usize, usize), kind: Kind, height: impl Fn(usize, usize) -> f64) -> Self {
        let samples = (0..size.0 * size.1).map(|i| height(i % size.0, i / size.0)).collect();
        let north = 200.0 + 10.0 * size.1 as f64;
        Self {
            size,
            samples,
            kind,
            tile: None,
            strip_rows: 3,
            packing: 1,
            predictor: 1,
            big_endian: false,
            big: false,
            bands: 1,
            planar: false,
            nodata: None,
            tags: vec![
                (33550, Values::Doubles(vec![10.0, 10.0, 0.0])),
                (33922, Values::Doubles(vec![0.0, 0.0, 0.0, 100.0, north, 0.0])),
            ],
            left_out: Vec::new(),
            other_bands: Vec::new(),
            more: Vec::new(),
        }
    }

    /// The file's bytes.
    pub(super) fn bytes(&self) -> Vec<u8> {
        let mut out = if self.big_endian { b"MM".to_vec() } else { b"II".to_vec() };
        if self.big {
            self.short(&mut out, 43);
            self.short(&mut out, 8);
            self.short(&mut out, 0);
            self.number(&mut out, 0, 8);
        } else {
            self.short(&mut out, 42);
            self.number(&mut out, 0, 4);
        }
        let mut link = if self.big { 8 } else { 4 };
        for tiff in std::iter::once(self).chain(&self.more) {
            let (offsets, lengths) = tiff.write_blocks(&mut out);
            link = tiff.write_directory(&mut out, link, offsets, lengths);
        }
        out
    }

    fn write_blocks(&self, out: &mut Vec<u8>) -> (Vec<u64>, Vec<u64>) {
        let (across, down) = self.tile.unwrap_or((self.size.0, self.strip_rows));
        let mut offsets = Vec::new();
        let mut lengths = Vec::new();
        let planes = if self.planar { self.bands } else { 1 };
        for plane in 0..planes {
            for top in (0..self.size.1).step_by(down) {
                for left in (0..self.size.0).step_by(across) {
                    if self.left_out.contains(&offsets.len()) {
                        offsets.push(0);
                        lengths.push(0);
                        continue;
                    }
                    let packed = self.pack(&self.block(plane, (left, top), (across, down)));
                    offsets.push(out.len() as u64);
                    lengths.push(packed.len() as u64);
                    out.extend(packed);
                }
            }
        }
        (offsets, lengths)
    }

    /// The bytes of a block after the predictor, before packing.
    fn block(&self, plane: usize, (left, top): (usize, usize), (across, down): (usize, usize)) -> Vec<u8> {
        let down = if self.tile.is_some() { down } else { down.min(self.size.1 - top) };
        let stride = if self.planar { 1 } else { self.bands };
        let mut bytes = Vec::new();
        for row in top..top + down {
            let samples: Vec<f64> = (left * stride..(left + across) * stride)
                .map(|i| {
                    let (c, band) = (i / stride, plane + i % stride);
                    let inside = c < self.size.0 && row < self.size.1;
                    let samples =
                        if band == 0 { Some(&self.samples) } else { self.other_bands.get(band - 1) };
                    samples.filter(|_| inside).map_or(0.0, |samples| samples[row * self.size.0 + c])
                })
                .collect();
            bytes.extend(self.row(&samples, stride));
        }
        bytes
    }

    fn row(&self, samples: &[f64], stride: usize) -> Vec<u8> {
        if self.kind == Kind::Bit {
            let byte = |bits: &[f64]| bits.iter().enumerate().fold(0, |n, (i, b)| n | (*b as u8) << (7 - i));
            return samples.chunks(8).map(byte).collect();
        }
        let words: Vec<Vec<u8>> = samples.iter().map(|s| self.kind.bytes(*s)).collect();
        let size = words[0].len();
        match self.predictor {
            2 => (0..words.len())
                .flat_map(|i| {
                    let number = |w: &[u8]| w.iter().rev().fold(0_u64, |n, b| n << 8 | u64::from(*b));
                    let left = if i < stride { 0 } else { number(&words[i - stride]) };
                    let difference = number(&words[i]).wrapping_sub(left);
                    let mut bytes = difference.to_le_bytes()[..size].to_vec();
                    self.turn(&mut bytes);
                    bytes
                })
                .collect(),
            3 => {
                let planes: Vec<u8> = (0..size).rev().flat_map(|b| words.iter().map(move |w| w[b])).collect();
                (0..planes.len())
                    .map(|i| planes[i].wrapping_sub(if i < stride { 0 } else { planes[i - stride] }))
                    .collect()
            }
            _ => words
                .into_iter()
                .flat_map(|mut w| {
                    self.turn(&mut w);
                    w
                })
                .collect(),
        }
    }

    fn pack(&self, bytes: &[u8]) -> Vec<u8> {
        match self.packing {
            5 => {
                weezl::encode::Encoder::with_tiff_size_switch(weezl::BitOrder::Msb, 8).encode(bytes).unwrap()
            }
            8 | 32946 => {
                let mut packer = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
                packer.write_all(bytes).unwrap();
                packer.finish().unwrap()
            }
            32773 => packed_bits(bytes),
            50000 => ruzstd::encoding::compress_to_vec(bytes, ruzstd::encoding::CompressionLevel::Fastest),
            _ => bytes.to_vec(),
        }
    }

    fn write_directory(&self, out: &mut Vec<u8>, link: usize, offsets: Vec<u64>, lengths: Vec<u64>) -> usize {
        let short = |v: usize| Values::Shorts(vec![v as u16]);
        let mut tags = vec![
            (256, Values::Longs(vec![self.size.0 as u64])),
            (257, Values::Longs(vec![self.size.1 as u64])),
            (258, Values::Shorts(vec![self.kind.bits(); self.bands])),
            (259, short(self.packing.into())),
            (277, short(self.bands)),
            (284, short(if self.planar { 2 } else { 1 })),
            (317, short(self.predictor.into())),
            (339, short(self.kind.format())),
        ];
        if let Some((across, down)) = self.tile {
            tags.extend([(322, short(across)), (323, short(down))]);
            tags.extend([(324, Values::Longs(offsets)), (325, Values::Longs(lengths))]);
        } else {
            tags.extend([(278, short(self.strip_rows))]);
            tags.extend([(273, Values::Longs(offsets)), (279, Values::Longs(lengths))]);
        }
        if let Some(nodata) = self.nodata {
            tags.push((42113, Values::Text(nodata.into())));
        }
        for (tag, values) in &self.tags {
            tags.retain(|(t, _)| t != tag);
            tags.push((*tag, values.clone()));
        }
        tags.sort_by_key(|(tag, _)| *tag);
        self.write_tags(out, link, &tags)
    }

    /// Writes a directory, its place at `link`; returns where the place of the next one stands.
    fn write_tags(&self, out: &mut Vec<u8>, link: usize, tags: &[(u16, Values)]) -> usize {
        let wide = if self.big { 8 } else { 4 };
        let mut places = Vec::new();
        for (_, values) in tags {
            let (kind, count, bytes) = self.encode(values);
            let place = if bytes.len() <= wide {
                let mut place = bytes;
                place.resize(wide, 0);
                place
            } else {
                let mut place = Vec::new();
                self.number(&mut place, out.len() as u64, wide);
                out.extend(bytes);
                place
            };
            places.push((kind, count, place));
        }
        let mut at = Vec::new();
        self.number(&mut at, out.len() as u64, wide);
        out[link..link + wide].copy_from_slice(&at);
        self.number(out, tags.len() as u64, if self.big { 8 } else { 2 });
        for ((tag, _), (kind, count, place)) in tags.iter().zip(places) {
            self.short(out, *tag);
            self.short(out, kind);
            self.number(out, count as u64, wide);
            out.extend(place);
        }
        self.number(out, 0, wide);
        out.len() - wide
    }

    fn encode(&self, values: &Values) -> (u16, usize, Vec<u8>) {
        let mut bytes = Vec::new();
        match values {
            Values::Shorts(v) => {
                v.iter().for_each(|n| self.short(&mut bytes, *n));
                (3, v.len(), bytes)
            }
            Values::Longs(v) => {
                let size = if self.big { 8 } else { 4 };
                v.iter().for_each(|n| self.number(&mut bytes, *n, size));
                (if self.big { 16 } else { 4 }, v.len(), bytes)
            }
            Values::Doubles(v) => {
                v.iter().for_each(|n| self.number(&mut bytes, n.to_bits(), 8));
                (12, v.len(), bytes)
            }
            Values::Text(text) => {
                bytes.extend(text.as_bytes());
                bytes.push(0);
                (2, bytes.len(), bytes)
            }
        }
    }

    fn short(&self, out: &mut Vec<u8>, value: u16) {
        self.number(out, value.into(), 2);
    }

    fn number(&self, out: &mut Vec<u8>, value: u64, size: usize) {
        let mut bytes = value.to_le_bytes()[..size].to_vec();
        self.turn(&mut bytes);
        out.extend(bytes);
    }

    fn turn(&self, little_endian: &mut [u8]) {
        if self.big_endian {
            little_endian.reverse();
        }
    }
}

impl Kind {
    /// The kinds of heights.
    pub(super) const ALL: [Self; 9] =
        [Self::U8, Self::I8, Self::U16, Self::I16, Self::U32, Self::I32, Self::F16, Self::F32, Self::F64];

    pub(super) fn is_floating(self) -> bool {
        matches!(self, Self::F16 | Self::F32 | Self::F64)
    }

    fn bits(self) -> u16 {
        if self == Self::Bit { 1 } else { self.bytes(0.0).len() as u16 * 8 }
    }

    fn format(self) -> usize {
        match self {
            Self::Bit | Self::U8 | Self::U16 | Self::U32 => 1,
            Self::I8 | Self::I16 | Self::I32 => 2,
            Self::F16 | Self::F32 | Self::F64 => 3,
        }
    }

    /// The little-endian bytes of a sample.
    fn bytes(self, sample: f64) -> Vec<u8> {
        match self {
            Self::Bit | Self::U8 => (sample as u8).to_le_bytes().to_vec(),
            Self::I8 => (sample as i8).to_le_bytes().to_vec(),
            Self::U16 => (sample as u16).to_le_bytes().to_vec(),
            Self::I16 => (sample as i16).to_le_bytes().to_vec(),
            Self::U32 => (sample as u32).to_le_bytes().to_vec(),
            Self::I32 => (sample as i32).to_le_bytes().to_vec(),
            Self::F16 => half(sample).to_le_bytes().to_vec(),
            Self::F32 => (sample as f32).to_le_bytes().to_vec(),
            Self::F64 => sample.to_le_bytes().to_vec(),
        }
    }
}

/// PackBits: runs of equal bytes, and copies of what lies between them.
fn packed_bits(bytes: &[u8]) -> Vec<u8> {
    let mut out = Vec::new();
    for run in bytes.chunk_by(|a, b| a == b).flat_map(|run| run.chunks(128)) {
        if run.len() > 1 {
            out.extend([(257 - run.len()) as u8, run[0]]);
        } else {
            out.extend([0, run[0], 128]);
        }
    }
    out
}

/// The bits in half precision of a whole number from 0 to 2048, which has them exactly.
fn half(sample: f64) -> u16 {
    let bits = sample.to_bits();
    if sample == 0.0 { 0 } else { ((bits >> 52) as u16 - 1023 + 15) << 10 | (bits >> 42) as u16 & 1023 }
}
