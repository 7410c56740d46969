//! Verdicts as text for people, as JSON for programs, and as what systems that run tests read. `docs/contract.md` has the layouts.

mod annotation;
mod case;
mod cases;
mod escape;
mod judgement;
mod junit;
mod numbers;
mod picture;
mod summary;

pub use case::{COMPARE_SCHEMA, Case, Failure};
pub use cases::Cases;
pub(super) use cases::called;
pub(super) use escape::escaped;
pub use judgement::JudgementReport;
pub use picture::Report;
