//! Words of a text file and where they stand, read piece by piece.

use super::failure::unreadable;
use crate::error::{Error, Position, Result};
use std::io::BufRead;

/// The longest word a terrain text file may hold; no number needs as much.
const LONGEST: usize = 256;

/// What some editors put before a text in UTF-8.
pub(super) const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// The words of a text, separated by white space.
pub(super) struct Words<R> {
    input: R,
    line: usize,
    column: usize,
    word: Vec<u8>,
}

/// A word and where it stands.
#[derive(Debug, Clone, Copy)]
pub(super) struct Word<'a> {
    bytes: &'a [u8],
    line: usize,
    column: usize,
}

impl<R: BufRead> Words<R> {
    /// The words from here on, counting lines and columns from 1.
    pub(super) fn new(input: R) -> Self {
        Self { input, line: 1, column: 1, word: Vec::new() }
    }

    /// The next word, `None` at the end.
    pub(super) fn next(&mut self) -> Result<Option<Word<'_>>> {
        if (self.line, self.column) == (1, 1) {
            self.skip_mark()?;
        }
        self.skip_space()?;
        let (line, column) = (self.line, self.column);
        self.word.clear();
        self.take_word()?;
        let bytes = self.word.as_slice();
        Ok((!bytes.is_empty()).then_some(Word { bytes, line, column }))
    }

    /// Where the text ends, once [`Self::next`] has returned `None`.
    pub(super) fn end(&self) -> Position {
        Position { line: self.line, column: self.column, length: 1 }
    }

    /// Passes over a byte order mark; text of 16 bits a character is refused.
    fn skip_mark(&mut self) -> Result<()> {
        let start = self.input.fill_buf().map_err(unreadable)?;
        if start.starts_with(&[0xff, 0xfe]) || start.starts_with(&[0xfe, 0xff]) {
            return Err(Error::unsupported("this is text in UTF-16").help("save it as UTF-8 (or ASCII)"));
        }
        let mark = if start.starts_with(BYTE_ORDER_MARK) { BYTE_ORDER_MARK.len() } else { 0 };
        self.input.consume(mark);
        Ok(())
    }

    fn skip_space(&mut self) -> Result<()> {
        loop {
            let bytes = self.input.fill_buf().map_err(unreadable)?;
            let space = bytes.iter().take_while(|b| is_space(**b)).count();
            for &b in &bytes[..space] {
                if b == b'\n' {
                    (self.line, self.column) = (self.line + 1, 1);
                } else {
                    self.column += 1;
                }
            }
            let more = space == bytes.len() && space > 0;
            self.input.consume(space);
            if !more {
                return Ok(());
            }
        }
    }

    fn take_word(&mut self) -> Result<()> {
        loop {
            let bytes = self.input.fill_buf().map_err(unreadable)?;
            let length = bytes.iter().take_while(|b| !is_space(**b)).count();
            if self.word.len() + length > LONGEST {
                let at = (self.line, self.column);
                return Err(not_text(at));
            }
            self.word.extend_from_slice(&bytes[..length]);
            self.column += characters(&bytes[..length]);
            let more = length == bytes.len() && length > 0;
            self.input.consume(length);
            if !more {
                return Ok(());
            }
        }
    }
}

impl Word<'_> {
    /// Where the word stands.
    pub(super) fn position(&self) -> Position {
        Position { line: self.line, column: self.column, length: characters(self.bytes).max(1) }
    }

    /// The word as text, for keys and messages.
    pub(super) fn text(&self) -> String {
        String::from_utf8_lossy(self.bytes).into_owned()
    }

    /// The word as a number (also `nan` and `inf`), if it is one.
    pub(super) fn number(&self) -> Option<f64> {
        number(self.bytes)
    }
}

/// The number that some bytes spell.
pub(super) fn number(bytes: &[u8]) -> Option<f64> {
    std::str::from_utf8(bytes).ok()?.parse().ok()
}

/// What to do about a word that is no number.
pub(super) fn number_help(word: &str) -> &'static str {
    if word.contains(',') {
        "write decimals with a point, not a comma"
    } else {
        "a number like 1234.5 is wanted here"
    }
}

fn not_text((line, column): (usize, usize)) -> Error {
    Error::new(format!("a word of more than {LONGEST} bytes: this is no text of numbers"))
        .help("check that the file is what its extension says")
        .at(Position { line, column, length: 1 })
}

fn is_space(b: u8) -> bool {
    b.is_ascii_whitespace() || b == 0x0b
}

/// The characters in UTF-8 text: all bytes but continuations.
pub(super) fn characters(bytes: &[u8]) -> usize {
    bytes.iter().filter(|b| **b & 0xc0 != 0x80).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_know_their_line_and_column() {
        let mut words = Words::new(&b"ab  12\r\n\t\n 3.5"[..]);
        let places: Vec<_> = std::iter::from_fn(|| {
            let word = words.next().unwrap()?;
            Some((word.text(), word.position().line, word.position().column))
        })
        .collect();
        assert_eq!(places, [("ab".into(), 1, 1), ("12".into(), 1, 5), ("3.5".into(), 3, 2)]);
    }

    #[test]
    fn a_word_across_the_reads_of_a_slow_file_stays_whole() {
        let input = std::io::BufReader::with_capacity(3, &b"12345678 9"[..]);
        let mut words = Words::new(input);
        assert_eq!(words.next().unwrap().unwrap().number(), Some(12_345_678.0));
        assert_eq!(words.next().unwrap().unwrap().number(), Some(9.0));
        assert!(words.next().unwrap().is_none());
    }

    #[test]
    fn a_byte_order_mark_is_no_part_of_the_first_word() {
        let mut words = Words::new(&b"\xef\xbb\xbfncols 3"[..]);
        let word = words.next().unwrap().unwrap();
        assert_eq!((word.text(), word.position().column), ("ncols".into(), 1));
        assert!(Words::new(&b"\xff\xfen\0"[..]).next().unwrap_err().what().contains("UTF-16"));
    }

    #[test]
    fn an_endless_word_is_refused_early() {
        let bytes = vec![b'7'; 100_000];
        assert!(Words::new(&bytes[..]).next().is_err());
    }
}
