//! What a program drew from a bundle: a picture, or a folder with the picture and buffers.

use crate::compare::image::Image;
use crate::compare::read::Array;
use crate::error::{Error, Result};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A frame that is handed in.
#[derive(Debug)]
pub struct Submitted {
    /// The picture's file.
    pub path: PathBuf,
    /// The picture.
    pub picture: Image,
    /// Buffers by their names: numbers as they are, codes undivided.
    pub buffers: BTreeMap<String, Image>,
    /// Of each pixel, whether it is not to be looked at.
    pub ignored: Option<Vec<bool>>,
}

impl Submitted {
    /// A picture alone.
    pub fn picture(picture: Image, path: PathBuf) -> Self {
        Self { path, picture, buffers: BTreeMap::new(), ignored: None }
    }

    /// Reads a picture, or of a folder the picture `T.png` (or `.exr`, `.npy`) and those of the buffers `T.NAME.npy` that are judged.
    ///
    /// # Errors
    /// When one is missing or cannot be read.
    pub fn read(path: &Path, technique: &str, is_judged: &dyn Fn(&str) -> bool) -> Result<Self> {
        let picture = Self::picture_in(path, technique)?;
        let buffers = if path.is_dir() { buffers(path, technique, is_judged)? } else { BTreeMap::new() };
        Ok(Self { picture: Image::read(&picture)?, path: picture, buffers, ignored: None })
    }

    /// The file of the picture: the path itself, or in a folder the technique's.
    ///
    /// # Errors
    /// When the folder has none.
    pub fn picture_in(path: &Path, technique: &str) -> Result<PathBuf> {
        if !path.is_dir() {
            return Ok(path.into());
        }
        let names = ["png", "exr", "npy"].map(|end| format!("{technique}.{end}"));
        names.iter().map(|name| path.join(name)).find(|file| file.exists()).ok_or_else(|| {
            Error::new(format!("this folder has no picture {}", names.join(" or ")))
                .in_file(path)
                .help(format!("call the frame {}, or name the picture itself", names[0]))
        })
    }
}

fn buffers(
    folder: &Path,
    technique: &str,
    is_judged: &dyn Fn(&str) -> bool,
) -> Result<BTreeMap<String, Image>> {
    let refuse = |error| Error::io("this folder cannot be read", error).in_file(folder);
    let mut buffers = BTreeMap::new();
    for entry in std::fs::read_dir(folder).map_err(refuse)? {
        let path = entry.map_err(refuse)?.path();
        let file = path.file_name().and_then(|name| name.to_str());
        let inner =
            file.and_then(|file| file.strip_prefix(technique)?.strip_prefix('.')?.strip_suffix(".npy"));
        if let Some(name) = inner.filter(|name| is_judged(name)) {
            let read = std::fs::read(&path).map_err(|error| Error::io("this buffer cannot be read", error));
            let plane = read.and_then(|bytes| Array::of(&bytes)?.plane());
            buffers.insert(name.to_owned(), plane.map_err(|error| error.in_file(&path))?);
        }
    }
    Ok(buffers)
}
