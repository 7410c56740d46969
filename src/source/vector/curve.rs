//! Curves: those that are made of straight pieces are lines, the others are refused.

use crate::error::Error;
use crate::space::Plan;

/// Adds the next piece of a compound curve, which begins where the one before ends.
pub(super) fn append_piece(line: &mut Vec<Plan>, piece: Vec<Plan>) {
    let joins = line.last().is_some() && line.last() == piece.first();
    line.extend(piece.into_iter().skip(usize::from(joins)));
}

/// The refusal of arcs, and of surfaces that are none of the plan.
pub(super) fn refusal_of_curves(what: &str) -> Error {
    Error::unsupported(format!("{what} are not supported: polygons and straight lines are"))
        .help("convert curves to lines: ogr2ogr -nlt CONVERT_TO_LINEAR OUT.gpkg IN")
}
