//! FLIP, what a viewer sees who flips between two pictures: for information, not the same bits everywhere.

use crate::buffer::Buffer;
use flip_rs::{DEFAULT_PPD, RgbImage, ldr_flip};

/// The mean of FLIP (P. Andersson et al. 2020, *FLIP: A Difference Evaluator for Alternating Images*) of a picture against what is
/// expected, at the authors' distance of view; transparency is left out. `None`: there is none.
pub fn flip(expected: &Buffer<[u8; 4]>, actual: &Buffer<[u8; 4]>) -> Option<f64> {
    let rgb = |picture: &Buffer<[u8; 4]>| {
        let colors = picture.values().iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect();
        RgbImage::new(picture.width(), picture.height(), colors).ok()
    };
    let map = ldr_flip(&rgb(expected)?, &rgb(actual)?, DEFAULT_PPD).ok()?;
    let mean = map.pixels().iter().map(|v| f64::from(*v)).sum::<f64>() / map.pixels().len() as f64;
    // Single precision makes it; more digits say nothing.
    Some((mean * 1e6).round() / 1e6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_pictures_have_no_flip_and_black_is_far_from_white() {
        let plain = |v: u8| Buffer::from_values(16, 16, vec![[v, v, v, 255]; 256]);
        assert_eq!(flip(&plain(90), &plain(90)), Some(0.0));
        assert!(flip(&plain(0), &plain(255)).unwrap() > 0.9);
    }
}
