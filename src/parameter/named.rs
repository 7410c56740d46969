//! Settings that are written as words.

/// A setting that is written as one of some words.
pub trait Named: Copy + PartialEq + 'static {
    /// Each word and what it stands for.
    const NAMES: &'static [(&'static str, Self)];
    /// What each word means, in their order, for people.
    const MEANINGS: &'static [&'static str];

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
            $($(#[$($about_value:tt)+])* $value:ident = $word:literal,)+
        }
    ) => {
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        $visibility enum $name {
            $($(#[$($about_value)+])* $value,)+
        }

        impl $crate::parameter::Named for $name {
            const NAMES: &'static [(&'static str, Self)] = &[$(($word, Self::$value)),+];
            const MEANINGS: &'static [&'static str] = &[
                $($crate::parameter::words!(@meaning $([$($about_value)+])*).trim_ascii()),+
            ];
        }
    };
    // The text of the attributes that are documentation.
    (@meaning) => { "" };
    (@meaning [doc = $line:literal] $($rest:tt)*) => {
        concat!($line, $crate::parameter::words!(@meaning $($rest)*))
    };
    (@meaning [$($other:tt)+] $($rest:tt)*) => { $crate::parameter::words!(@meaning $($rest)*) };
}
pub(crate) use words;
