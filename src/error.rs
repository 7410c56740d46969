//! What went wrong, where, and what to do about it.

use std::fmt;
use std::path::{Path, PathBuf};

/// The result of everything in this crate that can refuse its input.
pub type Result<T> = std::result::Result<T, Error>;

/// A refusal: what is wrong, where, and what to do.
///
/// `Display` prints `path:line:column: what` (or as much of the place as is known), then the help on a line of
/// its own. The fields stay private so that more can be told later.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Error(Box<Inner>);

#[derive(Debug, Clone)]
struct Inner {
    what: String,
    help: Option<String>,
    path: Option<PathBuf>,
    position: Option<Position>,
    feature: Option<usize>,
    named: Option<(Option<PathBuf>, Position)>,
    internal: bool,
}

/// A place in a text file: counted from 1, columns in characters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Position {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// How many characters the wrong thing spans (at least 1).
    pub length: usize,
}

impl Error {
    /// A wrong call or input (exit status 2).
    pub fn new(what: impl Into<String>) -> Self {
        Self(Box::new(Inner {
            what: what.into(),
            help: None,
            path: None,
            position: None,
            feature: None,
            named: None,
            internal: false,
        }))
    }

    /// A bug of ours (exit status 3).
    pub fn internal(what: impl Into<String>) -> Self {
        let mut error = Self::new(what);
        error.0.internal = true;
        error
    }

    /// Says what to do about it.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.0.help = Some(help.into());
        self
    }

    /// Names the file, unless an inner call has already named one.
    #[must_use]
    pub fn in_file(mut self, path: &Path) -> Self {
        self.0.path.get_or_insert_with(|| path.to_path_buf());
        self
    }

    /// Names the place in a text file.
    #[must_use]
    pub fn at(mut self, position: Position) -> Self {
        self.0.position = Some(position);
        self
    }

    /// Names the feature, counted from 0 in file order.
    #[must_use]
    pub fn in_feature(mut self, index: usize) -> Self {
        self.0.feature = Some(index);
        self
    }

    /// Says where a scene file names the file that is to blame.
    #[must_use]
    pub fn named_in(mut self, scene: Option<&Path>, position: Position) -> Self {
        let named = (scene.map(Path::to_path_buf), position);
        self.0.named.get_or_insert(named);
        self
    }

    /// What is wrong, without the place and the help.
    pub fn what(&self) -> &str {
        &self.0.what
    }

    /// What to do about it.
    pub fn help_text(&self) -> Option<&str> {
        self.0.help.as_deref()
    }

    /// The file, where one is to blame.
    pub fn path(&self) -> Option<&Path> {
        self.0.path.as_deref()
    }

    /// The place in the file, where it is text.
    pub fn position(&self) -> Option<Position> {
        self.0.position
    }

    /// Whether this is a bug of ours rather than a wrong input.
    pub fn is_internal(&self) -> bool {
        self.0.internal
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let inner = &*self.0;
        if let Some(path) = &inner.path {
            write!(f, "{}:", path.display())?;
            if let Some(at) = inner.position {
                write!(f, "{}:{}:", at.line, at.column)?;
            }
            write!(f, " ")?;
        } else if let Some(at) = inner.position {
            write!(f, "line {}, column {}: ", at.line, at.column)?;
        }
        if let Some(feature) = inner.feature {
            write!(f, "feature {feature}: ")?;
        }
        write!(f, "{}", inner.what)?;
        if let Some((scene, at)) = &inner.named {
            match scene {
                Some(scene) => write!(f, "\n  named in {}:{}:{}", scene.display(), at.line, at.column)?,
                None => write!(f, "\n  named in line {}, column {} of the scene", at.line, at.column)?,
            }
        }
        if let Some(help) = &inner.help {
            write!(f, "\n  help: {help}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Error {}
