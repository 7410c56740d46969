//! The summary of a step of a workflow, in Markdown: a table, and what failed.

use super::case::Case;
use super::cases::{Cases, called};
use crate::compare::judgement::Ruling;

impl Cases {
    /// The summary, of at most so many bytes: whole cases are left out where there is no room, and counted.
    pub fn summary(&self, most: usize) -> String {
        /// Room for saying how many were left out.
        const LAST: usize = 100;
        let room = most.saturating_sub(LAST);
        let mut text = format!("## {}\n\n", cell(&self.headline()));
        text.push_str(
            "| case | verdict | failing | densest | hypothesis |\n| --- | --- | --- | --- | --- |\n",
        );
        let rows: Vec<String> = self.cases.iter().map(row).collect();
        let told = self.cases.iter().filter(|case| case.ruling != Ruling::Pass).map(details);
        let mut left_out = 0;
        for part in rows.into_iter().chain(["\n".to_owned()]).chain(told) {
            match text.len() + part.len() <= room {
                true => text.push_str(&part),
                false => left_out += 1,
            }
        }
        if left_out > 0 {
            text.push_str(&format!("\n{left_out} parts are left out: there is no room for them here.\n"));
        }
        if text.len() > most { String::new() } else { text }
    }
}

fn row(case: &Case) -> String {
    let number = |number: Option<usize>| number.map_or("-".to_owned(), |number| number.to_string());
    let dense = case.failing.map(|_| case.windows.first().map_or(0, |window| window.failing));
    let hypothesis = case.hypothesis.as_deref().unwrap_or("-");
    format!(
        "| {} | {} | {} | {} | {} |\n",
        cell(&case.name),
        called(case.ruling),
        number(case.failing),
        number(dense),
        cell(hypothesis)
    )
}

/// What a case says, as text that is no Markdown: four spaces before a line.
fn details(case: &Case) -> String {
    let lines: String = case.text().lines().map(|line| format!("    {line}\n")).collect();
    format!("\n### {}\n\n{lines}", cell(&case.name))
}

/// Text within a table: no markup, one line.
fn cell(text: &str) -> String {
    let mut safe = String::new();
    for c in text.chars() {
        match c {
            '<' => safe.push_str("&lt;"),
            '&' => safe.push_str("&amp;"),
            '|' | '\\' | '`' | '*' | '_' | '[' | ']' => safe.extend(['\\', c]),
            c if c.is_control() => safe.push(' '),
            c => safe.push(c),
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;

    #[test]
    fn a_summary_that_is_too_long_leaves_whole_parts_out_and_counts_them() {
        let case = |k: usize| Case::unread("set/a", &format!("frames/{k}"), &Error::new("no frame"));
        let cases =
            Cases { set: Some(("set".into(), "frames".into())), cases: (0..1000).map(case).collect() };
        let whole = cases.summary(usize::MAX);
        assert!(
            whole.contains("| frames/999 | FAIL | - | - | - |") && !whole.contains("left out"),
            "{whole}"
        );
        let short = cases.summary(4000);
        assert!(short.len() <= 4000 && short.len() > 3000);
        assert!(short.ends_with("parts are left out: there is no room for them here.\n"), "{short}");
        assert_eq!(cases.summary(10), "");
    }

    #[test]
    fn names_are_no_markup() {
        assert_eq!(cell("a|b<c>`d`\n"), "a\\|b&lt;c>\\`d\\` ");
    }
}
