//! How items are drawn, and what is kept of them.

use crate::draw_list::{DrawList, ItemStyle, Role, Side};
use crate::error::Result;
use crate::math;
use crate::resolve::Compositor;
use crate::scene::{Compositing, Line, Rule, Width};
use crate::technique::clipmap::raster::Ink;
use crate::technique::clipmap::tessellation::Rule as Tessellation;
use crate::technique::clipmap::{Joints, Settings, Solution};

/// What is kept of a stroke.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::technique::clipmap) enum Keep {
    /// Vertices (solution 1).
    Lines,
    /// Strips (solutions 2 and 3b).
    Strips,
    /// Both (solution 3a).
    Both,
    /// Vertices with those before and after a line (solution 4a).
    Adjacency,
    /// Vertices with offsets (solution 4b).
    Offsets,
}

impl Keep {
    /// What a solution keeps of lines of a width. Polygons would have to be made anew for each width: lines whose width depends on
    /// the level or on the view are tessellated whenever they are drawn.
    fn of(solution: Solution, width: Width) -> Self {
        match (solution, width) {
            (Solution::Lines, _) => Self::Lines,
            (Solution::Polygons | Solution::Wireframe, Width::Metres(_)) => Self::Strips,
            (Solution::Both, Width::Metres(_)) => Self::Both,
            (Solution::Polygons | Solution::Wireframe | Solution::Both, Width::Pixels(_)) => Self::Adjacency,
            (Solution::Adjacency, _) => Self::Adjacency,
            (Solution::Offsets, _) => Self::Offsets,
        }
    }

    /// Whether strips are stored.
    pub(super) fn has_strips(self) -> bool {
        matches!(self, Self::Strips | Self::Both | Self::Offsets)
    }
}

/// How strokes of one style are drawn.
#[derive(Debug, Clone)]
pub(in crate::technique::clipmap) struct StrokeStyle {
    /// How they are tessellated.
    pub(in crate::technique::clipmap) tessellation: Tessellation,
    /// How wide they are.
    pub(in crate::technique::clipmap) width: Width,
    /// What they are painted with.
    pub(in crate::technique::clipmap) ink: Ink,
    /// What is kept of them.
    pub(in crate::technique::clipmap) keep: Keep,
    /// Whether they are points, which are never line primitives.
    pub(in crate::technique::clipmap) is_point: bool,
    /// The side of their polygon that counts.
    pub(in crate::technique::clipmap) cut: Option<Side>,
    /// Which windings are inside that polygon.
    pub(in crate::technique::clipmap) cut_rule: Rule,
    /// How far from their vertices they may reach, in half widths.
    pub(in crate::technique::clipmap) reach: f64,
}

/// How areas of one style are drawn.
#[derive(Debug, Clone, Copy)]
pub(in crate::technique::clipmap) struct FillStyle {
    /// What they are painted with.
    pub(in crate::technique::clipmap) ink: Ink,
    /// What is inside.
    pub(in crate::technique::clipmap) rule: Rule,
}

/// How items of one style are drawn.
#[derive(Debug, Clone)]
pub(in crate::technique::clipmap) enum Drawn {
    Fill(FillStyle),
    Stroke(StrokeStyle),
}

/// How items are drawn, by the numbers of their styles in the draw list.
#[derive(Debug)]
pub(in crate::technique::clipmap) struct Styles {
    all: Vec<Drawn>,
    /// The farthest that strokes of widths in metres reach from their vertices, metres, and those of widths in pixels, pixels; `None`
    /// where there are no such.
    reach: [Option<f64>; 2],
}

impl Styles {
    /// The styles of a draw list.
    ///
    /// # Errors
    /// When lines cannot be tessellated so.
    pub(super) fn new(list: &DrawList, settings: &Settings, compositing: Compositing) -> Result<Self> {
        let compositor = Compositor::new(compositing);
        let stroke = |style: &ItemStyle, line: &Line, ink: Ink| -> Result<StrokeStyle> {
            // The paper has no points: they are strips by their caps, whatever lines are.
            let is_point = style.role == Role::Point;
            let joints = if is_point { Joints::Style } else { settings.joints };
            let keep = if is_point { Keep::Adjacency } else { Keep::of(settings.solution, line.width) };
            Ok(StrokeStyle {
                tessellation: Tessellation::of_line(joints, settings.angle_deg, line)?,
                width: line.width,
                ink,
                keep,
                is_point,
                cut: style.cut,
                cut_rule: style.rule,
                reach: 1.0,
            })
        };
        let drawn = |style: &ItemStyle| {
            let ink = Ink::new(compositor.paint(style.paint), compositing.mode);
            match &style.stroke {
                None => Ok(Drawn::Fill(FillStyle { ink, rule: style.rule })),
                Some(line) => stroke(style, line, ink).map(Drawn::Stroke),
            }
        };
        let mut styles =
            Self { all: list.styles().iter().map(drawn).collect::<Result<_>>()?, reach: [None; 2] };
        styles.measure();
        Ok(styles)
    }

    /// How items of a style are drawn.
    #[inline]
    pub(in crate::technique::clipmap) fn get(&self, style: u32) -> &Drawn {
        &self.all[style as usize]
    }

    /// The farthest that strokes of widths in metres reach from their vertices, metres, and those of widths in pixels, pixels; `None`
    /// where there are no such.
    pub(in crate::technique::clipmap) fn reach(&self) -> [Option<f64>; 2] {
        self.reach
    }

    /// Takes note of how far strokes of a style reach, in half widths.
    pub(super) fn widen(&mut self, reaches: impl IntoIterator<Item = (u32, f64)>) {
        for (style, reach) in reaches {
            if let Drawn::Stroke(stroke) = &mut self.all[style as usize] {
                stroke.reach = math::max(stroke.reach, reach);
            }
        }
        self.measure();
    }

    /// Changes all widths in metres by a factor.
    pub(super) fn scale(&mut self, factor: f64) {
        for stroke in self.all.iter_mut() {
            if let Drawn::Stroke(StrokeStyle { width: Width::Metres(width), .. }) = stroke {
                *width *= factor;
            }
        }
        self.measure();
    }

    /// The styles of strokes.
    pub(super) fn strokes(&self) -> impl Iterator<Item = &StrokeStyle> {
        self.all.iter().filter_map(|drawn| match drawn {
            Drawn::Stroke(stroke) => Some(stroke),
            Drawn::Fill(_) => None,
        })
    }

    fn measure(&mut self) {
        let mut reach = [None; 2];
        for stroke in self.strokes() {
            let (unit, width) = match stroke.width {
                Width::Metres(width) => (0, width),
                Width::Pixels(width) => (1, width),
            };
            let own = 0.5 * width * stroke.reach;
            reach[unit] = Some(reach[unit].map_or(own, |known| math::max(known, own)));
        }
        self.reach = reach;
    }
}
