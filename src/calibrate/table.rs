//! Tables of devices: what was found as TOML, and TOML as changes of a scene.

use crate::error::{Error, Result};
use crate::parameter::Settings;
use crate::scene::Device;
use std::fmt::Write;

/// Devices whose tables ship with the program: name and text.
pub const KNOWN: [(&str, &str); 5] = [
    ("lavapipe", LAVAPIPE),
    ("llvmpipe", LAVAPIPE),
    ("swiftshader", include_str!("tables/swiftshader.toml")),
    ("gpu-8bit", include_str!("tables/gpu-8bit.toml")),
    ("exact", include_str!("tables/exact.toml")),
];

const LAVAPIPE: &str = include_str!("tables/lavapipe.toml");

/// A key of `[device]` and how it was found.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Finding {
    /// The key.
    pub(super) key: &'static str,
    /// Its value as TOML.
    pub(super) value: String,
    /// What was seen.
    pub(super) seen: String,
}

/// The text of a table: what was found, each key behind what was seen, and what else there is to say.
pub(super) fn text(findings: &[Finding], notes: &[String]) -> String {
    let mut text = String::from("# Made by `drapery calibrate read`.\n");
    for note in notes {
        let _ = writeln!(text, "# {note}");
    }
    text.push_str("[device]\nprecision = \"f32\"\n");
    for Finding { key, value, seen } in findings {
        let _ = writeln!(text, "# {seen}\n{key} = {value}");
    }
    text
}

/// The changes of a scene (`device.KEY=VALUE`) that a device's table stands for.
///
/// # Errors
/// When the text is no TOML, has no table `device`, or more than that, or keys that a device does not have.
pub fn changes(text: &str) -> Result<Vec<String>> {
    let refuse = |what: String| {
        Error::new(what).help("a device's file is a table [device] with keys as in a scene file, as `drapery calibrate read` prints it")
    };
    let document: toml::Table = text
        .parse()
        .map_err(|error: toml::de::Error| refuse(format!("this is no TOML: {}", error.message())))?;
    if let Some(key) = document.keys().find(|key| *key != Device::NAME) {
        return Err(refuse(format!("`{key}` is nothing of a device")));
    }
    let Some(toml::Value::Table(device)) = document.get(Device::NAME) else {
        return Err(refuse("there is no table `device` in it".into()));
    };
    if let Some(key) = device.keys().find(|key| Device::TABLE.key(key).is_none()) {
        return Err(refuse(format!("a device has no key `{key}`")));
    }
    Ok(device.iter().map(|(key, value)| format!("{}.{key}={value}", Device::NAME)).collect())
}
