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
    "pixels" "plain-pixels" "levels" "samples" "colours" "fills"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene_file::SceneText;
    use crate::source::load;
    use crate::stage::Stage;
    use crate::technique::{self, Kind};

    #[test]
    fn every_scene_can_be_drawn_by_two_techniques_at_least_and_imitates_a_machine() {
        for scene in SCENES {
            let text =
                SceneText::parse(scene.text, None, &[]).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
            let (loaded, surface) = load::load(&text.file, &|_| {}).unwrap();
            let stage = Stage::new(loaded, surface).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
            let kinds = Kind::ALL.iter().filter(|kind| technique::applies(**kind, &stage).is_ok()).count();
            assert!(kinds >= 2 && stage.scene.device.subpixel_bits > 0, "{}: {kinds}", scene.name);
        }
    }
}
