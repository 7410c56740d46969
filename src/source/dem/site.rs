//! Where a terrain file lies, what lies beside it, and its bytes: on disk, or in a zip archive.
//!
//! A file of an archive is unpacked into memory, at most [`MOST_UNPACKED`] bytes of it; a file on disk is read where it lies.

use super::super::zip::{Archive, Entry};
use super::failure::unreadable;
use crate::error::{Error, Result};
use std::cell::RefCell;
use std::fs::File;
use std::io::{self, Cursor, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// The most bytes that are unpacked of an archive.
const MOST_UNPACKED: u64 = 1 << 30;

/// A file's place.
#[derive(Clone)]
pub(in crate::source) struct Site {
    path: PathBuf,
    packed: Option<Packed>,
}

/// A file in an archive, unpacked.
#[derive(Clone)]
struct Packed {
    archive: Rc<RefCell<Archive<File>>>,
    content: Content,
}

/// Bytes in memory that several readers share.
#[derive(Clone)]
pub(super) struct Content(Rc<Vec<u8>>);

impl AsRef<[u8]> for Content {
    fn as_ref(&self) -> &[u8] {
        &self.0
    }
}

/// The bytes of a file.
pub(super) enum Input {
    Disk(File),
    Memory(Cursor<Content>),
}

impl Input {
    /// Bytes in memory.
    fn memory(content: Content) -> Self {
        Self::Memory(Cursor::new(content))
    }

    /// How many bytes there are.
    pub(super) fn length(&self) -> Result<u64> {
        match self {
            Self::Disk(file) => Ok(file.metadata().map_err(unreadable)?.len()),
            Self::Memory(bytes) => Ok(bytes.get_ref().as_ref().len() as u64),
        }
    }
}

impl Read for Input {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        match self {
            Self::Disk(file) => file.read(buffer),
            Self::Memory(bytes) => bytes.read(buffer),
        }
    }
}

impl Seek for Input {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        match self {
            Self::Disk(file) => file.seek(to),
            Self::Memory(bytes) => bytes.seek(to),
        }
    }
}

impl Site {
    /// A file on disk.
    pub(in crate::source) fn on_disk(path: &Path) -> Self {
        Self { path: path.to_path_buf(), packed: None }
    }

    /// The one terrain file of the archive that lies here.
    pub(super) fn in_archive(&self) -> Result<Self> {
        let mut archive = Archive::open(open_on_disk(&self.path)?)?;
        let entry = the_terrain(archive.entries())?;
        let content = Content(Rc::new(archive.read(&entry, MOST_UNPACKED)?));
        let packed = Packed { archive: Rc::new(RefCell::new(archive)), content };
        Ok(Self { path: entry.name.into(), packed: Some(packed) })
    }

    /// Its path, on disk or in its archive: for its name and extension.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// The extension, in small letters.
    pub(super) fn extension(&self) -> String {
        let extension = self.path.extension().unwrap_or_default();
        extension.to_string_lossy().to_ascii_lowercase()
    }

    /// Its bytes, from the first on.
    pub(super) fn open(&self) -> Result<Input> {
        match &self.packed {
            Some(packed) => Ok(Input::memory(packed.content.clone())),
            None => open_on_disk(&self.path).map(Input::Disk),
        }
    }

    /// The first file of some paths that is there, in the same folder or archive.
    pub(super) fn beside(&self, paths: impl IntoIterator<Item = PathBuf>) -> Result<Option<Self>> {
        let Some(Packed { archive, .. }) = &self.packed else {
            let found = paths.into_iter().find(|p| p.is_file());
            return Ok(found.map(|path| Self { path, packed: None }));
        };
        let found = paths.into_iter().find_map(|path| {
            let archive = archive.borrow();
            archive.entries().iter().find(|e| Path::new(&e.name) == path).cloned()
        });
        let Some(entry) = found else {
            return Ok(None);
        };
        let content = Content(Rc::new(archive.borrow_mut().read(&entry, MOST_UNPACKED)?));
        let packed = Packed { archive: Rc::clone(archive), content };
        Ok(Some(Self { path: entry.name.into(), packed: Some(packed) }))
    }

    /// The file whose name is this one's and an ending, like `dem.tif.msk`.
    pub(super) fn with_ending(&self, ending: &str) -> Result<Option<Self>> {
        let name = |ending: &str| {
            let mut name = self.path.clone().into_os_string();
            name.push(ending);
            PathBuf::from(name)
        };
        self.beside([name(ending), name(&ending.to_ascii_uppercase())])
    }

    /// The file as text of at most `longest` bytes.
    pub(super) fn text(&self, longest: u64) -> Result<String> {
        let mut bytes = Vec::new();
        self.open()?.take(longest + 1).read_to_end(&mut bytes).map_err(unreadable)?;
        if bytes.len() as u64 > longest {
            return Err(Error::unsupported(format!(
                "it is longer than the {longest} bytes that are read of it"
            )));
        }
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }
}

/// The one file of an archive that holds heights; documents, and previews beside a grid, are none.
fn the_terrain(entries: &[Entry]) -> Result<Entry> {
    let ends = |entry: &&Entry, endings: &[&str]| {
        let extension = Path::new(&entry.name).extension().unwrap_or_default().to_ascii_lowercase();
        endings.iter().any(|e| extension == *e)
    };
    for kind in [&["hgt", "tif", "tiff"][..], &["asc", "agr"], &["xyz"], &["png"]] {
        let found: Vec<&Entry> = entries.iter().filter(|e| ends(e, kind)).collect();
        match found[..] {
            [] => {}
            [one] => return Ok(one.clone()),
            [first, second, ..] => {
                return Err(Error::new(format!(
                    "the zip archive holds {} terrain files, {} and {} among them",
                    found.len(),
                    first.name,
                    second.name
                ))
                .help(
                    "unpack it, and name the file that is wanted; or all: source = [\"A.hgt\", \"B.hgt\"]",
                ));
            }
        }
    }
    if !entries.is_empty() && entries.iter().all(|entry| ends(&entry, &["npy"])) {
        return Err(Error::unsupported(
            "this is .npz, NumPy's archive of arrays, which have no place on Earth",
        )
        .help("write the array as a GeoTIFF or as an Esri ASCII grid (.asc)"));
    }
    Err(Error::new(format!("the zip archive holds no terrain file among its {} files", entries.len()))
        .help("known are .tif .hgt .asc .png .xyz"))
}

/// Opens a plain file for reading.
fn open_on_disk(path: &Path) -> Result<File> {
    let refuse = |e: io::Error| Error::io("cannot be opened", e).help("check the path");
    let meta = std::fs::metadata(path).map_err(refuse)?;
    if meta.is_dir() {
        return Err(Error::new("this is a directory").help("name the terrain file in it"));
    }
    if !meta.is_file() {
        return Err(Error::new("this is not a plain file").help("copy its content into a file first"));
    }
    File::open(path).map_err(refuse)
}
