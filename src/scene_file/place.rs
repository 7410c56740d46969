//! Where a value was written: in the file, or in an override.

use crate::error::{Error, Position};
use std::ops::Range;
use std::path::Path;

/// Where a value was written.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Place {
    /// These bytes of the file.
    File(Range<usize>),
    /// The override with this text.
    Override(String),
}

/// What is being read, to turn places into errors.
#[derive(Clone, Copy)]
pub(super) struct Origin<'a> {
    pub(super) text: &'a str,
    pub(super) path: Option<&'a Path>,
}

impl Origin<'_> {
    /// A refusal of what is written at `place`.
    pub(super) fn error(&self, place: &Place, what: impl Into<String>) -> Error {
        match place {
            Place::File(span) => {
                let error = Error::new(what).at(position(self.text, span));
                match self.path {
                    Some(path) => error.in_file(path),
                    None => error,
                }
            }
            Place::Override(written) => Error::new(format!("override `{written}`: {}", what.into())),
        }
    }

    /// Line and column of a place, where it is in the file.
    pub(super) fn position(&self, place: &Place) -> Option<Position> {
        match place {
            Place::File(span) => Some(position(self.text, span)),
            Place::Override(_) => None,
        }
    }
}

/// Line and column in characters of some bytes of a text; a span over several lines ends with the first.
pub(super) fn position(text: &str, span: &Range<usize>) -> Position {
    let before = prefix(text, span.start);
    let line_start = before.rfind('\n').map_or(0, |at| at + 1);
    let spanned = prefix(text, span.end).get(before.len()..).unwrap_or("");
    let first_line = spanned.lines().next().unwrap_or("");
    let in_line = before[line_start..].trim_start_matches('\u{feff}');
    Position {
        line: before.matches('\n').count() + 1,
        column: in_line.chars().count() + 1,
        length: first_line.chars().count().max(1),
    }
}

/// The text up to a byte, moved back to the start of a character.
fn prefix(text: &str, end: usize) -> &str {
    let mut end = end.min(text.len());
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    &text[..end]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters_not_bytes() {
        let text = "a = 1\nname = \"Zürich\" # é\nb = 2";
        let at = text.find('#').unwrap();
        let found = position(text, &(at..at + 1));
        assert_eq!((found.line, found.column), (2, 17));
    }

    #[test]
    fn a_byte_order_mark_takes_no_column() {
        assert_eq!(position("\u{feff}a = 1", &(3..4)).column, 1);
    }

    #[test]
    fn a_span_inside_a_character_or_past_the_end_is_no_panic() {
        assert_eq!(position("ü", &(1..9)).line, 1);
        assert_eq!(position("", &(5..9)).column, 1);
    }
}
