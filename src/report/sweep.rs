//! Which settings of each technique are tried: each technique declares its own.

use crate::technique::sweep::{Step, Sweep};

/// A setting to try.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Variation {
    /// Changes of the scene file.
    pub changes: Vec<&'static str>,
    /// What the settings of its line have in common, if it is on one.
    pub line: Option<String>,
}

/// All settings, the scene's own first. Some may be the same where the scene has one of the values itsweep.
pub fn variations(sweep: &Sweep) -> Vec<Variation> {
    let mut all = vec![Variation::default()];
    if let Some((along, across)) = sweep.crossed.split_first() {
        let mut lines: Vec<Vec<&str>> = vec![Vec::new()];
        for axis in across {
            let longer = lines.iter().flat_map(|line| axis.iter().map(|step| [&line[..], step].concat()));
            lines = longer.collect();
        }
        for line in lines {
            let name = words(&line).join(" ");
            let on_line =
                |step: &Step| Variation { changes: [step, &line[..]].concat(), line: Some(name.clone()) };
            all.extend(along.iter().map(on_line));
        }
    }
    let alone = sweep.alone.iter().flat_map(|axis| axis.iter());
    all.extend(alone.map(|step| Variation { changes: step.to_vec(), line: None }));
    all
}

/// Changes as people read them: without the tables that their keys are in.
pub fn words(changes: &[&str]) -> Vec<String> {
    let word = |change: &&str| {
        let (path, value) = change.split_once('=').unwrap_or((change, ""));
        format!("{}={}", path.rsplit('.').next().unwrap_or(path), value.trim_matches('"'))
    };
    changes.iter().map(word).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene_file::{Override, SceneFile};
    use crate::technique::Kind;

    const SCENE: &str = "schema = 1\nterrain.generate = { kind = \"plane\" }\n";

    #[test]
    fn every_change_is_one_of_a_technique_or_of_the_machine_and_is_understood() {
        for kind in Kind::ALL {
            for variation in variations(&kind.declaration().sweep) {
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
        let all = variations(&Kind::InverseProjection.declaration().sweep);
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
        let sweep = Sweep {
            crossed: &[],
            alone: &[&[&["a.b=1"], &["a.b=2"]], &[&["a.c=x", "a.d=y"]]],
            remedies: &[],
        };
        let changes: Vec<Vec<&str>> = variations(&sweep).into_iter().map(|v| v.changes).collect();
        assert_eq!(changes, [vec![], vec!["a.b=1"], vec!["a.b=2"], vec!["a.c=x", "a.d=y"]]);
    }
}
