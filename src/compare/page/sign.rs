//! Verdicts as signs.

use crate::compare::judgement::Ruling;

/// A verdict's sign, by its shape as well as its colour.
pub(super) fn sign(ruling: Ruling) -> String {
    let (class, sign) = match ruling {
        Ruling::Pass => ("pass", "\u{2713}"),
        Ruling::Weak => ("weak", "~"),
        Ruling::Fail => ("fail", "\u{2715}"),
    };
    format!("<span class=\"sign {class}\" aria-hidden=\"true\">{sign}</span>")
}
