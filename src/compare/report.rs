//! A verdict as text for people and as JSON for programs. `docs/contract.md` has the layout.

use super::difference::Difference;
use super::metrics::{Metrics, Window};
use super::verdict::{Measured, Verdict};
use crate::error::{Error, Result};
use serde_json::{Value, json};

/// The version of the JSON's layout.
pub const COMPARE_SCHEMA: u32 = 1;

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
        let mut rows = vec![("expected", self.expected.to_owned()), ("actual", self.actual.to_owned())];
        if let Ok(measured) = &self.verdict.outcome {
            rows.extend(measured_rows(measured));
        }
        let line = |(name, text): &(&str, String)| format!("  {name:<9} {text}\n");
        format!("{}\n{}", self.verdict, rows.iter().map(line).collect::<String>())
    }

    /// The JSON document. Numbers are written so that they are read back as they were; an infinite one is `"inf"`.
    ///
    /// # Errors
    /// Internal errors only.
    pub fn json(&self) -> Result<String> {
        let verdict = self.verdict;
        let measured = verdict.outcome.as_ref().ok();
        let distances = measured.map(|measured| measured.difference.distances());
        let failure = verdict
            .failure()
            .map(|name| json!({ "name": name, "text": verdict.to_string().trim_start_matches("FAIL: ") }));
        let document = json!({
            "schema": COMPARE_SCHEMA,
            "expected": self.expected,
            "actual": self.actual,
            "verdict": if verdict.passed() { "pass" } else { "fail" },
            "failure": failure,
            "tolerance": verdict.limits.tolerance(),
            "allow": verdict.limits.allow(),
            "width": distances.map(|image| image.width()),
            "height": distances.map(|image| image.height()),
            "channels": measured.map(|measured| channel_names(&measured.difference)),
            "metrics": measured.map(|measured| metrics_json(&measured.metrics, &measured.difference)),
        });
        let text = serde_json::to_string_pretty(&document);
        let text =
            text.map_err(|error| Error::internal(format!("the verdict as JSON: {error}")).caused_by(error))?;
        Ok(text + "\n")
    }
}

/// The channels' names in their order.
fn channel_names(difference: &Difference) -> Vec<String> {
    let names: &[&str] = match difference.distances().channels() {
        1 => &["value"],
        3 => &["red", "green", "blue"],
        4 => &["red", "green", "blue", "alpha"],
        n => return (0..n).map(|channel| channel.to_string()).collect(),
    };
    names.iter().map(|name| (*name).to_owned()).collect()
}

fn measured_rows(measured: &Measured) -> Vec<(&'static str, String)> {
    let Measured { difference, metrics } = measured;
    let (distances, names) = (difference.distances(), channel_names(difference));
    let mut rows = vec![
        ("size", format!("{} x {}, {}", distances.width(), distances.height(), names.join(" "))),
        ("max", with_codes(metrics.max) + &worst(metrics, &names)),
        ("mean", with_codes(metrics.mean)),
        ("rmse", with_codes(metrics.rmse)),
        ("p99", with_codes(metrics.p99)),
        ("off", format!("{:.3} % of the pixels by more than 1/255", 100.0 * metrics.over_one_code_value)),
    ];
    if let Some(Window { x, y, width, height, failing }) = metrics.densest {
        rows.push(("densest", format!("{failing} failing in {width} x {height} pixels from {x},{y}")));
    }
    let channels = names.iter().zip(&metrics.channel_max);
    let channels: Vec<String> = channels.map(|(name, max)| format!("{name} {}", short(*max))).collect();
    rows.push(("channels", channels.join(", ")));
    rows
}

fn worst(metrics: &Metrics, names: &[String]) -> String {
    metrics
        .worst
        .map_or(String::new(), |at| format!(", first at pixel {},{}, {}", at.x, at.y, names[at.channel]))
}

/// A distance, and how many 8-bit codes it is.
fn with_codes(distance: f64) -> String {
    if distance == 0.0 || distance > 1.0 {
        return short(distance);
    }
    format!("{} ({}/255)", short(distance), short(distance * 255.0))
}

/// A number with about four digits.
fn short(v: f64) -> String {
    if v == 0.0 || !v.is_finite() {
        v.to_string()
    } else if (1e-3..1e6).contains(&v) {
        let text = format!("{v:.4}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        format!("{v:.3e}")
    }
}

fn metrics_json(metrics: &Metrics, difference: &Difference) -> Value {
    let names = channel_names(difference);
    json!({
        "max": number(metrics.max),
        "worst": metrics.worst.map(|at| json!({ "x": at.x, "y": at.y, "channel": names[at.channel] })),
        "mean": number(metrics.mean),
        "rmse": number(metrics.rmse),
        "p99": number(metrics.p99),
        "channel_max": metrics.channel_max.iter().map(|max| number(*max)).collect::<Vec<_>>(),
        "over_one_code_value": metrics.over_one_code_value,
        "failing": metrics.failing,
        "densest": metrics.densest,
    })
}

/// JSON has no infinity.
fn number(v: f64) -> Value {
    if v.is_finite() { json!(v) } else { json!("inf") }
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
    fn channels_have_the_names_of_their_number() {
        let names = |channels: usize| {
            let image = || Image::new(1, 1, channels, vec![0.0; channels]).unwrap();
            channel_names(&Difference::of(&Expected::exactly(image()), &image()).unwrap()).join(" ")
        };
        assert_eq!([1, 2, 3, 4].map(names), ["value", "0 1", "red green blue", "red green blue alpha"]);
    }

    #[test]
    fn distances_have_four_digits_and_their_codes_up_to_white() {
        let written = [0.0, 0.2, 1.0, 1.5, f64::INFINITY].map(with_codes);
        assert_eq!(written, ["0", "0.2 (51/255)", "1 (255/255)", "1.5", "inf"]);
        let written = [0.001, 0.000_999_9, 999_999.0, 1e6, 120.0].map(short);
        assert_eq!(written, ["0.001", "9.999e-4", "999999", "1.000e6", "120"]);
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
