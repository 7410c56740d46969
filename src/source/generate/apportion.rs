//! A whole that is shared out.

/// Shares `total` out to `count` in proportion to weights greater than 0, at least `least` to each: the sum is `total`, or `least * count` where
/// that is more.
pub(super) fn apportion(
    total: usize,
    count: usize,
    least: usize,
    weight: impl Fn(usize) -> f64,
) -> Vec<usize> {
    let spare = total.saturating_sub(least * count);
    let whole: f64 = (0..count).map(&weight).sum();
    let (mut sum, mut given) = (0.0, 0);
    let mut shares = Vec::with_capacity(count);
    for k in 0..count {
        sum += weight(k);
        // What all so far have together is rounded, so that no error adds up.
        let until = if k + 1 == count {
            spare
        } else {
            ((spare as f64 * (sum / whole)) as usize).clamp(given, spare)
        };
        shares.push(least + until - given);
        given = until;
    }
    shares
}

/// A weight for a number 0 <= x < 1 that looks random: of things whose sizes differ a lot, like lakes and towns. The largest are some
/// hundred times as large as the smallest, the mean 4.6 times.
pub(super) fn uneven(unit: f64) -> f64 {
    1.0 / (unit + 0.01)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_add_up_and_none_is_too_small() {
        let weight = |k: usize| uneven(k as f64 / 100.0);
        for total in [0, 299, 300, 301, 1000, 123_457] {
            let shares = apportion(total, 100, 3, weight);
            assert_eq!(shares.iter().sum::<usize>(), total.max(300));
            assert!(shares.iter().all(|share| *share >= 3));
        }
        assert!(apportion(10, 0, 3, weight).is_empty());
    }

    #[test]
    fn shares_follow_their_weights() {
        let shares = apportion(1000, 4, 0, |k| [1.0, 2.0, 3.0, 4.0][k]);
        assert_eq!(shares, [100, 200, 300, 400]);
    }
}
