//! Analytic coverage (ours).

mod coverage;
mod pieces;
