//! A refusal as a person reads it: place, reason, the line with a caret, help.

use drapery::{Error, Position};
use std::path::Path;

const RED: &str = "\x1b[1;31m";
const BLUE: &str = "\x1b[1;34m";
const CYAN: &str = "\x1b[1;36m";
const PLAIN: &str = "\x1b[0m";

/// How much of a long line is shown.
const SHOWN: usize = 100;

/// The message, with colours (the stream drops them where they are not wanted). `text` is what the error speaks of
/// where it is not in a file.
pub(super) fn message(error: &Error, text: Option<&str>) -> String {
    let kind = if error.is_internal() { "internal error" } else { "error" };
    let full = error.to_string();
    let help = error.help_text();
    let headline = help.and_then(|help| full.strip_suffix(&format!("\n  help: {help}"))).unwrap_or(&full);
    let mut message = format!("{RED}{kind}{PLAIN}: {}\n", harmless(headline));
    if let Some(excerpt) = excerpt(error, text) {
        message.push_str(&excerpt);
    }
    if let Some(help) = help {
        message.push_str(&format!("{CYAN}help{PLAIN}: {}\n", harmless(help)));
    }
    message
}

/// The line with a caret under what is wrong.
fn excerpt(error: &Error, text: Option<&str>) -> Option<String> {
    let at = error.position()?;
    let read =
        |path: &Path| std::fs::read(path).ok().map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    let text = text.map(str::to_owned).or_else(|| read(error.path()?))?;
    let line = text.trim_start_matches('\u{feff}').lines().nth(at.line - 1)?;
    let (shown, column) = shorten(line, at);
    let number = at.line.to_string();
    let margin = " ".repeat(number.len());
    let caret = "^".repeat(at.length.min(shown.chars().count().saturating_sub(column)).max(1));
    Some(format!(
        "{BLUE}{number} |{PLAIN} {shown}\n{BLUE}{margin} |{PLAIN} {}{RED}{caret}{PLAIN}\n",
        " ".repeat(column)
    ))
}

/// The part of a line around a column, and where in it the column is (from 0).
fn shorten(line: &str, at: Position) -> (String, usize) {
    let column = at.column.saturating_sub(1);
    let from = if column + 20 > SHOWN { column - SHOWN / 2 } else { 0 };
    let shown: String = line.chars().skip(from).take(SHOWN).collect();
    (harmless(&shown).replace('\n', " "), column - from)
}

/// The text without characters that would move the cursor or change the terminal.
pub(super) fn harmless(text: &str) -> String {
    text.chars().map(|c| if c.is_control() && c != '\n' { ' ' } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(error: &Error, text: &str) -> String {
        let coloured = message(error, Some(text));
        [RED, BLUE, CYAN, PLAIN].iter().fold(coloured, |text, code| text.replace(code, ""))
    }

    #[test]
    fn the_line_is_shown_with_a_caret() {
        let at = Position { line: 2, column: 5, length: 3 };
        let error = Error::new("no such thing").in_file(Path::new("a.toml")).at(at).help("look");
        assert_eq!(
            plain(&error, "one\n\tis bad here\n"),
            "error: a.toml:2:5: no such thing\n2 |  is bad here\n  |     ^^^\nhelp: look\n"
        );
    }

    #[test]
    fn a_line_without_end_is_shown_in_part() {
        let line = "x".repeat(1_000_000);
        let at = Position { line: 1, column: 500_000, length: 700_000 };
        let text = plain(&Error::new("long").at(at), &line);
        assert!(text.lines().all(|line| line.chars().count() < 120), "{text}");
    }

    #[test]
    fn a_file_cannot_steer_the_terminal() {
        let at = Position { line: 1, column: 1, length: 1 };
        let text = plain(&Error::new("a\x1b[2Jb").at(at), "\x1b[2J");
        assert!(!text.contains('\x1b'), "{text:?}");
    }

    #[test]
    fn a_place_past_the_end_shows_no_line() {
        let at = Position { line: 9, column: 1, length: 1 };
        assert_eq!(plain(&Error::new("short").at(at), "one"), "error: line 9, column 1: short\n");
    }
}
