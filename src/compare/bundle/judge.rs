//! What a bundle allows, read.

use super::document::{self, AlternativeFiles, Document, HypothesisFiles, StageFiles};
use super::file::document;
use super::manifest::Manifest;
use super::names::{self, names};
use super::table::{self, Size};
use crate::compare::allowed::{Allowed, Alternative, Hypothesis, Stage, StageRange};
use crate::compare::judgement::{Gates, Judgement};
use crate::compare::read::same_file;
use crate::compare::read::{Array, codes};
use crate::compare::submitted::Submitted;
use crate::error::{Error, Result};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A judge: what a bundle allows, and what it calls things.
///
/// ```
/// use drapery::compare::{Gates, Judge};
/// # let folder = tempfile::tempdir().unwrap();
/// # let bundle = folder.path();
/// let error = Judge::read(bundle).unwrap_err();
/// assert!(error.to_string().contains("manifest.json: this file is missing"));
/// ```
#[derive(Debug)]
pub struct Judge {
    manifest: Manifest,
    allowed: Allowed,
    technique: String,
    picture: String,
}

impl Judge {
    /// Reads a bundle that `drapery export` wrote.
    ///
    /// # Errors
    /// When a file of it is missing, another than the bundle was written with, of another version, or wrong.
    pub fn read(folder: &Path) -> Result<Self> {
        let manifest = Manifest::read(folder)?;
        let (bytes, path) = manifest.file(document::NAME)?;
        let document: Document = document(&bytes, &path, document::SCHEMA)?;
        if document.hypotheses.is_empty() {
            return Err(Error::new("it has no hypothesis: no picture is allowed").in_file(&path));
        }
        if !manifest.has(&document.picture) {
            return Err(
                Error::new(format!("the bundle has no picture `{}`", document.picture)).in_file(&path)
            );
        }
        let size = Size { width: document.width, height: document.height };
        let reader = Reader { manifest: &manifest, size };
        let hypotheses =
            document.hypotheses.iter().map(|files| reader.hypothesis(files)).collect::<Result<_>>()?;
        let stages = document.stages.iter().map(|files| reader.stage(files, &path)).collect::<Result<_>>()?;
        let features = reader.table(&document.features, table::runs)?;
        let alternatives =
            document.alternatives.iter().map(|files| reader.alternative(files)).collect::<Result<_>>()?;
        let Size { width, height } = size;
        let allowed = Allowed { width, height, hypotheses, stages, features, alternatives };
        Ok(Self { allowed, technique: document.technique, picture: document.picture, manifest })
    }

    /// What it allows.
    pub fn allowed(&self) -> &Allowed {
        &self.allowed
    }

    /// The technique.
    pub fn technique(&self) -> &str {
        &self.technique
    }

    /// The reference's own picture.
    pub fn picture(&self) -> PathBuf {
        self.manifest.path(&self.picture)
    }

    /// Reads a frame of its technique: a picture, or a folder with the picture and buffers ([`Submitted::read`]).
    ///
    /// # Errors
    /// When it is missing or cannot be read.
    pub fn frame(&self, path: &Path) -> Result<Submitted> {
        let is_judged = |name: &str| self.allowed.stages.iter().any(|stage| stage.buffer == name);
        Submitted::read(path, &self.technique, &is_judged)
    }

    /// Judges a frame.
    pub fn judge(&self, frame: &Submitted, gates: Gates) -> Judgement {
        Judgement::on(&self.allowed, frame, gates)
    }

    /// What the features are called, by the places of their layer and of themselves in it.
    ///
    /// # Errors
    /// When the file cannot be read.
    pub fn feature_names(&self) -> Result<BTreeMap<(u32, u32), String>> {
        if !self.manifest.has(names::FILE) {
            return Ok(BTreeMap::new());
        }
        Ok(names(&self.manifest.file(names::FILE)?.0))
    }

    /// All of the bundle's files.
    pub fn files(&self) -> impl Iterator<Item = PathBuf> {
        self.manifest.paths()
    }

    /// Whether a file is one of the bundle's own.
    ///
    /// # Errors
    /// When the file cannot be looked at.
    pub fn is_its_own(&self, file: &Path) -> Result<bool> {
        for path in self.files() {
            if same_file(&path, file)? {
                return Ok(true);
            }
        }
        Ok(false)
    }
}

/// Reads the files of a bundle whose picture has a size.
struct Reader<'a> {
    manifest: &'a Manifest,
    size: Size,
}

impl Reader<'_> {
    fn table<T>(&self, name: &str, read: impl Fn(&[u8], Size) -> Result<T>) -> Result<T> {
        let (bytes, path) = self.manifest.file(name)?;
        read(&bytes, self.size).map_err(|error| error.in_file(&path))
    }

    fn hypothesis(&self, files: &HypothesisFiles) -> Result<Hypothesis> {
        let HypothesisFiles { name, lo, hi, choices, extremes, says } = files;
        let (low, high) = (self.table(lo, picture)?, self.table(hi, picture)?);
        let is_upright = |pair: (&[u16; 4], &[u16; 4])| pair.0.iter().zip(pair.1).all(|(lo, hi)| lo <= hi);
        if let Some(pixel) = low.iter().zip(&high).position(|pair| !is_upright(pair)) {
            return Err(Error::new(format!("pixel {pixel} is upside down: `{hi}` is below `{lo}` there"))
                .in_file(&self.manifest.path(hi)));
        }
        let choices = self.table(choices, table::choices)?;
        let extremes = self.table(extremes, table::extremes)?;
        Ok(Hypothesis { name: name.clone(), says: says.clone(), lo: low, hi: high, choices, extremes })
    }

    fn alternative(&self, files: &AlternativeFiles) -> Result<Alternative> {
        let AlternativeFiles { choice, hypothesis } = files;
        Ok(Alternative { choice: choice.clone(), hypothesis: self.hypothesis(hypothesis)? })
    }

    fn stage(&self, files: &StageFiles, document: &Path) -> Result<Stage> {
        let range = match (&files.lo, &files.hi, &files.one_of) {
            (Some(lo), Some(hi), None) => self.between(lo, hi)?,
            (None, None, Some(one_of)) => {
                StageRange::OneOf(self.table(one_of, |bytes, _| table::one_of(bytes))?)
            }
            _ => {
                let what = format!("the stage `{}` has neither `lo` and `hi` nor `one-of`", files.buffer);
                return Err(Error::new(what).in_file(document));
            }
        };
        Ok(Stage { buffer: files.buffer.clone(), range })
    }

    fn between(&self, lo: &str, hi: &str) -> Result<StageRange> {
        let (low, high) = (self.table(lo, plane)?, self.table(hi, plane)?);
        let is_wrong = |(lo, hi): (&f64, &f64)| lo > hi || lo.is_nan() || hi.is_nan();
        let wrong =
            low.values.len() != high.values.len() || low.values.iter().zip(&high.values).any(is_wrong);
        if wrong {
            return Err(Error::new(format!(
                "`{lo}` and `{hi}` are no lower and upper ends of the same values"
            ))
            .in_file(&self.manifest.path(hi)));
        }
        Ok(StageRange::Between { components: low.components, lo: low.values, hi: high.values })
    }
}

/// The numbers of a buffer.
struct Numbers {
    components: usize,
    values: Vec<f64>,
}

fn plane(bytes: &[u8], size: Size) -> Result<Numbers> {
    let plane = Array::of(bytes)?.plane()?;
    // A buffer of samples is so many times as wide and as high.
    let finer = (plane.width() / size.width.max(1)).max(1);
    let finer = Size { width: size.width.saturating_mul(finer), height: size.height.saturating_mul(finer) };
    check_size((plane.width(), plane.height()), finer)?;
    Ok(Numbers { components: plane.channels(), values: plane.values().collect() })
}

fn picture(bytes: &[u8], size: Size) -> Result<Vec<[u16; 4]>> {
    let (width, height, codes) = codes(bytes)?;
    check_size((width, height), size)?;
    Ok(codes)
}

fn check_size(found: (usize, usize), size: Size) -> Result<()> {
    if found != (size.width, size.height) {
        return Err(Error::new(format!(
            "it has {} x {} pixels, and `{}` says {} x {}",
            found.0,
            found.1,
            document::NAME,
            size.width,
            size.height
        )));
    }
    Ok(())
}
