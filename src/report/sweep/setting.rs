//! What a sweep is: settings in lines, and alone.

/// The changes of one setting: `path=value`.
pub type Step = &'static [&'static str];

/// Settings of one thing, in the order of a line of the plot.
pub type Axis = &'static [Step];

/// What is tried of a technique. (The scene's own settings are tried always.)
#[derive(Debug, Clone, Copy)]
pub struct Sweep {
    /// Every step of the first with every step of the others; each combination of the others is a line of the plot.
    pub crossed: &'static [Axis],
    /// One at a time, all else as in the scene.
    pub alone: &'static [Axis],
}

/// A setting to try.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Variation {
    /// Changes of the scene file.
    pub changes: Vec<&'static str>,
    /// What the settings of its line have in common, if it is on one.
    pub line: Option<String>,
}

/// The machines that are imitated: single precision, then what graphics processors add to it.
pub(super) const MACHINES: Axis = &[
    &["device.precision=f32"],
    &["device.precision=f32", "device.subpixel_bits=8"],
    &["device.precision=f32", "device.subpixel_bits=8", "device.depth=unorm24"],
    &["device.precision=f32", "device.subpixel_bits=4", "device.depth=unorm16"],
];

impl Sweep {
    /// All settings, the scene's own first. Some may be the same where the scene has one of the values itself.
    pub fn variations(&self) -> Vec<Variation> {
        let mut all = vec![Variation::default()];
        if let Some((along, across)) = self.crossed.split_first() {
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
        let alone = self.alone.iter().flat_map(|axis| axis.iter());
        all.extend(alone.map(|step| Variation { changes: step.to_vec(), line: None }));
        all
    }
}

/// Changes as people read them: without the tables that their keys are in.
pub fn words(changes: &[&str]) -> Vec<String> {
    let word = |change: &&str| {
        let (path, value) = change.split_once('=').unwrap_or((change, ""));
        format!("{}={}", path.rsplit('.').next().unwrap_or(path), value.trim_matches('"'))
    };
    changes.iter().map(word).collect()
}
