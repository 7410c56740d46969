//! Where files wait until they are whole: folders `.NAME.0.part` and so on. What a killed run leaves there, the next run to the same
//! place clears.
//!
//! Whoever writes into a part holds a lock in it, which the system drops when a process ends however it ends; so a part whose lock is
//! free belongs to nobody. Where a file system has no locks nothing is cleared.

use same_file::Handle;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

/// The most parts of one name at a time.
const MOST: usize = 1000;

/// The name of the locked file in a part.
const LOCK: &str = "lock";

/// Files that are being written: they stand in the folder [`files`](Self::files). What is left of it goes when it is dropped.
#[derive(Debug)]
pub(super) struct Part {
    path: PathBuf,
    _lock: Handle,
}

impl Part {
    /// A new one in `folder`; several processes may be at work.
    pub(super) fn new(folder: &Path, name: &str) -> io::Result<Self> {
        for number in 0..MOST {
            match Self::create(folder.join(format!(".{name}.{number}.part"))) {
                Ok(made) => return Ok(made),
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error),
            }
        }
        Err(io::Error::other(format!("{MOST} others are writing there")))
    }

    fn create(path: PathBuf) -> io::Result<Self> {
        fs::create_dir(&path)?;
        let within = || {
            let lock = Handle::from_file(File::create_new(path.join(LOCK))?)?;
            // A file system without locks goes without.
            let _ = lock.as_file().lock();
            if !is_lock_of(&path, &lock) {
                return Err(io::ErrorKind::NotFound.into());
            }
            fs::create_dir(files_of(&path)).map(|()| lock)
        };
        let lock = within().map_err(|error| match error.kind() {
            // Until it was locked it looked like a dead one's, and was cleared; another's may stand there by now.
            io::ErrorKind::NotFound => io::ErrorKind::AlreadyExists.into(),
            _ => error,
        })?;
        Ok(Self { path, _lock: lock })
    }

    /// Where its files stand; a folder that may be moved away.
    pub(super) fn files(&self) -> PathBuf {
        files_of(&self.path)
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        // The error that led here is told already; what cannot even be removed adds nothing.
        let _ = remove(&self.path);
    }
}

/// Removes the parts of this name that killed runs left in a folder. What cannot be removed stays: it is in nobody's way.
pub(super) fn clear(folder: &Path, name: &str) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        if is_folder && entry.file_name().to_str().is_some_and(|found| is_part_of(found, name)) {
            let _ = clear_one(&entry.path());
        }
    }
}

fn clear_one(path: &Path) -> io::Result<()> {
    let Ok(lock) = OpenOptions::new().write(true).open(path.join(LOCK)) else {
        // Killed before it had a lock, or while it was being removed: nothing is in it. (If something is, it stays.)
        return fs::remove_dir(path);
    };
    let lock = Handle::from_file(lock)?;
    match lock.as_file().try_lock() {
        Ok(()) if is_lock_of(path, &lock) => remove(path),
        Ok(()) | Err(TryLockError::WouldBlock | TryLockError::Error(_)) => Ok(()),
    }
}

/// Whether a lock is still the one in this part: between opening and locking it, the part may have gone and a new one come to its place.
/// Who holds a part's lock and finds that it is, has the part to himself: nobody else removes it.
fn is_lock_of(part: &Path, lock: &Handle) -> bool {
    Handle::from_path(part.join(LOCK)).is_ok_and(|there| there == *lock)
}

/// Removes a part, its lock last: what is left at any moment is still known for what it is.
fn remove(path: &Path) -> io::Result<()> {
    match fs::remove_dir_all(files_of(path)) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
        _ => fs::remove_file(path.join(LOCK))?,
    }
    fs::remove_dir(path)
}

fn files_of(part: &Path) -> PathBuf {
    part.join("files")
}

fn is_part_of(found: &str, name: &str) -> bool {
    let number = found
        .strip_prefix('.')
        .and_then(|rest| rest.strip_prefix(name)?.strip_prefix('.')?.strip_suffix(".part"));
    number.is_some_and(|digits| !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a run that is killed while it writes leaves.
    fn leave_a_dead_ones(within: &Path, name: &str) {
        let left = within.join(name);
        fs::create_dir_all(files_of(&left).join("deep")).unwrap();
        fs::write(files_of(&left).join("deep/half"), "h").unwrap();
        fs::write(left.join(LOCK), "").unwrap();
    }

    fn names_in(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn what_the_dead_leave_is_cleared_and_what_the_living_write_stays() {
        let place = tempfile::tempdir().unwrap();
        let living = Part::new(place.path(), "out").unwrap();
        leave_a_dead_ones(place.path(), ".out.7.part");
        fs::create_dir(place.path().join(".out.8.part")).unwrap();
        clear(place.path(), "out");
        assert_eq!(names_in(place.path()), [".out.0.part"]);
        assert!(living.files().exists());
        drop(living);
        assert_eq!(names_in(place.path()), [""; 0]);
    }

    #[test]
    fn what_is_no_part_of_this_name_stays() {
        let place = tempfile::tempdir().unwrap();
        let others = [".out.part", ".out.x.part", ".out.1.parts", ".other.1.part", "out.1.part"];
        others.iter().for_each(|name| fs::write(place.path().join(name), "").unwrap());
        // Without a lock, and not empty: whoever made that, it was not this code.
        fs::create_dir_all(place.path().join(".out.3.part/mine")).unwrap();
        clear(place.path(), "out");
        assert_eq!(names_in(place.path()).len(), others.len() + 1);
    }

    #[test]
    fn the_lock_of_a_part_that_went_is_not_that_of_the_next_in_its_place() {
        let place = tempfile::tempdir().unwrap();
        let gone = Part::new(place.path(), "out").unwrap();
        let lock = Handle::from_path(gone.path.join(LOCK)).unwrap();
        assert!(is_lock_of(&gone.path, &lock));
        let path = gone.path.clone();
        drop(gone);
        assert!(!is_lock_of(&path, &lock));
        let next = Part::new(place.path(), "out").unwrap();
        assert_eq!(next.path, path);
        assert!(!is_lock_of(&path, &lock));
    }

    #[test]
    fn many_write_at_once_and_nobody_takes_anothers_part() {
        let place = tempfile::tempdir().unwrap();
        let work = || {
            for _ in 0..50 {
                clear(place.path(), "out");
                let part = Part::new(place.path(), "out").unwrap();
                fs::write(part.files().join("a"), "a").unwrap();
                std::thread::yield_now();
                assert!(part.files().join("a").exists());
            }
        };
        std::thread::scope(|scope| (0..4).for_each(|_| drop(scope.spawn(work))));
        assert_eq!(names_in(place.path()), [""; 0]);
    }
}
