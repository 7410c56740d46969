//! Numbers as bars.

use super::drawing::Drawing;

/// A group of bars: its name, and names with values.
pub(super) struct Group {
    pub(super) name: String,
    pub(super) bars: Vec<(String, f64)>,
}

const LEFT: f64 = 120.0;
const WIDTH: f64 = 640.0;
const ROW: f64 = 24.0;

/// Groups of bars, each as long as its value, which stands beside it as a percentage.
pub(super) fn percentages(title: &str, groups: &[Group]) -> String {
    let rows: usize = groups.iter().map(|group| group.bars.len() + 1).sum();
    let values = groups.iter().flat_map(|group| &group.bars).map(|(_, value)| *value);
    let most = values.fold(1e-12, crate::math::max);
    let mut drawing = Drawing::new(title, [WIDTH, ROW * (rows as f64 + 0.6)]);
    let mut y = 0.3 * ROW;
    for group in groups {
        drawing.word([8.0, y + 0.72 * ROW], "start", &group.name);
        y += ROW;
        for (name, value) in &group.bars {
            let length = (WIDTH - LEFT - 70.0) * value / most;
            let ring = [[0.0, 0.15], [length, 0.15], [length, 0.85], [0.0, 0.85]];
            drawing.ring(&ring.map(|[x, share]| [LEFT + x, y + share * ROW]), "blue area full");
            drawing.small([LEFT - 8.0, y + 0.66 * ROW], "end", name);
            drawing.small([LEFT + length + 6.0, y + 0.66 * ROW], "start", &format!("{value:.0} %"));
            y += ROW;
        }
    }
    drawing.svg()
}
