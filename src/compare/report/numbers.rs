//! The numbers of a comparison as rows of text and as JSON.

use crate::compare::difference::Difference;
use crate::compare::metrics::{Metrics, Window};
use serde_json::{Value, json};

/// A row of a report: what it tells, and what there is.
pub(in crate::compare) type Row = (&'static str, String);

/// The channels' names in their order.
pub(super) fn channel_names(difference: &Difference) -> Vec<String> {
    let names: &[&str] = match difference.distances().channels() {
        1 => &["value"],
        3 => &["red", "green", "blue"],
        4 => &["red", "green", "blue", "alpha"],
        n => return (0..n).map(|channel| channel.to_string()).collect(),
    };
    names.iter().map(|name| (*name).to_owned()).collect()
}

/// What was measured, a row each.
pub(super) fn measured_rows(difference: &Difference, metrics: &Metrics) -> Vec<Row> {
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
pub(super) fn with_codes(distance: f64) -> String {
    if distance == 0.0 || distance > 1.0 {
        return short(distance);
    }
    format!("{} ({}/255)", short(distance), short(distance * 255.0))
}

/// A number with about four digits.
pub(super) fn short(v: f64) -> String {
    if v == 0.0 || !v.is_finite() {
        v.to_string()
    } else if (1e-3..1e6).contains(&v) {
        let text = format!("{v:.4}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        format!("{v:.3e}")
    }
}

pub(super) fn metrics_json(metrics: &Metrics, difference: &Difference) -> Value {
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
    use crate::compare::{Expected, Image};

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
}
