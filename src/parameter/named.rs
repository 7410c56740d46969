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

/// An enum whose values are written as words:
///
/// ```text
/// words! {
///     /// Which caps volumes have.
///     pub enum VolumeCaps {
///         /// Both.
///         Both = "both",
///         /// The bottom alone.
///         Bottom = "bottom",
///     }
/// }
/// ```
macro_rules! words {
    (
        $(#[$about:meta])*
        $visibility:vis enum $name:ident {
            $($(#[$value_about:meta])* $value:ident = $word:literal,)+
        }
    ) => {
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        $visibility enum $name {
            $($(#[$value_about])* $value,)+
        }

        impl $crate::parameter::Named for $name {
            const NAMES: &'static [(&'static str, Self)] = &[$(($word, Self::$value)),+];
        }
    };
}
pub(crate) use words;
