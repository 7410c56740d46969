//! Picture files -> values in units of 1. What a file is shows in its first bytes, whatever its name.
//!
//! Values are compared as they are stored: no colour management, and no division by alpha where a format asks for
//! colours multiplied by it (EXR).

mod exr;
mod npy;
mod png;
mod size;

pub(super) use npy::Array;
pub(super) use png::codes;

use super::image::Image;
use crate::error::{Error, Result};
use std::io;
use std::path::Path;

impl Image {
    /// Reads a PNG, EXR or .npy file.
    ///
    /// # Errors
    /// When it is missing or cannot be read, or is none of these.
    pub fn read(path: &Path) -> Result<Self> {
        let bytes = std::fs::read(path).map_err(|error| unreadable(error, path))?;
        Self::decode(&bytes).map_err(|error| error.in_file(path))
    }

    /// The picture in a PNG, EXR or .npy file's bytes.
    ///
    /// # Errors
    /// When they are none of these.
    pub fn decode(bytes: &[u8]) -> Result<Self> {
        if bytes.starts_with(png::MAGIC) {
            png::decode(bytes)
        } else if bytes.starts_with(exr::MAGIC) {
            exr::decode(bytes)
        } else if bytes.starts_with(npy::MAGIC) {
            npy::decode(bytes)
        } else if bytes.starts_with(b"PK\x03\x04") {
            Err(Error::unsupported("this is an archive of several files, as .npz of several arrays is one")
                .help("save the one array as .npy (numpy.save), or unpack the archive and name the picture"))
        } else {
            Err(Error::unsupported("this is no picture that can be compared")
                .help("PNG, EXR and .npy files can be"))
        }
    }
}

fn unreadable(error: io::Error, path: &Path) -> Error {
    let is_missing = error.kind() == io::ErrorKind::NotFound;
    let error = Error::io("this picture cannot be read", error).in_file(path);
    if is_missing { error.reworded(|_| "this picture is missing".into()) } else { error }
}

/// Whether two paths lead to one file: by whatever names and links, not by equal bytes.
///
/// # Errors
/// When one of them is missing or cannot be looked at.
pub fn same_file(a: &Path, b: &Path) -> Result<bool> {
    let identity = |path: &Path| identity(path).map_err(|error| unreadable(error, path));
    Ok(identity(a)? == identity(b)?)
}

/// What no other file has: its device and its number there.
#[cfg(unix)]
fn identity(path: &Path) -> io::Result<impl PartialEq + use<>> {
    use std::os::unix::fs::MetadataExt;
    let found = std::fs::metadata(path)?;
    Ok((found.dev(), found.ino()))
}

/// The path without links; hard links are not seen through here.
#[cfg(not(unix))]
fn identity(path: &Path) -> io::Result<impl PartialEq + use<>> {
    std::fs::canonicalize(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_picture_is_refused_and_a_missing_one_is_called_missing() {
        let error = Image::decode(b"GIF89a").unwrap_err();
        assert!(error.what().contains("no picture that can be compared"), "{error}");
        assert!(Image::decode(b"PK\x03\x04").unwrap_err().what().contains(".npz"));
        let error = Image::read(Path::new("no/such.png")).unwrap_err();
        assert_eq!(error.to_string(), "no/such.png: this picture is missing");
    }

    /// Small valid files of every format.
    fn valid_files() -> Vec<Vec<u8>> {
        let mut png = Vec::new();
        let picture = crate::buffer::Buffer::from_values(5, 3, vec![[9, 8, 7, 200]; 15]);
        crate::output::write_png(&picture, &mut png).unwrap();
        let head = "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2), }";
        let mut npy = b"\x93NUMPY\x01\x00".to_vec();
        npy.extend((head.len() as u16).to_le_bytes());
        npy.extend(head.bytes());
        npy.extend([0; 8]);
        vec![png, npy, exr::tests::example()]
    }

    #[test]
    #[ignore = "writes the seeds for fuzzing into $DRAPERY_SEEDS"]
    fn seeds_for_fuzzing_pictures() {
        for (target, seed) in ["picture_png", "picture_npy", "picture_exr"].into_iter().zip(valid_files()) {
            crate::seeds::plant(target, [seed]);
        }
    }

    proptest::proptest! {
        #![proptest_config(proptest::prelude::ProptestConfig::with_cases(512))]

        #[test]
        fn damaged_files_are_refused_or_read_and_nothing_worse(
            which in 0..3_usize,
            changes in proptest::collection::vec((proptest::prelude::any::<u32>(), proptest::prelude::any::<u8>()), 0..6),
            cut in proptest::option::of(proptest::prelude::any::<u32>()),
        ) {
            let mut file = valid_files().swap_remove(which);
            for (at, byte) in changes {
                let at = at as usize % file.len();
                file[at] = byte;
            }
            if let Some(cut) = cut {
                file.truncate(cut as usize % file.len());
            }
            if let Err(error) = Image::decode(&file) {
                assert!(!error.is_internal(), "{error}");
            }
        }
    }

    #[test]
    fn valid_files_are_read() {
        for file in valid_files() {
            Image::decode(&file).unwrap();
        }
    }

    #[test]
    fn a_file_is_the_same_by_every_name_and_link_and_not_by_its_bytes() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::write(at("a"), "x").unwrap();
        std::fs::write(at("twin"), "x").unwrap();
        std::fs::hard_link(at("a"), at("hard")).unwrap();
        assert!(same_file(&at("a"), &at("./a")).unwrap());
        assert!(!same_file(&at("a"), &at("twin")).unwrap());
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(at("a"), at("soft")).unwrap();
            assert!(same_file(&at("hard"), &at("soft")).unwrap());
        }
        assert!(
            same_file(&at("a"), &at("none"))
                .unwrap_err()
                .to_string()
                .contains("none: this picture is missing")
        );
    }
}
