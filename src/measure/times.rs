//! Times of repetitions.

/// Milliseconds of some repetitions.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Times {
    /// The median.
    pub median: f64,
    /// The shortest.
    pub min: f64,
    /// The longest.
    pub max: f64,
}

impl Times {
    /// The times of some repetitions; none: 0.
    pub fn of(mut times: Vec<f64>) -> Self {
        times.sort_by(f64::total_cmp);
        let at = |k: usize| times.get(k).copied().unwrap_or(0.0);
        let (count, middle) = (times.len(), times.len() / 2);
        let is_odd = count % 2 == 1;
        let median = if is_odd || count == 0 { at(middle) } else { (at(middle - 1) + at(middle)) / 2.0 };
        Self { median, min: at(0), max: at(count.saturating_sub(1)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_median_is_not_moved_by_one_slow_run() {
        let median = |times: &[f64]| Times::of(times.to_vec()).median;
        assert_eq!(median(&[3.0]), 3.0);
        assert_eq!(median(&[900.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(&[900.0, 1.0, 2.0, 2.5]), 2.25);
        assert_eq!(Times::of(vec![9.0, 1.0, 2.0]), Times { median: 2.0, min: 1.0, max: 9.0 });
    }
}
