//! A curve that keeps neighbours of the plane together.

/// The place of a cell on the Morton curve: the bits of its column and its row in alternation.
pub fn morton(column: u32, row: u32) -> u64 {
    spread(column) | spread(row) << 1
}

/// Every bit of a number moved to the even places.
fn spread(v: u32) -> u64 {
    let mut v = u64::from(v);
    for (shift, mask) in [
        (16, 0x0000_ffff_0000_ffff),
        (8, 0x00ff_00ff_00ff_00ff),
        (4, 0x0f0f_0f0f_0f0f_0f0f),
        (2, 0x3333_3333_3333_3333),
        (1, 0x5555_5555_5555_5555u64),
    ] {
        v = (v | v << shift) & mask;
    }
    v
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_runs_through_a_quarter_before_the_next() {
        let places: Vec<u64> = (0..4).flat_map(|row| (0..4).map(move |column| morton(column, row))).collect();
        assert_eq!(places, [0, 1, 4, 5, 2, 3, 6, 7, 8, 9, 12, 13, 10, 11, 14, 15]);
        assert_eq!(morton(u32::MAX, 0), 0x5555_5555_5555_5555);
        assert_eq!(morton(0, u32::MAX), 0xaaaa_aaaa_aaaa_aaaa);
    }
}
