//! Parts of a scene as stages of their own: its polygons, its lines as static or as dynamic ones, drawn wider, more transparent, denser.

use super::amounts::rings;
use crate::draw_list::{Chain, DrawList, ItemStyle, Role};
use crate::error::Result;
use crate::scene::{Color, Feature, Fill, Join, Layer, Line, Outline, OutlineMode, Shape, Style, Width};
use crate::space::{Plan, PlanBox};
use crate::stage::Stage;
use crate::technique::Kind;
use std::sync::Arc;

/// Which part of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Decals {
    /// All of it, by stencil volumes (what the thesis compares with).
    Volumes,
    /// All of it, by static decals.
    Static,
    /// Fills, by static decals.
    Polygons,
    /// Fills without their holes, by static decals.
    Exterior,
    /// Lines and outlines, by static decals.
    StaticLines,
    /// Lines and outlines, by dynamic lines.
    DynamicLines,
}

impl Decals {
    /// How it is called in the tables.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Volumes => "stencil volumes",
            Self::Static => "static decals",
            Self::Polygons => "polygons",
            Self::Exterior => "exterior polygons",
            Self::StaticLines => "static lines",
            Self::DynamicLines => "dynamic lines",
        }
    }

    /// Which technique draws it.
    pub(super) const fn kind(self) -> Kind {
        match self {
            Self::Volumes => Kind::StencilVolume,
            Self::DynamicLines => Kind::DynamicLine,
            Self::Static | Self::Polygons | Self::Exterior | Self::StaticLines => Kind::StaticDecal,
        }
    }

    const fn has_lines(self) -> bool {
        !matches!(self, Self::Polygons | Self::Exterior)
    }

    const fn has_areas(self) -> bool {
        !matches!(self, Self::StaticLines | Self::DynamicLines)
    }
}

/// How a part is drawn; what is `None` is as in the scene.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Look {
    /// The width of all lines: metres of static ones, pixels of dynamic ones, which are [`PIXELS`] wide by default.
    pub(super) width: Option<f64>,
    /// The opacity of all lines.
    pub(super) opacity: Option<f64>,
    /// Their corners.
    pub(super) join: Option<Join>,
    /// One colour for all lines.
    pub(super) is_one_color: bool,
    /// All data drawn together by this factor, towards this point.
    pub(super) shrunk: Option<(f64, Plan)>,
}

/// How wide dynamic lines are by default.
const PIXELS: f64 = 2.0;

/// A part of a stage, on the same terrain; `None` where the scene has nothing of it.
pub(super) fn part(stage: &Stage, decals: Decals, look: &Look) -> Result<Option<Stage>> {
    let list = &stage.draw_list;
    let place = |p: &Plan| match look.shrunk {
        Some((factor, to)) => to + (*p - to) * factor,
        None => *p,
    };
    let vertices = |chain: &Chain| -> Vec<Plan> { list.vertices_of(chain).iter().map(place).collect() };
    let path = |chain: &Chain| -> Vec<Plan> { list.path_of(chain).iter().map(place).collect() };
    // A style an item's style, under the same number.
    let styles: Vec<Style> = list.styles().iter().map(|style| styled(style, decals, look)).collect();
    let mut layers: Vec<Layer> = Vec::new();
    let mut last = None;
    for (number, item) in list.numbered() {
        let shape = match list.style_of(number).role {
            Role::Fill if decals.has_areas() => {
                let mut members: Vec<Vec<Vec<Plan>>> = Vec::new();
                for (ring, is_outer) in rings(list, item, Role::Fill) {
                    match members.last_mut() {
                        Some(member) if !is_outer => {
                            if decals != Decals::Exterior {
                                member.push(vertices(ring));
                            }
                        }
                        _ => members.push(vec![vertices(ring)]),
                    }
                }
                Shape::MultiPolygon(members)
            }
            Role::Outline if decals.has_lines() => {
                Shape::Polygon(list.strokes(item).iter().map(vertices).collect())
            }
            Role::Line if decals.has_lines() => Shape::Line(list.strokes(item).iter().map(path).collect()),
            // Points are none of the thesis's decals, and neither is what lies outside of polygons.
            _ => continue,
        };
        if last != Some(item.layer) {
            last = Some(item.layer);
            let Layer { name, opacity, .. } = &stage.scene.layers[item.layer as usize];
            layers.push(Layer {
                name: name.clone(),
                styles: styles.clone(),
                features: Vec::new(),
                opacity: *opacity,
                outside: None,
            });
        }
        if let Some(layer) = layers.last_mut() {
            layer.features.push(Feature { index: item.number as usize, style: item.style, shape });
        }
    }
    if layers.is_empty() {
        return Ok(None);
    }
    let mut scene = stage.scene.clone();
    scene.layers = layers;
    let draw_list = DrawList::new(&mut scene.layers, &stage.mesh.plan_bounds())?;
    Stage::of_draw_list(scene, draw_list, Arc::clone(&stage.mesh)).map(Some)
}

/// The style of a feature that is one item.
fn styled(style: &ItemStyle, decals: Decals, look: &Look) -> Style {
    let stroke = style.stroke.map(|line| drawn(line, decals, look));
    match style.role {
        Role::Fill => Style { fill: Some(Fill { color: style.paint, rule: style.rule }), ..Style::default() },
        Role::Outline => {
            let outline = stroke.map(|line| Outline { line, mode: OutlineMode::Normal });
            Style { outline, ..Style::default() }
        }
        Role::Line => Style { line: stroke, ..Style::default() },
        Role::Outside | Role::Point => Style::default(),
    }
}

fn drawn(line: Line, decals: Decals, look: &Look) -> Line {
    let Color([r, g, b, a]) = line.color;
    let [r, g, b] = if look.is_one_color { [0.0, 0.0, 0.0] } else { [r, g, b] };
    let width = match (decals, line.width) {
        (Decals::DynamicLines, _) => Width::Pixels(look.width.unwrap_or(PIXELS)),
        (_, Width::Metres(width)) => Width::Metres(look.width.unwrap_or(width)),
        // What is so wide on the screen has no width in the plan; the thesis's static lines are metres wide (5.2.4).
        (_, Width::Pixels(width)) => Width::Metres(look.width.unwrap_or(width)),
    };
    Line {
        color: Color([r, g, b, look.opacity.unwrap_or(a)]),
        width,
        join: look.join.unwrap_or(line.join),
        cap: line.cap,
    }
}

/// A corner of the terrain in the north-east, far from features that are drawn together by half towards the south-west.
pub(super) fn empty_corner(bounds: &PlanBox) -> PlanBox {
    let size = bounds.max - bounds.min;
    PlanBox { min: bounds.min + size * 0.75, max: bounds.max }
}
