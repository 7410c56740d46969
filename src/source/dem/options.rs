//! What is wanted of a terrain file.

/// What to read of a terrain file.
#[derive(Debug, Clone, Copy, Default)]
pub struct DemOptions {
    /// Only this part: x0, y0, x1, y1 in the file's own coordinates; grown to whole posts around it, and cut at the
    /// file's edge.
    pub window: Option<[f64; 4]>,
    /// How a PNG encodes heights; `None` refuses PNG files with a hint.
    pub encoding: Option<PngEncoding>,
    /// The outer edges x0, y0, x1, y1 of an image that says itself nothing of its place (PNG or TIFF without geo keys
    /// and without a world file); such an image is else a grid of cell 1 whose south-west post stands at (0, 0).
    pub bounds: Option<[f64; 4]>,
    /// Which band of a file with several holds the heights, from 1; `None`: the first, where the file is no picture.
    pub band: Option<usize>,
    /// A stored value that means no data, beside those that the file declares.
    pub nodata: Option<f64>,
}

/// How a PNG encodes heights.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PngEncoding {
    /// R * 256 + G + B / 256 - 32768 metres.
    Terrarium,
    /// (R * 65536 + G * 256 + B) / 10 - 10000 metres.
    Mapbox,
}
