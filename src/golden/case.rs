//! The scenes of a golden folder.

use super::selection::Selection;
use crate::error::{Error, Result};
use crate::scene_file::Override;
use std::fs;
use std::path::{Path, PathBuf};

/// The end of the name of a case's settings.
const SETTINGS: &str = ".golden.toml";

/// A scene that is a golden.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// `topic/case`.
    pub name: String,
    /// Its scene file.
    pub scene: PathBuf,
    /// What is changed for the golden.
    pub set: Vec<Override>,
    /// Whether what right programs may draw of it is golden, too: its pictures have to be allowed, and what is allowed stays as it is.
    pub is_judged: bool,
    /// Changes that must not change its buffers.
    pub variants: Vec<Variant>,
}

/// A change of a scene that must not change buffers.
#[derive(Debug, Clone, PartialEq)]
pub struct Variant {
    /// What it is called.
    pub name: String,
    /// What is changed.
    pub set: Vec<Override>,
    /// The buffers that must stay as they are, `image` being the picture; empty: all.
    pub buffers: Vec<String>,
    /// The techniques of which that is asked; empty: all.
    pub techniques: Vec<String>,
}

/// `<case>.golden.toml`.
#[derive(Debug, Default, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Settings {
    set: Vec<String>,
    judged: bool,
    variant: Vec<VariantSettings>,
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct VariantSettings {
    name: String,
    set: Vec<String>,
    #[serde(default)]
    buffers: Vec<String>,
    #[serde(default)]
    techniques: Vec<String>,
}

/// All cases of a folder, in the order of their names.
///
/// # Errors
/// When the folder or settings cannot be read, or settings are beside no scene.
pub fn cases(folder: &Path) -> Result<Vec<Case>> {
    let files = files(folder)?;
    let mut cases = Vec::new();
    for file in &files {
        if let Some(case) = file.strip_suffix(SETTINGS) {
            if !files.contains(&format!("{case}.toml")) {
                return Err(Error::new("there is no scene of these settings")
                    .in_file(&folder.join(file))
                    .help(format!("it should be {case}.toml")));
            }
        } else if let Some(name) = file.strip_suffix(".toml") {
            cases.push(case(folder, name)?);
        }
    }
    Ok(cases)
}

/// The cases of a folder that are meant.
///
/// # Errors
/// Those of [`cases`], and when the pattern matches none: then nothing would be checked.
pub fn selected(folder: &Path, selection: &Selection) -> Result<Vec<Case>> {
    let all = cases(folder)?;
    if !all.iter().any(|case| selection.matches(&case.name)) {
        return Err(Error::usage("no golden is selected here")
            .in_file(folder)
            .help("goldens are DIR/TOPIC/CASE.toml; `drapery golden list` names them"));
    }
    Ok(selection.of(all, |case| &case.name))
}

/// The pictures of goldens in a folder, in the order of their names: `topic/case.technique.png`. (A picture without a
/// second dot in its name is a scene's imagery.)
pub(super) fn pictures(folder: &Path) -> Result<Vec<String>> {
    let names = files(folder)?.into_iter();
    Ok(names.filter(|name| name.strip_suffix(".png").is_some_and(|stem| stem.contains('.'))).collect())
}

fn case(folder: &Path, name: &str) -> Result<Case> {
    let path = folder.join(format!("{name}{SETTINGS}"));
    let settings = if path.exists() { settings(&path)? } else { Settings::default() };
    let overrides = |set: Vec<String>| -> Result<Vec<Override>> {
        set.iter().map(|text| Override::parse(text).map_err(|error| error.in_file(&path))).collect()
    };
    let variant = |v: VariantSettings| {
        let VariantSettings { name, set, buffers, techniques } = v;
        overrides(set).map(|set| Variant { name, set, buffers, techniques })
    };
    Ok(Case {
        name: name.to_owned(),
        scene: folder.join(format!("{name}.toml")),
        set: overrides(settings.set)?,
        is_judged: settings.judged,
        variants: settings.variant.into_iter().map(variant).collect::<Result<_>>()?,
    })
}

fn settings(path: &Path) -> Result<Settings> {
    let text = fs::read_to_string(path)
        .map_err(|error| Error::io("this file cannot be read", error).in_file(path))?;
    toml::from_str(&text)
        .map_err(|error| Error::new(error.to_string().trim_end()).caused_by(error).in_file(path))
}

/// The files in the folders of a folder, as `topic/name`, sorted.
fn files(folder: &Path) -> Result<Vec<String>> {
    let mut names = Vec::new();
    for topic in names_in(folder)? {
        let topic_folder = folder.join(&topic);
        if topic_folder.is_dir() && !topic.starts_with('.') {
            names.extend(names_in(&topic_folder)?.into_iter().map(|name| format!("{topic}/{name}")));
        }
    }
    names.sort_unstable();
    Ok(names)
}

fn names_in(folder: &Path) -> Result<Vec<String>> {
    let refuse = |error: std::io::Error| {
        let help = match error.kind() {
            std::io::ErrorKind::NotFound => {
                "goldens are in the folder `golden` of drapery's repository: call this in its root, or name the folder: --dir PATH"
            }
            _ => "check the folder's permissions",
        };
        Error::io("this golden folder cannot be read", error).in_file(folder).help(help)
    };
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).map_err(refuse)? {
        let name = entry.map_err(refuse)?.file_name();
        names.push(name.into_string().map_err(|_| refuse(std::io::Error::other("a name in it is no text")))?);
    }
    Ok(names)
}
