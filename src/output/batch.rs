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
    names: Vec<String>,
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
        Ok(Self { folder: folder.into(), staging: staging.map_err(refuse)?, names: Vec::new() })
    }

    /// Writes a file of this name, to appear with the others; the name may begin with folders.
    ///
    /// # Errors
    /// When it cannot be written, or a folder has its name; says which file.
    pub fn stage(&mut self, name: &str, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<()> {
        let path = self.folder.join(name);
        let refuse = |error: io::Error| Error::io("this file cannot be written", error).in_file(&path);
        if path.is_dir() {
            return Err(refuse(io::Error::other("a folder has this name")));
        }
        if self.names.iter().any(|known| known == name) {
            return Err(Error::internal("one run writes this file twice").in_file(&path));
        }
        let staged = self.staging.files().join(name);
        parent(&staged)
            .map_or(Ok(()), fs::create_dir_all)
            .and_then(|()| File::create_new(staged))
            .and_then(|file| fill(file, write))
            .map_err(refuse)?;
        self.names.push(name.into());
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
            for name in &self.names {
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
