//! Pictures cut out, enlarged, side by side.

use crate::buffer::Buffer;

/// A part of a picture as shares of its width and height, from the left and the top: left, top, right, bottom.
pub(super) type Part = [f64; 4];

/// Cuts a part out and repeats each of its pixels `times` times both ways, so that they can be seen.
pub(super) fn enlarged(picture: &Buffer<[u8; 4]>, part: Part, times: usize) -> Buffer<[u8; 4]> {
    let place = |share: f64, size: usize| ((share * size as f64) as usize).min(size - 1);
    let (left, top) = (place(part[0], picture.width()), place(part[1], picture.height()));
    let (right, bottom) = (place(part[2], picture.width()) + 1, place(part[3], picture.height()) + 1);
    let (width, height) = ((right - left) * times, (bottom - top) * times);
    let pixel = |k: usize| *picture.at(left + k % width / times, top + k / width / times);
    Buffer::from_values(width, height, (0..width * height).map(pixel).collect())
}

/// All of a picture, each pixel `times` times both ways.
pub(super) fn magnified(picture: &Buffer<[u8; 4]>, times: usize) -> Buffer<[u8; 4]> {
    enlarged(picture, [0.0, 0.0, 1.0, 1.0], times)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_is_cut_out_and_its_pixels_repeated() {
        let gray = |v: u8| [v, v, v, 255];
        let picture = Buffer::from_values(4, 2, (0..8).map(gray).collect());
        let right = enlarged(&picture, [0.5, 0.0, 1.0, 0.4], 2);
        assert_eq!((right.width(), right.height()), (4, 2));
        assert_eq!(right.row(0), [gray(2), gray(2), gray(3), gray(3)]);
        assert_eq!(right.row(0), right.row(1));
        assert_eq!(magnified(&picture, 1), picture);
    }
}
