//! Settings that are written as words.

/// A setting that is written as one of some words.
pub trait Named: Copy + PartialEq + 'static {
    /// Each word and what it stands for.
    const NAMES: &'static [(&'static str, Self)];

    /// What a word stands for.
    fn from_name(name: &str) -> Option<Self> {
        Self::NAMES.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
    }

    /// The word for it.
    fn word(self) -> &'static str {
        Self::NAMES.iter().find(|(_, value)| *value == self).map_or("", |(word, _)| word)
    }
}
