//! How far a picture is from what is expected, in numbers and as a picture.
//!
//! Input: what is [`Expected`], an interval for each value (a golden picture is the interval of no width), and an
//! [`Image`]; files of PNG, EXR and .npy become one by [`Image::read`]. Output: the [`Difference`] of the two, its
//! [`Metrics`] and its heat map; a [`Verdict`] by stated [`Limits`], and its [`Report`]. Refuses, each by its own name
//! ([`Mismatch`]): another size, other channels, a value that is not a number.
//!
//! Or input: what a technique's picture may be ([`Allowed`]), read from a bundle by a [`Judge`], and a frame ([`Submitted`]). Output: a
//! [`Judgement`] within stated [`Gates`]. All are told alike ([`Cases`]): as text, JSON, JUnit's XML, annotations, one page.
//!
//! ```
//! use drapery::compare::{Difference, Expected, Image};
//! let lo = Image::new(2, 1, 1, vec![0.25, 0.5])?;
//! let hi = Image::new(2, 1, 1, vec![0.50, 0.5])?;
//! let actual = Image::new(2, 1, 1, vec![0.375, 0.75])?;
//! let difference = Difference::of(&Expected::between(lo, hi)?, &actual).unwrap();
//! let metrics = difference.metrics(1.0 / 255.0);
//! assert_eq!((metrics.max, metrics.failing), (0.25, 1));
//! assert_eq!(difference.heat_map(1.0 / 255.0).width(), 2);
//! # Ok::<(), drapery::Error>(())
//! ```

mod allowed;
mod bundle;
mod difference;
mod expected;
mod heat_map;
mod image;
mod judgement;
mod metrics;
mod page;
mod read;
mod report;
mod submitted;
mod verdict;

pub use allowed::{Allowed, Alternative, Choice, Extremes, FeatureRun, Hypothesis, Stage, StageRange};
pub use bundle::{ConformanceCase, ConformanceSet, Judge};
pub use difference::Difference;
pub use expected::{Expected, Mismatch, Side};
pub use image::{Image, ValuePlace};
pub use judgement::{
    Fitted, Gates, Involved, Judgement, Lean, Lopsided, MOST_IN_WINDOW, Otherwise, Ruling, StageFound,
    StageOutcome, Tried,
};
pub use metrics::{Metrics, WINDOW, Window};
pub use page::{Shown, page};
pub use read::same_file;
pub use report::{COMPARE_SCHEMA, Case, Cases, Failure, JudgementReport, Report};
pub use submitted::Submitted;
pub use verdict::{Limits, Measured, Verdict};
