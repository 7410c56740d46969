//! What went wrong, where, and what to do about it.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The result of everything in this crate that can refuse its input.
pub type Result<T> = std::result::Result<T, Error>;

/// A refusal: what is wrong, where, and what to do.
///
/// `Display` prints `path:line:column: what` (or as much of the place as is known), then the help on a line of
/// its own. A program matches on [`Error::kind`]; the error of the system or of a library that led here is
/// [`source`](std::error::Error::source) (its words are in `Display` already). The fields stay private so that more can be
/// told later.
///
/// ```
/// use drapery::{ErrorKind, compare::Image};
/// use std::error::Error;
/// let error = Image::read("no/such.png".as_ref()).unwrap_err();
/// assert_eq!(error.kind(), ErrorKind::Io);
/// assert_eq!(error.to_string(), "no/such.png: this picture is missing");
/// assert!(error.source().is_some_and(|source| source.is::<std::io::Error>()));
/// ```
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Error(Box<Inner>);

#[derive(Debug, Clone)]
struct Inner {
    kind: ErrorKind,
    what: String,
    help: Option<String>,
    path: Option<PathBuf>,
    position: Option<Position>,
    layer: Option<(usize, String)>,
    feature: Option<usize>,
    named: Option<(Option<PathBuf>, Position)>,
    // Shared, so that an error can be cloned: those of the system cannot.
    source: Option<Arc<dyn std::error::Error + Send + Sync>>,
}

/// What a program can do about an [`Error`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ErrorKind {
    /// The call is wrong: an argument out of range, a name that nothing has.
    Usage,
    /// What a file, a scene or an override says is wrong: damaged, contradictory, out of range.
    Input,
    /// The input is well-formed, but beyond this build, this version or this technique: a feature that was left out, a compression or
    /// a CRS that is not known, a scene that a technique does not cover, more than can be numbered or held.
    Unsupported,
    /// The system refuses to read or to write: a missing file, a permission, a full disk.
    Io,
    /// A bug of ours.
    Internal,
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
    /// A wrong input.
    pub fn new(what: impl Into<String>) -> Self {
        Self::of(ErrorKind::Input, what.into())
    }

    /// A wrong call.
    pub fn usage(what: impl Into<String>) -> Self {
        Self::of(ErrorKind::Usage, what.into())
    }

    /// Something that is not done here, though nothing is wrong with it.
    pub fn unsupported(what: impl Into<String>) -> Self {
        Self::of(ErrorKind::Unsupported, what.into())
    }

    /// A refusal of the system: what could not be done, then the system's own words.
    pub fn io(what: impl fmt::Display, error: io::Error) -> Self {
        Self::of(ErrorKind::Io, format!("{what}: {error}")).caused_by(error)
    }

    /// A bug of ours.
    pub fn internal(what: impl Into<String>) -> Self {
        Self::of(ErrorKind::Internal, what.into())
    }

    fn of(kind: ErrorKind, what: String) -> Self {
        Self(Box::new(Inner {
            kind,
            what,
            help: None,
            path: None,
            position: None,
            layer: None,
            feature: None,
            named: None,
            source: None,
        }))
    }

    /// Keeps the error that led here.
    #[must_use]
    pub fn caused_by(mut self, source: impl std::error::Error + Send + Sync + 'static) -> Self {
        self.0.source = Some(Arc::new(source));
        self
    }

    /// Says it in other words, made of those it has.
    #[must_use]
    pub fn reworded(mut self, words: impl FnOnce(&str) -> String) -> Self {
        self.0.what = words(&self.0.what);
        self
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

    /// Names the layer of a scene: its number, counted from 0, and its name.
    #[must_use]
    pub fn in_layer(mut self, number: usize, name: &str) -> Self {
        self.0.layer = Some((number, name.to_owned()));
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

    /// Without the places in a scene that its reader never sees: one that a program wrote for itself.
    #[must_use]
    pub fn without_scene(mut self) -> Self {
        self.0.named = None;
        if self.0.path.is_none() {
            self.0.position = None;
        }
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

    /// The number of the scene's layer that is to blame, from 0, where a layer made of its data is.
    pub fn layer(&self) -> Option<usize> {
        self.0.layer.as_ref().map(|(number, _)| *number)
    }

    /// What a program can do about it.
    pub fn kind(&self) -> ErrorKind {
        self.0.kind
    }

    /// Whether this is a bug of ours.
    pub fn is_internal(&self) -> bool {
        self.kind() == ErrorKind::Internal
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
        if let Some((_, name)) = &inner.layer {
            write!(f, "layer `{name}`: ")?;
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

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.0.source.as_deref().map(|source| source as _)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::error::Error as _;

    #[test]
    fn a_refusal_of_the_system_is_told_and_kept() {
        let error =
            Error::io("this file cannot be read", io::Error::other("on fire")).in_file(Path::new("a"));
        assert_eq!(error.to_string(), "a: this file cannot be read: on fire");
        let (kept, again) = (error.clone(), error.reworded(|what| format!("`key`: {what}")));
        assert_eq!(again.what(), "`key`: this file cannot be read: on fire");
        for error in [kept, again] {
            let source = error.source().and_then(|source| source.downcast_ref::<io::Error>());
            assert_eq!(source.map(ToString::to_string), Some("on fire".into()));
            assert_eq!(error.kind(), ErrorKind::Io);
        }
    }

    #[test]
    fn an_error_has_the_kind_that_it_was_made_of_and_no_source_of_its_own() {
        let made = [
            (Error::new("a"), ErrorKind::Input),
            (Error::usage("a"), ErrorKind::Usage),
            (Error::unsupported("a"), ErrorKind::Unsupported),
            (Error::internal("a"), ErrorKind::Internal),
        ];
        for (error, kind) in made {
            assert_eq!((error.kind(), error.is_internal()), (kind, kind == ErrorKind::Internal));
            assert!(error.source().is_none() && error.to_string() == "a");
        }
    }
}
