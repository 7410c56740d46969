//! Which settings of each technique are tried: tables of data, a file a technique.
//!
//! A setting is a list of changes to the scene file (`path=value`), so that every row of a report can be drawn again by
//! `drapery render --set`. To add a technique: a file with its [`Sweep`], and its line in [`of`].

mod clipmap;
mod inverse_projection;
mod setting;
mod stencil_volume;

pub use setting::{Axis, Step, Sweep, Variation, words};

use crate::technique::Kind;

/// What is tried of a technique.
pub fn of(kind: Kind) -> Sweep {
    match kind {
        Kind::Clipmap => clipmap::SWEEP,
        Kind::InverseProjection => inverse_projection::SWEEP,
        Kind::StencilVolume => stencil_volume::SWEEP,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::file::{Override, SceneFile};

    const SCENE: &str = "schema = 1\nterrain.generate = { kind = \"plane\" }\n";

    #[test]
    fn every_change_is_one_of_a_technique_or_of_the_machine_and_is_understood() {
        for kind in Kind::ALL {
            for variation in of(kind).variations() {
                let own = format!("technique.{}.", kind.name());
                let known = |c: &&&str| c.starts_with(&own) || c.starts_with("device.");
                assert!(variation.changes.iter().all(|c| known(&c)), "{variation:?}");
                let changes: Vec<Override> =
                    variation.changes.iter().map(|c| Override::parse(c).unwrap()).collect();
                let changed = SceneFile::parse(SCENE, None, &changes).unwrap();
                let plain = SceneFile::parse(SCENE, None, &[]).unwrap();
                let is_default = (changed.technique, changed.device) == (plain.technique, plain.device);
                assert!(
                    !is_default || variation.changes.is_empty() || variation.line.is_some(),
                    "{variation:?}"
                );
            }
        }
    }

    #[test]
    fn the_sweep_of_inverse_projection_has_the_settings_that_are_asked_for() {
        let all = of(Kind::InverseProjection).variations();
        let labels: Vec<String> = all.iter().map(|v| words(&v.changes).join(" ")).collect();
        assert_eq!(labels[0], "");
        for n in 1..=8 {
            for corners in ["centres", "true"] {
                assert!(labels.contains(&format!("samples={n} corners={corners}")), "{labels:?}");
            }
        }
        assert!(labels.contains(&"point_in_polygon=winding".into()));
        assert!(labels.contains(&"precision=f32".into()));
        let lines: Vec<&str> = all.iter().filter_map(|v| v.line.as_deref()).collect();
        assert_eq!(lines.iter().filter(|line| **line == "corners=true").count(), 8);
    }

    #[test]
    fn a_sweep_without_lines_is_one_thing_at_a_time() {
        let sweep = Sweep { crossed: &[], alone: &[&[&["a.b=1"], &["a.b=2"]], &[&["a.c=x", "a.d=y"]]] };
        let changes: Vec<Vec<&str>> = sweep.variations().into_iter().map(|v| v.changes).collect();
        assert_eq!(changes, [vec![], vec!["a.b=1"], vec!["a.b=2"], vec!["a.c=x", "a.d=y"]]);
    }
}
