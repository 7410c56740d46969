//! The hashes of all goldens, in one file.

use crate::error::{Error, Result};
use std::fmt::Write;
use std::io;
use std::path::Path;

/// The manifest's name in the golden folder.
pub const MANIFEST: &str = "manifest.toml";

/// The version of its layout.
const SCHEMA: u32 = 1;

/// What is known of all goldens, in the order of case and technique.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Manifest(Vec<Entry>);

/// What is known of one picture and its buffers.
#[derive(Debug, Clone, PartialEq, Eq, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entry {
    /// `topic/case`.
    pub case: String,
    /// The technique's name.
    pub technique: String,
    /// Columns and rows.
    pub size: (usize, usize),
    /// From the first stage to the last, the picture.
    pub hashes: Vec<BufferHash>,
}

/// A buffer's pixels.
#[derive(Debug, Clone, PartialEq, Eq, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BufferHash {
    /// Its name; the picture's is `image`.
    pub buffer: String,
    /// BLAKE3 over its values in row order, in hexadecimal.
    pub blake3: String,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    schema: u32,
    #[serde(default)]
    golden: Vec<Entry>,
}

impl Manifest {
    /// Reads the manifest of a folder; one that is missing is empty.
    ///
    /// # Errors
    /// When it cannot be read or understood, or names a golden twice.
    pub fn read(folder: &Path) -> Result<Self> {
        let path = folder.join(MANIFEST);
        match std::fs::read_to_string(&path) {
            Ok(text) => Self::parse(&text).map_err(|error| error.in_file(&path)),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Self::default()),
            Err(error) => Err(Error::io("this manifest cannot be read", error).in_file(&path)),
        }
    }

    fn parse(text: &str) -> Result<Self> {
        let document: Document = toml::from_str(text)
            .map_err(|error| Error::new(error.to_string().trim_end()).caused_by(error))?;
        if document.schema != SCHEMA {
            return Err(Error::unsupported(format!("this manifest has the schema {}", document.schema))
                .help(format!("this version reads {SCHEMA}")));
        }
        let mut manifest = Self::default();
        for entry in document.golden {
            if manifest.find(&entry.case, &entry.technique).is_some() {
                return Err(Error::new(format!("{} by {} is there twice", entry.case, entry.technique)));
            }
            manifest.set(entry);
        }
        Ok(manifest)
    }

    /// All entries, in the order of case and technique.
    pub fn entries(&self) -> &[Entry] {
        &self.0
    }

    /// A case's entry by a technique.
    pub fn find(&self, case: &str, technique: &str) -> Option<&Entry> {
        self.place(case, technique).ok().map(|at| &self.0[at])
    }

    /// Puts an entry in the place of what was known.
    pub(super) fn set(&mut self, entry: Entry) {
        match self.place(&entry.case, &entry.technique) {
            Ok(at) => self.0[at] = entry,
            Err(at) => self.0.insert(at, entry),
        }
    }

    /// Leaves out the entries that are not to stay.
    pub(super) fn retain(&mut self, stays: impl Fn(&Entry) -> bool) {
        self.0.retain(stays);
    }

    fn place(&self, case: &str, technique: &str) -> std::result::Result<usize, usize> {
        self.0.binary_search_by(|entry| (&*entry.case, &*entry.technique).cmp(&(case, technique)))
    }

    /// The file's text.
    pub(super) fn text(&self) -> String {
        let mut text = format!(
            "# What the buffers of each golden hash to, from the first stage to the picture: BLAKE3 over the pixel values.\n\
             # Written by `drapery golden bless`.\n\nschema = {SCHEMA}\n"
        );
        for entry in &self.0 {
            let (width, height) = entry.size;
            let case = toml::Value::String(entry.case.clone());
            let technique = &entry.technique;
            // Writing to a string does not fail.
            let _ = write!(
                text,
                "\n[[golden]]\ncase = {case}\ntechnique = \"{technique}\"\nsize = [{width}, {height}]\nhashes = [\n"
            );
            for BufferHash { buffer, blake3 } in &entry.hashes {
                let _ = writeln!(text, "  {{ buffer = \"{buffer}\", blake3 = \"{blake3}\" }},");
            }
            text.push_str("]\n");
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(case: &str, technique: &str) -> Entry {
        let hash = |buffer: &str| BufferHash { buffer: buffer.into(), blake3: "00ff".into() };
        Entry {
            case: case.into(),
            technique: technique.into(),
            size: (4, 3),
            hashes: vec![hash("depth"), hash("image")],
        }
    }

    #[test]
    fn what_is_written_is_read_back_in_order() {
        let mut manifest = Manifest::default();
        for (case, technique) in [("b/x", "t"), ("a/\"odd\"", "t"), ("b/x", "s"), ("b/x", "t")] {
            manifest.set(entry(case, technique));
        }
        let names: Vec<_> = manifest.entries().iter().map(|e| (&*e.case, &*e.technique)).collect();
        assert_eq!(names, [("a/\"odd\"", "t"), ("b/x", "s"), ("b/x", "t")]);
        assert_eq!(Manifest::parse(&manifest.text()).unwrap(), manifest);
        assert!(manifest.find("b/x", "s").is_some() && manifest.find("b", "s").is_none());
    }

    #[test]
    fn another_schema_a_golden_twice_and_what_is_no_manifest_are_refused() {
        assert!(Manifest::parse("schema = 2").unwrap_err().what().contains("schema 2"));
        assert!(Manifest::parse("schema = 1\nsize = 3").unwrap_err().what().contains("unknown field"));
        let mut twice = Manifest::default();
        twice.set(entry("a", "t"));
        let again = twice.text().split_once("\n[[golden]]").map(|(_, rest)| format!("[[golden]]{rest}"));
        let text = twice.text() + &again.unwrap();
        assert_eq!(Manifest::parse(&text).unwrap_err().what(), "a by t is there twice");
    }
}
