//! Annotations of GitHub: lines that a workflow prints, and its pages show.

use super::cases::Cases;
use crate::compare::judgement::Ruling;

impl Cases {
    /// A line for each case that did not simply pass: `::error` where it failed, `::warning` where it passed weakly.
    pub fn annotations(&self) -> String {
        let line = |case: &super::case::Case| {
            let level = match case.ruling {
                Ruling::Pass => return String::new(),
                Ruling::Weak => "warning",
                Ruling::Fail => "error",
            };
            let title = format!("drapery compare: {}", case.name);
            let file = case.expected.as_str();
            format!("::{level} file={},title={}::{}\n", property(file), property(&title), data(&case.text()))
        };
        self.cases.iter().map(line).collect()
    }
}

/// A message: one line, whatever is in it.
fn data(text: &str) -> String {
    text.trim_end().replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// A value before the message.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_told_ends_no_line_and_starts_no_other_command() {
        assert_eq!(data("50 %\n::error::x\r\n"), "50 %25%0A::error::x");
        assert_eq!(property("a:b,c%"), "a%3Ab%2Cc%25");
    }
}
