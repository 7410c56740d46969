//! The least and the greatest stored heights, and whether they are likely to mean "no data".

/// What is known of the ends of some heights.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extremes {
    low: End,
    high: End,
}

/// The outermost value, the next one, and how many posts have the outermost. Counted away from the middle.
#[derive(Debug, Clone, Copy)]
struct End {
    last: f64,
    next: f64,
    count: u64,
}

impl End {
    const NONE: Self = Self { last: f64::NEG_INFINITY, next: f64::NEG_INFINITY, count: 0 };

    fn take(&mut self, v: f64) {
        if v > self.last {
            *self = Self { last: v, next: self.last, count: 1 };
        } else if v == self.last {
            self.count += 1;
        } else if v > self.next {
            self.next = v;
        }
    }
}

/// Values that programs write where they know nothing, and the height of a black pixel of Mapbox's encoding.
const CUSTOMARY: [f64; 13] = [
    -999.0, -9999.0, -10000.0, -99999.0, -999_999.0, -32767.0, -32768.0, 9999.0, 32767.0, 65535.0, 99999.0,
    999_999.0, 1e20,
];

impl Extremes {
    /// Of no heights.
    pub(super) const NONE: Self = Self { low: End::NONE, high: End::NONE };

    /// Takes a height in; one that is not finite adds nothing.
    pub(super) fn take(&mut self, height: f64) {
        if height.is_finite() {
            self.low.take(-height);
            self.high.take(height);
        }
    }

    /// The least and the greatest.
    pub(super) fn range(&self) -> Option<[f64; 2]> {
        (self.low.count > 0).then_some([-self.low.last, self.high.last])
    }

    /// A customary value for "no data" that stands apart from all other heights, and how many posts have it.
    fn suspect(&self) -> Option<(f64, u64)> {
        let Self { low, high } = self;
        let apart = |end: &End, other: &End, value: f64| {
            // The gap to the other heights against what those span.
            let rest = other.last + end.next;
            let is_apart = end.next.is_infinite() || end.last - end.next > rest;
            (CUSTOMARY.contains(&value) && is_apart).then_some((value, end.count))
        };
        apart(low, high, -low.last).or_else(|| apart(high, low, high.last))
    }
}

impl Extremes {
    /// What to say of a suspect value.
    pub(super) fn note(&self) -> Option<String> {
        let (value, count) = self.suspect()?;
        let posts = if count == 1 { "1 height is".to_owned() } else { format!("{count} heights are") };
        Some(format!(
            "{posts} {value}, far from all others: if that means no data, say so: `terrain.nodata = {value}`"
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(heights: &[f64]) -> Extremes {
        let mut extremes = Extremes::NONE;
        heights.iter().for_each(|h| extremes.take(*h));
        extremes
    }

    #[test]
    fn a_customary_value_apart_from_the_others_is_suspect() {
        assert_eq!(of(&[900.0, -9999.0, 1200.0, -9999.0, f64::NAN]).suspect(), Some((-9999.0, 2)));
        assert_eq!(of(&[900.0, 9999.0, 1200.0]).suspect(), Some((9999.0, 1)));
        assert_eq!(of(&[0.0, -999.0, 0.0]).suspect(), Some((-999.0, 1)));
        assert_eq!(of(&[-9999.0, -9999.0]).suspect(), Some((-9999.0, 2)));
    }

    #[test]
    fn a_deep_sea_and_ordinary_heights_are_not() {
        assert_eq!(of(&[-9999.0, -9500.0, -8000.0, 1000.0]).suspect(), None);
        assert_eq!(of(&[0.0, 0.0, 100.0]).suspect(), None);
        assert_eq!(of(&[]).suspect(), None);
        assert_eq!(of(&[f64::NAN]).range(), None);
        assert_eq!(of(&[3.0, -2.0]).range(), Some([-2.0, 3.0]));
    }
}
