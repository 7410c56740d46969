//! The scenes of the judge's test: small, self-contained, each with what some bug needs to be seen.

/// A scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct SmallScene {
    /// Its name.
    pub(super) name: &'static str,
    /// Its scene file.
    pub(super) text: &'static str,
}

macro_rules! scenes {
    ($($name:literal)*) => {
        /// All of them.
        pub(super) const SCENES: &[SmallScene] =
            &[$(SmallScene { name: $name, text: include_str!(concat!("scenes/", $name, ".toml")) }),*];
    };
}

scenes! {
    "hills" "map" "oblique" "mosaic" "joins" "groups" "inside" "ridge" "planes" "utm" "thin" "wide" "linear" "additive" "four-bits"
    "pixels" "plain-pixels" "levels" "samples" "colours"
}
