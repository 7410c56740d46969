//! How the layers' items look, and what is kept of them.

use super::limit::{MOST, too_many};
use crate::error::Result;
use crate::resolve::Compositor;
use crate::scene::{Clipmap, Compositing, Layer, Line, OutlineMode, Rule, Solution, Width};
use crate::technique::clipmap::raster::Ink;
use crate::technique::clipmap::tessellation::Rule as Tessellation;

/// What a stroke's layer keeps.
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

/// How the strokes of a layer look.
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
    /// What their polygon cuts off.
    pub(in crate::technique::clipmap) mode: OutlineMode,
    /// How far from their vertices they may reach, in half widths.
    pub(in crate::technique::clipmap) reach: f64,
}

/// How the areas of a layer look.
#[derive(Debug, Clone, Copy)]
pub(in crate::technique::clipmap) struct FillStyle {
    /// What they are painted with.
    pub(in crate::technique::clipmap) ink: Ink,
    /// What is inside.
    pub(in crate::technique::clipmap) rule: Rule,
}

/// The items of a layer.
#[derive(Debug, Clone)]
pub(in crate::technique::clipmap) struct LayerItems {
    pub(super) first_item: u32,
    pub(in crate::technique::clipmap) fill: Option<FillStyle>,
    pub(in crate::technique::clipmap) outline: Option<StrokeStyle>,
    pub(in crate::technique::clipmap) line: Option<StrokeStyle>,
}

/// What an item is of its feature.
#[derive(Debug, Clone, Copy)]
pub(in crate::technique::clipmap) enum Role<'g> {
    Fill(&'g FillStyle),
    Stroke(&'g StrokeStyle),
}

/// Items of a feature where polygons are drawn: its fill, its outline, its line, most of them empty.
const OF_POLYGONS: u32 = 3;

impl LayerItems {
    /// The styles of all layers and the numbers of their items.
    ///
    /// # Errors
    /// When there are too many features.
    pub(super) fn of_layers(
        layers: &[Layer],
        settings: &Clipmap,
        compositing: Compositing,
    ) -> Result<Vec<Self>> {
        let compositor = Compositor::new(compositing);
        let mut first_item = 0;
        let mut items = Vec::new();
        for layer in layers {
            let stroke = |line: &Line, mode: OutlineMode| -> Result<StrokeStyle> {
                Ok(StrokeStyle {
                    tessellation: Tessellation::of_line(settings.joints, settings.angle_deg, line)?,
                    width: line.width,
                    ink: Ink::new(compositor.paint(line.color), compositing.mode),
                    keep: Keep::of(settings.solution, line.width),
                    mode,
                    reach: 1.0,
                })
            };
            let style = &layer.styles[0];
            let fill = style.fill.map(|f| FillStyle {
                ink: Ink::new(compositor.paint(f.color), compositing.mode),
                rule: f.rule,
            });
            let of_layer = Self {
                first_item: first_item as u32,
                fill,
                outline: style.outline.map(|o| stroke(&o.line, o.mode)).transpose()?,
                line: style.line.map(|line| stroke(&line, OutlineMode::Normal)).transpose()?,
            };
            first_item += of_layer.per_feature() as usize * layer.features.len();
            if first_item > MOST {
                return Err(too_many("features"));
            }
            items.push(of_layer);
        }
        Ok(items)
    }

    /// How many items a feature has.
    fn per_feature(&self) -> u32 {
        if self.fill.is_some() || self.outline.is_some() { OF_POLYGONS } else { 1 }
    }

    /// The items of a feature: its fill's, its outline's, its line's.
    pub(super) fn items(&self, feature: usize) -> [u32; 3] {
        let first = self.first_item + self.per_feature() * feature as u32;
        [first, first + 1, first + self.per_feature() - 1]
    }

    /// What an item of the layer is.
    pub(super) fn role(&self, item: u32) -> Option<Role<'_>> {
        let per_feature = self.per_feature();
        match (per_feature, (item - self.first_item) % per_feature) {
            (OF_POLYGONS, 0) => self.fill.as_ref().map(Role::Fill),
            (OF_POLYGONS, 1) => self.outline.as_ref().map(Role::Stroke),
            _ => self.line.as_ref().map(Role::Stroke),
        }
    }
}
