//! Cases judged together: one table, one verdict.

use super::case::{COMPARE_SCHEMA, Case, pretty};
use super::judgement::word;
use crate::compare::judgement::Ruling;
use crate::error::Result;
use serde_json::{Value, json};

/// What a call judged: one case, or those of a set.
#[derive(Debug, Clone, PartialEq)]
pub struct Cases {
    /// What the set and the folder of its frames are called, where it is one.
    pub set: Option<(String, String)>,
    /// The cases, one where there is no set.
    pub cases: Vec<Case>,
}

impl Cases {
    /// The verdict on all: the worst of them.
    pub fn ruling(&self) -> Ruling {
        self.cases.iter().map(|case| case.ruling).max().unwrap_or(Ruling::Fail)
    }

    /// The verdict in a line.
    pub fn headline(&self) -> String {
        if let (None, [case]) = (&self.set, &self.cases[..]) {
            return case.headline.clone();
        }
        let count = |ruling| self.cases.iter().filter(|case| case.ruling == ruling).count();
        let weak = match count(Ruling::Weak) {
            0 => String::new(),
            weak => format!(", {weak} pass weakly"),
        };
        format!("{}: {} of {} cases fail{weak}", called(self.ruling()), count(Ruling::Fail), self.cases.len())
    }

    /// Of one case its text. Of a set the verdict, a table with a line for each case, and what those that did not simply pass have to say.
    pub fn text(&self) -> String {
        if let (None, [case]) = (&self.set, &self.cases[..]) {
            return case.text();
        }
        let cells = |case: &Case| {
            let number = |number: Option<usize>| number.map_or("-".to_owned(), |number| number.to_string());
            let dense = case.failing.map(|_| case.windows.first().map_or(0, |window| window.failing));
            let hypothesis = case.hypothesis.clone().unwrap_or("-".into());
            [case.name.clone(), called(case.ruling).into(), number(case.failing), number(dense), hypothesis]
        };
        let head = ["case", "verdict", "failing", "densest", "hypothesis"].map(str::to_owned);
        let rows: Vec<[String; 5]> = std::iter::once(head).chain(self.cases.iter().map(cells)).collect();
        let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
        let widths = [0, 1, 2, 3].map(width);
        let line = |[name, verdict, failing, dense, hypothesis]: &[String; 5]| {
            let [a, b, c, d] = widths;
            format!("  {name:<a$}  {verdict:<b$}  {failing:>c$}  {dense:>d$}  {hypothesis}\n")
        };
        let mut text = format!("{}\n{}", self.headline(), rows.iter().map(line).collect::<String>());
        for case in self.cases.iter().filter(|case| case.ruling != Ruling::Pass) {
            text.push_str(&format!("\n{}\n{}", case.name, case.text()));
        }
        text
    }

    /// The JSON document.
    ///
    /// # Errors
    /// Internal errors only.
    pub fn json(&self) -> Result<String> {
        let (expected, actual) = match (&self.set, &self.cases[..]) {
            (None, [case]) => return case.json(),
            (set, _) => set.clone().unwrap_or_default(),
        };
        let case = |case: &Case| {
            let mut document = case.document.clone();
            document["name"] = json!(case.name);
            document["exposes"] = json!(case.exposes);
            document
        };
        pretty(&json!({
            "schema": COMPARE_SCHEMA,
            "kind": "set",
            "expected": expected,
            "actual": actual,
            "verdict": word(self.ruling()),
            "cases": self.cases.iter().map(case).collect::<Vec<Value>>(),
        }))
    }
}

/// A verdict as people read it.
pub(in crate::compare) fn called(ruling: Ruling) -> &'static str {
    match ruling {
        Ruling::Pass => "PASS",
        Ruling::Weak => "WEAK PASS",
        Ruling::Fail => "FAIL",
    }
}
