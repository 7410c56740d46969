//! Whole numbers as people read them.

/// A whole number with its thousands apart.
pub(super) fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let groups: Vec<&str> = digits
        .as_bytes()
        .rchunks(3)
        .rev()
        .map(|group| std::str::from_utf8(group).unwrap_or_default())
        .collect();
    groups.join("\u{202f}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands_are_set_apart() {
        let words = [0, 999, 1000, 11_120_000].map(grouped);
        assert_eq!(words, ["0", "999", "1\u{202f}000", "11\u{202f}120\u{202f}000"]);
    }
}
