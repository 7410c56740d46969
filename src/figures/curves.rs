//! Curves over two logarithmic axes.

use super::drawing::{At, Drawing};
use crate::math;

/// A named curve.
pub(super) struct Curve {
    pub(super) name: String,
    pub(super) points: Vec<[f64; 2]>,
}

/// What an axis is of, and from which power of ten to which.
pub(super) struct Axis {
    pub(super) title: &'static str,
    pub(super) decades: [i32; 2],
}

impl Axis {
    /// The place of a value, 0 to 1.
    fn place(&self, value: f64) -> f64 {
        let [low, high] = self.decades.map(f64::from);
        (math::ln(value) / std::f64::consts::LN_10 - low) / (high - low)
    }
}

const SIZE: [f64; 2] = [820.0, 480.0];
/// Left, top, right, bottom.
const FIELD: [f64; 4] = [70.0, 20.0, 540.0, 430.0];
/// Colours and dashes, so that colour is never all that tells curves apart.
const LOOKS: [(&str, &str); 6] = [
    ("ink", "edge thick"),
    ("blue", "edge"),
    ("orange", "edge dash"),
    ("green", "edge thick dash"),
    ("pink", "edge"),
    ("gold", "edge dash"),
];

/// Curves; values of nought have no place and are left out.
pub(super) fn curves(title: &str, [across, up]: [&Axis; 2], curves: &[Curve]) -> String {
    let [left, top, right, bottom] = FIELD;
    let at = |[x, y]: [f64; 2]| -> At {
        [left + across.place(x) * (right - left), bottom - up.place(y) * (bottom - top)]
    };
    let mut drawing = Drawing::new(title, SIZE);
    let decade = |exponent: i32| format!("1e{exponent}").parse::<f64>().unwrap_or(1.0);
    let [low_x, low_y] = [across, up].map(|axis| decade(axis.decades[0]));
    let [high_x, high_y] = [across, up].map(|axis| decade(axis.decades[1]));
    for exponent in across.decades[0]..=across.decades[1] {
        let x = decade(exponent);
        drawing.line(&[at([x, low_y]), at([x, high_y])], "grid edge thin");
        drawing.small([at([x, low_y])[0], bottom + 18.0], "middle", &number(exponent));
    }
    for exponent in up.decades[0]..=up.decades[1] {
        let y = decade(exponent);
        drawing.line(&[at([low_x, y]), at([high_x, y])], "grid edge thin");
        drawing.small([left - 8.0, at([low_x, y])[1] + 4.0], "end", &number(exponent));
    }
    drawing.word([0.5 * (left + right), bottom + 40.0], "middle", across.title);
    drawing.word([left, top - 6.0], "start", up.title);
    for (k, curve) in curves.iter().enumerate() {
        let (color, line) = LOOKS[k % LOOKS.len()];
        let points: Vec<At> =
            curve.points.iter().filter(|point| point[1] > 0.0).map(|point| at(*point)).collect();
        drawing.line(&points, &format!("{color} {line}"));
        points.iter().for_each(|point| drawing.dot(*point, 3.5, &format!("{color} dot")));
        let y = top + 14.0 + 24.0 * k as f64;
        drawing.line(&[[right + 18.0, y], [right + 48.0, y]], &format!("{color} {line}"));
        drawing.small([right + 56.0, y + 4.0], "start", &curve.name);
    }
    drawing.svg()
}

/// A power of ten as people write it.
fn number(exponent: i32) -> String {
    match exponent {
        0.. => format!("1{}", "0".repeat(exponent as usize)),
        _ => format!("0.{}1", "0".repeat((-exponent - 1) as usize)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_ten_are_written_out() {
        assert_eq!([-3, -1, 0, 2].map(number), ["0.001", "0.1", "1", "100"]);
    }

    #[test]
    fn an_axis_goes_from_one_power_of_ten_to_another() {
        let axis = Axis { title: "", decades: [-2, 2] };
        assert!(
            [0.01, 1.0, 100.0]
                .map(|v| axis.place(v))
                .iter()
                .zip([0.0, 0.5, 1.0])
                .all(|(a, b)| (a - b).abs() < 1e-12)
        );
    }
}
