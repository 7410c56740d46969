//! The files of one run, which appear together or not at all.

use super::part::{self, Part};
use super::whole::fill;
use crate::error::{Error, Result};
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Files of one folder that appear together: first all are written into a folder of their own, then they are moved to
/// their places. A batch that is dropped leaves nothing.
///
/// The folder itself appears with the files where there was none. Files of the same names are replaced, others stay.
///
/// ```
/// let place = tempfile::tempdir().unwrap();
/// let out = place.path().join("out");
/// let mut batch = drapery::output::Batch::into(&out).unwrap();
/// batch.stage("a.txt", |w| w.write_all(b"a")).unwrap();
/// batch.stage("b.txt", |w| w.write_all(b"b")).unwrap();
/// assert!(!out.exists());
/// batch.commit().unwrap();
/// assert_eq!(std::fs::read_to_string(out.join("b.txt")).unwrap(), "b");
/// ```
#[derive(Debug)]
pub struct Batch {
    folder: PathBuf,
    staging: Part,
    /// Where the files go that are staged now: a folder of `folder` with a slash behind it, or nothing.
    within: String,
    files: Vec<StagedFile>,
}

/// A file of a batch, as it was written.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
pub struct StagedFile {
    /// Its name, with the folders before it.
    pub name: String,
    /// Its size.
    pub bytes: u64,
    /// BLAKE3 of its bytes, in hexadecimal digits.
    pub blake3: String,
}

impl Batch {
    /// A batch for a folder, which need not exist yet. What runs that were killed left there is cleared.
    ///
    /// # Errors
    /// When something else has the folder's name, or nothing can be written there: known before the work is done.
    pub fn into(folder: &Path) -> Result<Self> {
        let refuse =
            |error: io::Error| Error::io("this output folder cannot be written", error).in_file(folder);
        let staging = match fs::metadata(folder) {
            Ok(found) if found.is_dir() => staging(folder, folder),
            Ok(_) => Err(io::Error::other("it is a file")),
            Err(error) if error.kind() == io::ErrorKind::NotFound => beside(folder),
            Err(error) => Err(error),
        };
        let staging = staging.map_err(refuse)?;
        Ok(Self { folder: folder.into(), staging, within: String::new(), files: Vec::new() })
    }

    /// Files that are staged from now on lie in this folder of the batch's (`a/b`; empty: in the batch's own).
    pub fn enter(&mut self, folder: &str) {
        self.within = if folder.is_empty() { String::new() } else { format!("{folder}/") };
    }

    /// What has been staged in the folder that was entered, as seen from there, in the order of the names.
    pub fn staged(&self) -> Vec<StagedFile> {
        let here = |file: &StagedFile| {
            let name = file.name.strip_prefix(&self.within)?.to_owned();
            Some(StagedFile { name, ..file.clone() })
        };
        let mut files: Vec<StagedFile> = self.files.iter().filter_map(here).collect();
        files.sort_by(|a, b| a.name.cmp(&b.name));
        files
    }

    /// Writes a file of this name, to appear with the others; the name may begin with folders.
    ///
    /// # Errors
    /// When it cannot be written, or a folder has its name; says which file.
    pub fn stage(&mut self, name: &str, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<()> {
        let name = format!("{}{name}", self.within);
        let path = self.folder.join(&name);
        let refuse = |error: io::Error| Error::io("this file cannot be written", error).in_file(&path);
        if path.is_dir() {
            return Err(refuse(io::Error::other("a folder has this name")));
        }
        if self.files.iter().any(|known| known.name == name) {
            return Err(Error::internal("one run writes this file twice").in_file(&path));
        }
        let staged = self.staging.files().join(&name);
        let mut written = Hashed::default();
        parent(&staged)
            .map_or(Ok(()), fs::create_dir_all)
            .and_then(|()| File::create_new(staged))
            .and_then(|file| fill(file, |to| write(&mut HashedWriter { to, written: &mut written })))
            .map_err(refuse)?;
        let blake3 = written.hasher.finalize().to_hex().to_string();
        self.files.push(StagedFile { name, bytes: written.bytes, blake3 });
        Ok(())
    }

    /// Moves all files to their places.
    ///
    /// # Errors
    /// When the system refuses a move. Moves in one folder that could be written a moment ago hardly fail; where one
    /// does, those before it have been made, and each file is still whole.
    pub fn commit(self) -> Result<()> {
        let refuse =
            |path: &Path, error: io::Error| Error::io("this cannot be put in its place", error).in_file(path);
        if self.folder.is_dir() {
            for StagedFile { name, .. } in &self.files {
                let place = self.folder.join(name);
                parent(&place)
                    .map_or(Ok(()), fs::create_dir_all)
                    .and_then(|()| fs::rename(self.staging.files().join(name), &place))
                    .map_err(|error| refuse(&place, error))?;
            }
            return Ok(());
        }
        parent(&self.folder)
            .map_or(Ok(()), fs::create_dir_all)
            .and_then(|()| fs::rename(self.staging.files(), &self.folder))
            .map_err(|error| refuse(&self.folder, error))
    }
}

/// What is told of the bytes that have been written.
#[derive(Default)]
struct Hashed {
    hasher: blake3::Hasher,
    bytes: u64,
}

/// Writes on, and keeps count of what it writes.
struct HashedWriter<'a> {
    to: &'a mut dyn Write,
    written: &'a mut Hashed,
}

impl Write for HashedWriter<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.to.write(bytes)?;
        self.written.hasher.update(&bytes[..count]);
        self.written.bytes += count as u64;
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}

/// A staging folder for a folder that does not exist, in the nearest folder above it that does.
fn beside(folder: &Path) -> io::Result<Part> {
    folder.file_name().ok_or_else(|| io::Error::other("the path names no folder"))?;
    let above = folder.ancestors().skip(1).map(or_here);
    let nearest = above.into_iter().find(|path| path.exists());
    staging(nearest.unwrap_or(Path::new(".")), folder)
}

/// A staging folder for a folder. Earlier runs may have begun when fewer of the folders above it were there.
fn staging(within: &Path, folder: &Path) -> io::Result<Part> {
    let name = folder.file_name().map_or("batch".into(), |name| name.to_string_lossy());
    folder.ancestors().map(or_here).for_each(|above| part::clear(above, &name));
    Part::new(within, &name)
}

fn parent(folder: &Path) -> Option<&Path> {
    folder.parent().map(or_here)
}

/// The current folder where the path is empty.
fn or_here(path: &Path) -> &Path {
    if path.as_os_str().is_empty() { Path::new(".") } else { path }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names_in(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    fn stage(batch: &mut Batch, name: &str) {
        batch.stage(name, |w| w.write_all(name.as_bytes())).unwrap();
    }

    #[test]
    fn a_failing_second_file_leaves_no_first_file_and_no_folder() {
        let place = tempfile::tempdir().unwrap();
        let out = place.path().join("deep/out");
        let mut batch = Batch::into(&out).unwrap();
        stage(&mut batch, "a");
        let error = batch.stage("b", |w| {
            w.write_all(b"half")?;
            Err(io::Error::other("no more"))
        });
        let said = error.unwrap_err().to_string();
        assert!(said.ends_with("b: this file cannot be written: no more"), "{said}");
        drop(batch);
        assert_eq!(names_in(place.path()), [""; 0]);
    }

    #[test]
    fn a_batch_that_is_dropped_leaves_what_was_there() {
        let place = tempfile::tempdir().unwrap();
        fs::write(place.path().join("a"), "before").unwrap();
        let mut batch = Batch::into(place.path()).unwrap();
        stage(&mut batch, "a");
        drop(batch);
        assert_eq!(fs::read_to_string(place.path().join("a")).unwrap(), "before");
        assert_eq!(names_in(place.path()), ["a"]);
    }

    #[test]
    fn files_are_replaced_and_others_stay() {
        let place = tempfile::tempdir().unwrap();
        fs::write(place.path().join("a"), "before").unwrap();
        fs::write(place.path().join("other"), "").unwrap();
        let mut batch = Batch::into(place.path()).unwrap();
        stage(&mut batch, "a");
        stage(&mut batch, "b");
        batch.commit().unwrap();
        assert_eq!(names_in(place.path()), ["a", "b", "other"]);
        assert_eq!(fs::read_to_string(place.path().join("a")).unwrap(), "a");
    }

    #[test]
    fn folders_that_are_missing_appear_with_the_files() {
        let place = tempfile::tempdir().unwrap();
        let out = place.path().join("deep/er/out/");
        let mut batch = Batch::into(&out).unwrap();
        stage(&mut batch, "a");
        batch.commit().unwrap();
        assert_eq!(names_in(&out), ["a"]);
        assert_eq!(names_in(place.path()), ["deep"]);
    }

    #[test]
    fn a_name_may_begin_with_folders() {
        for is_there in [true, false] {
            let place = tempfile::tempdir().unwrap();
            let out = place.path().join("out");
            if is_there {
                fs::create_dir(&out).unwrap();
            }
            let mut batch = Batch::into(&out).unwrap();
            stage(&mut batch, "topic/a");
            stage(&mut batch, "b");
            batch.commit().unwrap();
            assert_eq!(fs::read_to_string(out.join("topic/a")).unwrap(), "topic/a");
            assert_eq!(names_in(&out), ["b", "topic"]);
        }
    }

    #[test]
    fn what_is_told_of_files_is_of_their_bytes_and_of_the_folder_that_was_entered() {
        let place = tempfile::tempdir().unwrap();
        let mut batch = Batch::into(&place.path().join("out")).unwrap();
        stage(&mut batch, "z");
        batch.enter("topic/a");
        // In pieces, as tables are written.
        batch.stage("two", |w| w.write_all(b"t").and_then(|()| w.write_all(b"wo"))).unwrap();
        stage(&mut batch, "one");
        let told: Vec<(String, u64)> =
            batch.staged().into_iter().map(|file| (file.name, file.bytes)).collect();
        assert_eq!(told, [("one".to_owned(), 3), ("two".to_owned(), 3)]);
        assert_eq!(batch.staged()[1].blake3, blake3::hash(b"two").to_hex().to_string());
        batch.enter("");
        let names: Vec<String> = batch.staged().into_iter().map(|file| file.name).collect();
        assert_eq!(names, ["topic/a/one", "topic/a/two", "z"]);
        batch.commit().unwrap();
        assert_eq!(fs::read_to_string(place.path().join("out/topic/a/two")).unwrap(), "two");
    }

    #[test]
    fn a_folder_that_appears_meanwhile_is_used() {
        let place = tempfile::tempdir().unwrap();
        let out = place.path().join("out");
        let mut batch = Batch::into(&out).unwrap();
        stage(&mut batch, "a");
        fs::create_dir(&out).unwrap();
        fs::write(out.join("other"), "").unwrap();
        batch.commit().unwrap();
        assert_eq!(names_in(&out), ["a", "other"]);
        assert_eq!(names_in(place.path()), ["out"]);
    }

    #[test]
    fn what_is_no_folder_is_refused_before_any_work() {
        let place = tempfile::tempdir().unwrap();
        let file = place.path().join("file");
        fs::write(&file, "").unwrap();
        for wrong in [file.clone(), file.join("below"), PathBuf::new(), "missing/..".into()] {
            let error = Batch::into(&wrong).unwrap_err();
            assert!(error.what().starts_with("this output folder cannot be written"), "{error}");
            assert!(!error.is_internal());
        }
        assert_eq!(names_in(place.path()), ["file"]);
    }

    #[test]
    fn a_folder_in_the_place_of_a_file_is_refused() {
        let place = tempfile::tempdir().unwrap();
        fs::create_dir(place.path().join("a")).unwrap();
        let mut batch = Batch::into(place.path()).unwrap();
        let error = batch.stage("a", |_| Ok(())).unwrap_err();
        assert!(error.what().contains("a folder has this name"), "{error}");
    }
}
