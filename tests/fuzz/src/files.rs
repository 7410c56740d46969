//! Files for readers that take paths: written into a folder of this process, over and over.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// What may lie beside a file.
const BESIDE: [&str; 14] = [
    "shx",
    "dbf",
    "prj",
    "cpg",
    "qix",
    "tfw",
    "pgw",
    "wld",
    "tif.msk",
    "tif.aux.xml",
    "tif.ovr",
    "png.aux.xml",
    "asc.aux.xml",
    // What a virtual raster may name.
    "tif",
];

/// What opens the content of a file beside.
const MARK: &[u8] = b"\n=== ";

/// The folder.
pub(crate) struct Folder {
    place: PathBuf,
    written: BTreeSet<PathBuf>,
}

impl Folder {
    /// Lends the folder of this process; `run` removes it with the others.
    pub(crate) fn with<T>(then: impl FnOnce(&mut Folder) -> T) -> T {
        static FOLDER: Mutex<Option<Folder>> = Mutex::new(None);
        // Taken out while it is lent: a target may ask again on the way.
        let taken = FOLDER.lock().expect("no panic comes back here").take();
        let mut folder = taken.unwrap_or_else(|| {
            let place = std::env::temp_dir().join(format!("drapery-fuzz-{}", std::process::id()));
            fs::create_dir_all(&place).expect("a folder for temporary files");
            Folder { place, written: BTreeSet::new() }
        });
        let result = then(&mut folder);
        *FOLDER.lock().expect("no panic comes back here") = Some(folder);
        result
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.place.join(name)
    }

    /// Writes a file over what was there.
    pub(crate) fn write(&mut self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.path(name);
        fs::write(&path, bytes).expect("a file for temporary data");
        self.written.insert(path.clone());
        path
    }

    /// Removes all files.
    pub(crate) fn clear(&mut self) {
        for path in std::mem::take(&mut self.written) {
            fs::remove_file(path).expect("just written");
        }
    }
}

/// Writes an input as the file of this name with what lies beside it, and hands over its path.
pub(crate) fn beside(name: &str, data: &[u8], then: impl FnOnce(&Path)) {
    let (main, others) = parted(data);
    let path = Folder::with(|folder| {
        if !(others.is_empty() && folder.written.len() <= 1) {
            folder.clear();
        }
        let stem = name.split('.').next().expect("a name");
        for (extension, content) in others {
            folder.write(&format!("{stem}.{extension}"), content);
        }
        folder.write(name, main)
    });
    then(&path);
}

/// The file, and what lies beside it by extension.
fn parted(data: &[u8]) -> (&[u8], Vec<(&'static str, &[u8])>) {
    let mut others = Vec::new();
    let mut main = data.len();
    let mut open: Option<(&'static str, usize)> = None;
    for at in 0..data.len() {
        let Some((extension, from)) = opened(&data[at..]) else { continue };
        match open {
            Some((before, start)) => others.push((before, &data[start.min(at)..at])),
            None => main = at,
        }
        open = Some((extension, at + from));
    }
    if let Some((extension, start)) = open {
        others.push((extension, &data[start..]));
    }
    (&data[..main], others)
}

/// The extension of the file that is opened here, and where its content begins.
fn opened(data: &[u8]) -> Option<(&'static str, usize)> {
    let rest = data.strip_prefix(MARK)?;
    let extension = BESIDE
        .into_iter()
        .find(|e| rest.strip_prefix(e.as_bytes()).is_some_and(|rest| rest.starts_with(b"\n")))?;
    Some((extension, MARK.len() + extension.len() + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_input_is_a_file_and_what_lies_beside_it() {
        let (main, others) = parted(b"ab\n=== c\n=== dbf\nx\ny\n=== shx\n\n=== prj\nz");
        assert_eq!(main, b"ab\n=== c");
        let wanted: [(&str, &[u8]); 3] = [("dbf", b"x\ny"), ("shx", b""), ("prj", b"z")];
        assert_eq!(others, wanted);
        assert_eq!(parted(b"plain"), (&b"plain"[..], Vec::new()));
    }
}
