//! A verdict on a picture by another, as it is told.

use super::case::{COMPARE_SCHEMA, Case, Failure};
use super::numbers::{channel_names, measured_rows, metrics_json};
use crate::compare::judgement::Ruling;
use crate::compare::verdict::Verdict;
use crate::error::Result;
use serde_json::{Value, json};

/// A verdict, and which two were compared.
#[derive(Debug, Clone, Copy)]
pub struct Report<'a> {
    /// What the expected picture is called.
    pub expected: &'a str,
    /// What the judged picture is called.
    pub actual: &'a str,
    /// The verdict.
    pub verdict: &'a Verdict,
}

impl Report<'_> {
    /// The verdict in a line, then a line for each number.
    pub fn text(&self) -> String {
        self.case().text()
    }

    /// The JSON document. Numbers are written so that they are read back as they were; an infinite one is `"inf"`.
    ///
    /// # Errors
    /// Internal errors only.
    pub fn json(&self) -> Result<String> {
        self.case().json()
    }

    /// The verdict as all reports tell it.
    pub fn case(&self) -> Case {
        let verdict = self.verdict;
        let mut rows = vec![("expected", self.expected.to_owned()), ("actual", self.actual.to_owned())];
        if let Ok(measured) = &verdict.outcome {
            rows.extend(measured_rows(&measured.difference, &measured.metrics));
        }
        let headline = verdict.to_string();
        let failure = verdict.failure().map(|name| Failure::of(name, &headline));
        Case {
            name: self.actual.to_owned(),
            exposes: None,
            expected: self.expected.to_owned(),
            actual: self.actual.to_owned(),
            ruling: if verdict.passed() { Ruling::Pass } else { Ruling::Fail },
            document: self.document(failure.as_ref()),
            failing: verdict.outcome.as_ref().ok().map(|measured| measured.metrics.failing),
            hypothesis: None,
            windows: verdict
                .outcome
                .as_ref()
                .map(|measured| measured.difference.windows(verdict.limits.tolerance()))
                .unwrap_or_default(),
            features: Vec::new(),
            failure,
            headline,
            rows,
        }
    }

    fn document(&self, failure: Option<&Failure>) -> Value {
        let verdict = self.verdict;
        let measured = verdict.outcome.as_ref().ok();
        let distances = measured.map(|measured| measured.difference.distances());
        json!({
            "schema": COMPARE_SCHEMA,
            "kind": "pictures",
            "expected": self.expected,
            "actual": self.actual,
            "verdict": if verdict.passed() { "pass" } else { "fail" },
            "failure": failure,
            "tolerance": verdict.limits.tolerance(),
            "relative": verdict.limits.relative(),
            "allow": verdict.limits.allow(),
            "densest_allowed": verdict.limits.densest(),
            "width": distances.map(|image| image.width()),
            "height": distances.map(|image| image.height()),
            "channels": measured.map(|measured| channel_names(&measured.difference)),
            "metrics": measured.map(|measured| metrics_json(&measured.metrics, &measured.difference)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::{Expected, Image, Limits};

    fn report(actual: Image, check: impl Fn(Report)) {
        let black = Image::new(2, 1, 4, vec![0.0; 8]).unwrap();
        let limits = Limits::new(1.0 / 255.0, 0).unwrap();
        let verdict = Verdict::on(&actual, &Expected::exactly(black), limits);
        check(Report { expected: "a.png", actual: "b.png", verdict: &verdict });
    }

    fn off() -> Image {
        Image::new(2, 1, 4, vec![0.0, 0.0, 0.0, 0.0, 0.2, 0.0, 0.0, 0.5]).unwrap()
    }

    #[test]
    fn the_text_says_what_where_and_how_far() {
        report(off(), |report| {
            insta::assert_snapshot!(report.text(), @r"
            FAIL: 1 of 2 pixels are over the tolerance 0.00392156862745098 (0 allowed)
              expected  a.png
              actual    b.png
              size      2 x 1, red green blue alpha
              max       0.5 (127.5/255), first at pixel 1,0, alpha
              mean      0.0875 (22.3125/255)
              rmse      0.1904 (48.5506/255)
              p99       0.5 (127.5/255)
              off       50.000 % of the pixels by more than 1/255
              densest   1 failing in 2 x 1 pixels from 0,0
              channels  red 0.2, green 0, blue 0, alpha 0.5
            ");
        });
    }

    #[test]
    fn the_json_has_the_layout_of_the_contract() {
        report(off(), |report| {
            let json: Value = serde_json::from_str(&report.json().unwrap()).unwrap();
            assert_eq!(
                (&json["schema"], &json["verdict"], &json["width"]),
                (&json!(1), &json!("fail"), &json!(2))
            );
            assert_eq!((&json["tolerance"], &json["allow"]), (&json!(1.0 / 255.0), &json!(0)));
            assert_eq!(json["failure"]["name"], "over-tolerance");
            assert_eq!(json["channels"], json!(["red", "green", "blue", "alpha"]));
            let metrics = &json["metrics"];
            assert_eq!(metrics["max"], 0.5);
            assert_eq!(metrics["worst"], json!({ "x": 1, "y": 0, "channel": "alpha" }));
            assert_eq!(metrics["densest"]["failing"], 1);
            assert_eq!(metrics["channel_max"], json!([0.2, 0.0, 0.0, 0.5]));
        });
    }

    #[test]
    fn what_has_no_numbers_has_a_name_and_a_text() {
        report(Image::new(1, 1, 4, vec![0.0; 4]).unwrap(), |report| {
            let json: Value = serde_json::from_str(&report.json().unwrap()).unwrap();
            assert_eq!(json["failure"]["name"], "another-size");
            assert_eq!(
                json["failure"]["text"],
                "another size: 2 x 1 pixels are expected, the picture has 1 x 1"
            );
            assert_eq!(json["metrics"], Value::Null);
            assert!(report.text().starts_with("FAIL: another size"));
        });
    }

    #[test]
    fn an_infinite_distance_is_written_as_text() {
        let image = Image::new(2, 1, 4, vec![f64::INFINITY; 8]).unwrap();
        report(image, |report| {
            let json: Value = serde_json::from_str(&report.json().unwrap()).unwrap();
            assert_eq!((&json["metrics"]["max"], &json["metrics"]["mean"]), (&json!("inf"), &json!("inf")));
        });
    }
}
