//! What encoding linear light by tables adds to what a picture may be.

use crate::compare::{Choice, Hypothesis};
use crate::scene::BlendSpace;
use crate::technique::Kind;

/// How far machines' tables of the sRGB transfer function have been seen to be off besides rounding, in codes of 16 bits (37 of them), and a hair: 0.15 code
/// values of 8. (Direct3D allows a tenth.)
const TABLES: u16 = 39;

/// By how much a channel of a technique's picture may be off besides, in codes of 16 bits; `None`: nothing is encoded.
pub(super) fn encoding(kind: Kind, space: BlendSpace) -> Option<u16> {
    // Where a target blends, it encodes what it will decode; less and less of that shows through.
    let has_blends = matches!(kind, Kind::StencilVolume | Kind::GeometryOverlay);
    (space == BlendSpace::Linear).then_some(if has_blends { 2 * TABLES } else { TABLES })
}

/// What a picture may be if its colours (not its alpha) are off by so many codes of 16 bits, too.
pub(super) fn encoded_by_tables(of: &Hypothesis, by: u16) -> Hypothesis {
    let lower =
        |[r, g, b, a]: [u16; 4]| [r.saturating_sub(by), g.saturating_sub(by), b.saturating_sub(by), a];
    let upper =
        |[r, g, b, a]: [u16; 4]| [r.saturating_add(by), g.saturating_add(by), b.saturating_add(by), a];
    let choice = |choice: &Choice| Choice { lo: lower(choice.lo), hi: upper(choice.hi), ..*choice };
    Hypothesis {
        name: encoded_name(&of.name),
        says: format!("{}, and linear light is encoded by a table", of.says),
        lo: of.lo.iter().map(|lo| lower(*lo)).collect(),
        hi: of.hi.iter().map(|hi| upper(*hi)).collect(),
        choices: of.choices.iter().map(choice).collect(),
        extremes: of.extremes.clone(),
    }
}

/// What that is called, of a hypothesis of a name.
pub(super) fn encoded_name(name: &str) -> String {
    format!("{name}-coarse-encoding")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_moves_colours_by_a_seventh_of_a_code_value_and_no_alpha() {
        let own =
            Hypothesis { lo: vec![[0, 300, 9, 7]], hi: vec![[5, 400, 65535, 8]], ..Hypothesis::default() };
        assert_eq!(encoding(Kind::Clipmap, BlendSpace::Encoded), None);
        let by = encoding(Kind::Clipmap, BlendSpace::Linear).unwrap();
        assert!((f64::from(by) / 257.0 - 0.15).abs() < 2e-3);
        let coarse = encoded_by_tables(&own, by);
        assert_eq!((coarse.lo[0], coarse.hi[0]), ([0, 261, 0, 7], [44, 439, 65535, 8]));
    }
}
