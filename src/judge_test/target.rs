//! Blending as in a target of 8-bit codes: each blend is rounded.

use super::edit::Picture;
use crate::buffer::Buffer;
use crate::error::Result;
use crate::scene::{BlendMode, BlendSpace, Color, Feature, Layer, Scene, Style};
use crate::technique::stencil_volume::{Grouping, Settings};

/// The picture of a scene whose items are blended one by one into codes; `draw` draws a scene. `None`: its items are not blended so, in
/// codes of opaque pixels of one sample, each by itself.
pub(super) fn blended(scene: &Scene, draw: &dyn Fn(Scene) -> Result<Picture>) -> Result<Option<Picture>> {
    let settings: Settings = scene.technique.get();
    let is_plain = scene.compositing.space == BlendSpace::Encoded
        && scene.compositing.mode == BlendMode::Over
        && scene.image.background.0[3] == 1.0
        && scene.layers.iter().all(|layer| layer.opacity == 1.0 && layer.outside.is_none())
        && settings.samples == 1
        && settings.grouping == Grouping::Object;
    if !is_plain {
        return Ok(None);
    }
    let with = |layers: Vec<Layer>| draw(Scene { layers, ..scene.clone() });
    let bare = with(Vec::new())?;
    let mut codes = bare.values().to_vec();
    for (layer, Color([r, g, b, a])) in items(scene) {
        let alone = with(vec![layer])?;
        let covered = alone.values().iter().zip(bare.values()).map(|(one, none)| one != none);
        for (code, _) in codes.iter_mut().zip(covered).filter(|(_, is_covered)| *is_covered) {
            let blend = |under: u8, over: f64| (over * a * 255.0 + f64::from(under) * (1.0 - a) + 0.5) as u8;
            *code = [blend(code[0], r), blend(code[1], g), blend(code[2], b), code[3]];
        }
    }
    Ok(Some(Buffer::from_values(bare.width(), bare.height(), codes)))
}

/// The items in draw order, each a layer of its own in a colour that nothing else has, and its own colour.
fn items(scene: &Scene) -> Vec<(Layer, Color)> {
    const MARK: Color = Color([1.0, 0.0, 1.0, 1.0]);
    let mut items = Vec::new();
    for layer in &scene.layers {
        for feature in &layer.features {
            let style = *layer.style_of(feature);
            let mut add = |color: Option<Color>, style: Style| {
                let features = vec![Feature { style: 0, ..feature.clone() }];
                items.extend(
                    color.map(|color| (Layer { styles: vec![style], features, ..layer.clone() }, color)),
                );
            };
            let only = Style::default();
            let fill = style.fill.map(|fill| crate::scene::Fill { color: MARK, ..fill });
            add(style.fill.filter(|_| feature.shape.is_area()).map(|of| of.color), Style { fill, ..only });
            let mut outline = style.outline;
            outline.iter_mut().for_each(|outline| outline.line.color = MARK);
            // The polygon's rule is its fill's, which says what is inside of an outline too.
            let clear = style.fill.map(|fill| crate::scene::Fill { color: MARK.with_opacity(0.0), ..fill });
            let color = style.outline.filter(|_| feature.shape.is_area()).map(|of| of.line.color);
            add(color, Style { outline, fill: clear, ..only });
            let mark = |line: crate::scene::Line| crate::scene::Line { color: MARK, ..line };
            let is_line = matches!(feature.shape, crate::scene::Shape::Line(_));
            add(
                style.line.filter(|_| is_line).map(|of| of.color),
                Style { line: style.line.map(mark), ..only },
            );
            let is_point = matches!(feature.shape, crate::scene::Shape::Points(_));
            add(
                style.point.filter(|_| is_point).map(|of| of.color),
                Style { point: style.point.map(mark), ..only },
            );
        }
    }
    items
}
