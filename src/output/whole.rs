//! One file that appears whole or not at all: on any failure the path is as it was.

use super::part::{self, Part};
use crate::error::{Error, Result};
use std::ffi::OsStr;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Writes a file beside its place and renames it, so that no reader ever sees a part of it. (A device or a pipe, which has no
/// place, is written to.)
///
/// ```
/// use std::io::Write;
/// let folder = tempfile::tempdir().unwrap();
/// let path = folder.path().join("result.json");
/// drapery::output::write_whole(&path, |w| writeln!(w, "{{}}")).unwrap();
/// assert_eq!(std::fs::read_to_string(&path).unwrap(), "{}\n");
/// ```
///
/// # Errors
/// When the file cannot be made or `write` fails; says which file. What was there before is still there then.
pub fn write_whole(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<()> {
    let refuse = |error: io::Error| Error::io("this file cannot be written", error).in_file(path);
    // What a link leads to is replaced, not the link; a device or a pipe is written to.
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    if fs::metadata(&target).is_ok_and(|found| !found.is_file() && !found.is_dir()) {
        return OpenOptions::new()
            .write(true)
            .open(&target)
            .and_then(|file| fill(file, write))
            .map_err(refuse);
    }
    let (part, name) = beside(&target).map_err(refuse)?;
    let staged = part.files().join(name);
    File::create_new(&staged)
        .and_then(|file| fill(file, write))
        .and_then(|()| fs::rename(&staged, &target))
        .map_err(refuse)
}

/// Writes a new file through a buffer.
pub(super) fn fill(file: File, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut buffered = BufWriter::new(file);
    write(&mut buffered)?;
    buffered.flush()
}

/// A part in the folder of a file, and the file's name. What runs that were killed left there is cleared.
fn beside(path: &Path) -> io::Result<(Part, &OsStr)> {
    let name = path.file_name().ok_or_else(|| io::Error::other("the path names no file"))?;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let words = name.to_string_lossy();
    part::clear(folder, &words);
    Part::new(folder, &words).map(|part| (part, name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_write_leaves_what_was_there_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        fs::write(&path, "before").unwrap();
        let result = write_whole(&path, |w| {
            w.write_all(b"half")?;
            Err(io::Error::other("no more"))
        });
        assert!(result.unwrap_err().to_string().contains("a.txt: this file cannot be written: no more"));
        assert_eq!(fs::read_to_string(&path).unwrap(), "before");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_keeps_leading_to_what_was_written_and_a_device_stays_one() {
        let folder = tempfile::tempdir().unwrap();
        let (link, target) = (folder.path().join("link"), folder.path().join("target"));
        fs::write(&target, "before").unwrap();
        std::os::unix::fs::symlink(&target, &link).unwrap();
        write_whole(&link, |w| w.write_all(b"after")).unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read_to_string(&target).unwrap(), "after");
        write_whole(Path::new("/dev/null"), |w| w.write_all(b"gone")).unwrap();
        assert!(!fs::metadata("/dev/null").unwrap().is_file());
    }

    #[test]
    fn a_whole_write_replaces_what_was_there() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        fs::write(&path, "before").unwrap();
        write_whole(&path, |w| w.write_all(b"after")).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "after");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_folder_that_is_missing_is_named() {
        let error = write_whole(Path::new("no/such/folder/a.txt"), |_| Ok(())).unwrap_err();
        assert!(error.to_string().starts_with("no/such/folder/a.txt: "), "{error}");
    }
}
