//! Verdicts as text for people, as JSON for programs, and as what systems that run tests read. `docs/contract.md` has the layouts.

mod case;
mod cases;
mod judgement;
mod numbers;
mod picture;

pub use case::{COMPARE_SCHEMA, Case, Failure};
pub use cases::Cases;
pub use judgement::JudgementReport;
pub use picture::Report;
