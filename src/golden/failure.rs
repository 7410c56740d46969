//! What is wrong with a golden.

use crate::buffer::Buffer;
use crate::compare::Verdict;
use crate::error::Error;
use std::fmt;

/// Something wrong with a golden.
#[derive(Debug, Clone)]
pub struct Failure {
    /// `topic/case`.
    pub case: String,
    /// The technique's name, where one is to blame.
    pub technique: Option<String>,
    /// What is wrong.
    pub fault: Fault,
}

/// What is wrong with a golden.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub enum Fault {
    /// A case that the manifest does not know.
    NoEntry,
    /// An entry of the manifest that no scene and technique make.
    NoCase,
    /// An entry without its picture.
    NoPicture,
    /// A picture that belongs to no entry.
    OrphanPicture,
    /// A stored picture that is not what the manifest says, and what is drawn.
    OtherPicture {
        /// The stored picture, compared.
        verdict: Box<Verdict>,
    },
    /// A scene that cannot be drawn, or a stored picture that cannot be read.
    Refused(Error),
    /// The picture has another size than the manifest says.
    Size {
        /// What the manifest says.
        expected: (usize, usize),
        /// What is drawn.
        actual: (usize, usize),
    },
    /// A buffer differs from what the manifest says.
    Differs {
        /// The first one, in the order of the technique's stages.
        buffer: String,
        /// The picture against the stored one, where there is one.
        verdict: Option<Box<Verdict>>,
        /// The picture as it is drawn now.
        actual: Buffer<[u8; 4]>,
    },
    /// A picture that the judge does not allow.
    NotAllowed {
        /// What it says.
        ruling: String,
    },
    /// A change that must not change a buffer does.
    Variant {
        /// The variant's name.
        variant: String,
        /// The first buffer that differs.
        buffer: String,
    },
}

impl Fault {
    /// Its name in reports.
    pub fn name(&self) -> &'static str {
        match self {
            Self::NoEntry => "no-entry",
            Self::NoCase => "no-case",
            Self::NoPicture => "no-picture",
            Self::OrphanPicture => "orphan-picture",
            Self::OtherPicture { .. } => "other-picture",
            Self::Refused(_) => "refused",
            Self::Size { .. } => "another-size",
            Self::Differs { .. } => "differs",
            Self::NotAllowed { .. } => "not-allowed",
            Self::Variant { .. } => "variant-differs",
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.case)?;
        if let Some(technique) = &self.technique {
            write!(f, " by {technique}")?;
        }
        write!(f, ": {}: {}", self.fault.name(), self.fault)
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoEntry => write!(f, "the manifest does not know it: look at it and bless it"),
            Self::NoCase => write!(f, "the manifest knows it, but no scene and technique make it"),
            Self::NoPicture => write!(f, "its picture is missing"),
            Self::OrphanPicture => write!(f, "the picture belongs to no entry of the manifest"),
            Self::OtherPicture { verdict } => {
                write!(f, "the stored picture is not the manifest's; {}", in_short(verdict))
            }
            Self::Refused(error) => write!(f, "{error}"),
            Self::Size { expected, actual } => write!(
                f,
                "{} x {} pixels are expected, {} x {} are drawn",
                expected.0, expected.1, actual.0, actual.1
            ),
            Self::Differs { buffer, verdict, .. } => {
                write!(f, "the first buffer that differs is `{buffer}`")?;
                match verdict {
                    Some(verdict) => write!(f, "; the picture: {}", in_short(verdict)),
                    None => Ok(()),
                }
            }
            Self::NotAllowed { ruling } => write!(f, "the judge does not allow it: {ruling}"),
            Self::Variant { variant, buffer } => {
                write!(f, "`{variant}` must change nothing, and changes `{buffer}`")
            }
        }
    }
}

/// How far a picture is off: count, largest, window.
fn in_short(verdict: &Verdict) -> String {
    let metrics = match &verdict.outcome {
        Ok(measured) => &measured.metrics,
        Err(mismatch) => return mismatch.to_string(),
    };
    match metrics.densest {
        None => "no pixel differs".into(),
        Some(window) => format!(
            "{} pixels differ, by at most {:.0}/255, {} of them in {} x {} pixels from {},{}",
            metrics.failing,
            metrics.max * 255.0,
            window.failing,
            window.width,
            window.height,
            window.x,
            window.y
        ),
    }
}
