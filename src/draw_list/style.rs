//! How items look: the styles of layers, taken apart.

use crate::scene::{
    Cap, Color, Dash, Fill, Group, Join, Layer, Line, OutlineMode, Rule, Style, Swath, Width,
};
use std::collections::BTreeMap;

/// What an item is of its feature.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Role {
    /// The inside of a polygon.
    Fill,
    /// All of the terrain outside of a layer's polygons.
    Outside,
    /// The border of a polygon.
    Outline,
    /// A line.
    Line,
    /// Points: a disc around each.
    Point,
}

/// A side of a polygon's border.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Side {
    /// The points in the polygon.
    Inside,
    /// Those out of it.
    Outside,
}

/// How an item looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ItemStyle {
    /// What it is of its feature.
    pub role: Role,
    /// What it is painted with; the alpha has already been multiplied by the opacity.
    pub paint: Color,
    /// Which windings of its area's border are inside.
    pub rule: Rule,
    /// Of which side of its area's border its stroke counts; all of it where there is no such side.
    pub cut: Option<Side>,
    /// How its stroke is drawn; a fill has none.
    pub stroke: Option<Line>,
    /// What stroke its area is; `None` of other areas.
    pub swath: Option<Swath>,
    /// What it is composed with before it is drawn over what lies below; by itself where there is no group.
    pub group: Option<Group>,
}

impl ItemStyle {
    /// What it is, its rule and the side that counts, as tables for clients have them: 0 a fill, 1 what is outside, 2 an outline, 3 a line, 4 a point; 0 even-odd,
    /// 1 nonzero; 0 both sides, 1 the inside, 2 the outside.
    pub fn codes(&self) -> [u32; 3] {
        let role = match self.role {
            Role::Fill => 0,
            Role::Outside => 1,
            Role::Outline => 2,
            Role::Line => 3,
            Role::Point => 4,
        };
        let rule = match self.rule {
            Rule::EvenOdd => 0,
            Rule::NonZero => 1,
        };
        let cut = match self.cut {
            None => 0,
            Some(Side::Inside) => 1,
            Some(Side::Outside) => 2,
        };
        [role, rule, cut]
    }

    /// Numbers that two styles share only if they are equal.
    fn key(&self) -> [u64; 11] {
        let [r, g, b, a] = self.paint.0.map(f64::to_bits);
        // No width is negative.
        let swath = self.swath.map_or(u64::MAX, |of| of.width_m.to_bits() << 1 | u64::from(of.is_of_points));
        let line = self.stroke.map_or([0; 3], |line| {
            let (unit, width) = match line.width {
                Width::Metres(width) => (1, width),
                Width::Pixels(width) => (2, width),
            };
            let (join, limit) = match line.join {
                Join::Round => (0, 0.0),
                Join::Bevel => (1, 0.0),
                Join::Miter { limit } => (2, limit),
            };
            let cap = match line.cap {
                Cap::Butt => 0,
                Cap::Square => 1,
                Cap::Round => 2,
            };
            [width.to_bits(), limit.to_bits(), unit + 4 * join + 16 * cap]
        });
        let words = [self.role as u64, self.rule as u64, self.cut.map_or(0, |side| 1 + side as u64)];
        // A layer has one opacity.
        let group = self.group.map_or(0, |group| 1 + u64::from(group.layer));
        [r, g, b, a, line[0], line[1], line[2], words[0], words[1] + 4 * words[2], group, swath]
    }
}

/// The numbers of what a layer's style is taken apart into.
#[derive(Debug, Clone, Copy)]
pub(super) struct StyleParts {
    pub(super) fill: Option<u32>,
    pub(super) outline: Option<u32>,
    /// Whether the outline is cut to its polygon.
    pub(super) is_cut: bool,
    pub(super) line: Option<u32>,
    pub(super) point: Option<u32>,
    pub(super) outline_dash: Option<Dash>,
    pub(super) line_dash: Option<Dash>,
}

impl StyleParts {
    /// Whether its polygons' area counts: it is filled, or an outline is cut to it.
    pub(super) fn has_area(&self) -> bool {
        self.fill.is_some() || self.is_cut
    }

    /// Which windings are inside of its polygons, if their area counts.
    pub(super) fn area_rule(&self, styles: &[ItemStyle]) -> Option<Rule> {
        let style = self.fill.or(self.outline).filter(|_| self.has_area())?;
        Some(styles[style as usize].rule)
    }
}

/// Styles of items, each once.
#[derive(Debug, Default)]
pub(super) struct StyleTable {
    pub(super) styles: Vec<ItemStyle>,
    numbers: BTreeMap<[u64; 11], u32>,
}

impl StyleTable {
    /// Takes the styles of a scene's layer apart.
    pub(super) fn parts_of(&mut self, number: usize, layer: &Layer) -> Vec<StyleParts> {
        let group = group_of(number, layer);
        layer.styles.iter().map(|style| self.parts(style, layer.outside, group)).collect()
    }

    /// The style of what is outside of a scene's layer's polygons, if that is painted.
    pub(super) fn outside_of(&mut self, number: usize, layer: &Layer) -> Option<u32> {
        let fill = layer.outside?;
        Some(self.number(filled(Role::Outside, fill, group_of(number, layer))))
    }

    fn parts(&mut self, style: &Style, outside: Option<Fill>, group: Option<Group>) -> StyleParts {
        let rule = style.fill.or(outside).map_or(Rule::EvenOdd, |fill| fill.rule);
        let stroked = |role: Role, line: Line, cut: Option<Side>| {
            let rule = if cut.is_some() { rule } else { Rule::EvenOdd };
            ItemStyle { role, paint: line.color, rule, cut, stroke: Some(line), swath: None, group }
        };
        let fill = style.fill.map(|fill| ItemStyle { swath: style.swath, ..filled(Role::Fill, fill, group) });
        let outline = style.outline.map(|outline| {
            let cut = match outline.mode {
                OutlineMode::Inset => Some(Side::Inside),
                OutlineMode::Normal => None,
                OutlineMode::Offset => Some(Side::Outside),
            };
            stroked(Role::Outline, outline.line, cut)
        });
        let line = style.line.map(|line| stroked(Role::Line, line, None));
        let dot = |line: Line| Line { join: Join::Round, cap: Cap::Round, ..line };
        let point = style.point.map(|line| stroked(Role::Point, dot(line), None));
        StyleParts {
            is_cut: outline.is_some_and(|outline| outline.cut.is_some()),
            fill: fill.map(|style| self.number(style)),
            outline: outline.map(|style| self.number(style)),
            line: line.map(|style| self.number(style)),
            point: point.map(|style| self.number(style)),
            outline_dash: style.outline_dash,
            line_dash: style.line_dash,
        }
    }

    fn number(&mut self, style: ItemStyle) -> u32 {
        let fresh = self.styles.len() as u32;
        let number = *self.numbers.entry(style.key()).or_insert(fresh);
        if number == fresh {
            self.styles.push(style);
        }
        number
    }
}

/// The group of a scene's layer, if it is one.
fn group_of(number: usize, layer: &Layer) -> Option<Group> {
    (layer.opacity < 1.0).then_some(Group { layer: number as u32, opacity: layer.opacity })
}

fn filled(role: Role, fill: Fill, group: Option<Group>) -> ItemStyle {
    ItemStyle { role, paint: fill.color, rule: fill.rule, cut: None, stroke: None, swath: None, group }
}
