//! Edits of layers' styles.

use crate::scene::{Cap, Color, Fill, Join, Line, Outline, OutlineMode, Rule, Scene, Style, Surface, Width};

fn each_style(scene: &mut Scene, edit: impl Fn(&mut Style) -> bool) -> bool {
    let styles = scene.layers.iter_mut().flat_map(|layer| &mut layer.styles);
    styles.fold(false, |any, style| edit(style) | any)
}

/// Strokes of lines, outlines and points.
fn each_stroke(scene: &mut Scene, edit: impl Fn(&mut Line) -> bool) -> bool {
    each_style(scene, |style| {
        let outline = style.outline.as_mut().map(|outline| &mut outline.line);
        let strokes = [style.line.as_mut(), style.point.as_mut(), outline];
        strokes.into_iter().flatten().fold(false, |any, stroke| edit(stroke) | any)
    })
}

fn each_color(scene: &mut Scene, edit: impl Fn(Color) -> Color) -> bool {
    each_style(scene, |style| {
        let outline = style.outline.as_mut().map(|outline| &mut outline.line.color);
        let [line, point] =
            [&mut style.line, &mut style.point].map(|line| line.as_mut().map(|l| &mut l.color));
        let fill = style.fill.as_mut().map(|fill| &mut fill.color);
        let colors = [fill, outline, line, point].into_iter().flatten();
        colors.fold(false, |any, color| {
            let new = edit(*color);
            let is_new = new != *color;
            *color = new;
            any | is_new
        })
    })
}

fn widths_times(scene: &mut Scene, factor: f64) -> bool {
    each_stroke(scene, |stroke| {
        stroke.width = match stroke.width {
            Width::Metres(width) => Width::Metres(width * factor),
            Width::Pixels(width) => Width::Pixels(width * factor),
        };
        true
    })
}

pub(in super::super) fn a_twentieth_too_wide(scene: &mut Scene, _: &mut Surface) -> bool {
    widths_times(scene, 1.05)
}

pub(in super::super) fn a_tenth_too_narrow(scene: &mut Scene, _: &mut Surface) -> bool {
    widths_times(scene, 0.9)
}

pub(in super::super) fn twice_as_wide(scene: &mut Scene, _: &mut Surface) -> bool {
    widths_times(scene, 2.0)
}

pub(in super::super) fn half_as_wide(scene: &mut Scene, _: &mut Surface) -> bool {
    widths_times(scene, 0.5)
}

/// Widths as whole powers of two of a metre or pixel, as in texels of a level.
pub(in super::super) fn widths_in_texels(scene: &mut Scene, _: &mut Surface) -> bool {
    let texels = |width: f64| {
        let mut power = 1.0;
        while power < width {
            power *= 2.0;
        }
        power
    };
    each_stroke(scene, |stroke| {
        let before = stroke.width;
        stroke.width = match before {
            Width::Metres(width) => Width::Metres(texels(width)),
            Width::Pixels(width) => Width::Pixels(texels(width)),
        };
        stroke.width != before
    })
}

fn caps(scene: &mut Scene, from: Cap, to: Cap) -> bool {
    each_stroke(scene, |stroke| {
        let is_it = stroke.cap == from;
        stroke.cap = if is_it { to } else { stroke.cap };
        is_it
    })
}

pub(in super::super) fn square_caps_missing(scene: &mut Scene, _: &mut Surface) -> bool {
    caps(scene, Cap::Square, Cap::Butt)
}

pub(in super::super) fn round_caps_missing(scene: &mut Scene, _: &mut Surface) -> bool {
    caps(scene, Cap::Round, Cap::Butt)
}

pub(in super::super) fn square_for_round_caps(scene: &mut Scene, _: &mut Surface) -> bool {
    caps(scene, Cap::Round, Cap::Square)
}

pub(in super::super) fn caps_on_butts(scene: &mut Scene, _: &mut Surface) -> bool {
    caps(scene, Cap::Butt, Cap::Square)
}

fn joins(scene: &mut Scene, to: impl Fn(Join) -> Option<Join>) -> bool {
    each_stroke(scene, |stroke| {
        let new = to(stroke.join);
        stroke.join = new.unwrap_or(stroke.join);
        new.is_some()
    })
}

pub(in super::super) fn bevel_for_round(scene: &mut Scene, _: &mut Surface) -> bool {
    joins(scene, |join| (join == Join::Round).then_some(Join::Bevel))
}

pub(in super::super) fn round_for_bevel(scene: &mut Scene, _: &mut Surface) -> bool {
    joins(scene, |join| (join == Join::Bevel).then_some(Join::Round))
}

pub(in super::super) fn bevel_for_miter(scene: &mut Scene, _: &mut Surface) -> bool {
    joins(scene, |join| matches!(join, Join::Miter { .. }).then_some(Join::Bevel))
}

pub(in super::super) fn miter_without_limit(scene: &mut Scene, _: &mut Surface) -> bool {
    joins(scene, |join| matches!(join, Join::Miter { .. }).then_some(Join::Miter { limit: 1e6 }))
}

pub(in super::super) fn other_rule(scene: &mut Scene, _: &mut Surface) -> bool {
    each_style(scene, |style| {
        style.fill.as_mut().is_some_and(|fill| {
            fill.rule = if fill.rule == Rule::EvenOdd { Rule::NonZero } else { Rule::EvenOdd };
            true
        })
    })
}

fn modes(scene: &mut Scene, to: impl Fn(OutlineMode) -> OutlineMode) -> bool {
    each_style(scene, |style| {
        style.outline.as_mut().is_some_and(|outline| {
            let before = outline.mode;
            outline.mode = to(before);
            outline.mode != before
        })
    })
}

pub(in super::super) fn inset_for_offset(scene: &mut Scene, _: &mut Surface) -> bool {
    modes(scene, |mode| match mode {
        OutlineMode::Inset => OutlineMode::Offset,
        OutlineMode::Offset => OutlineMode::Inset,
        OutlineMode::Normal => OutlineMode::Normal,
    })
}

pub(in super::super) fn outlines_on_both_sides(scene: &mut Scene, _: &mut Surface) -> bool {
    modes(scene, |_| OutlineMode::Normal)
}

pub(in super::super) fn outlines_missing(scene: &mut Scene, _: &mut Surface) -> bool {
    each_style(scene, |style| style.outline.take().is_some())
}

pub(in super::super) fn fills_missing(scene: &mut Scene, _: &mut Surface) -> bool {
    each_style(scene, |style| style.fill.take().is_some())
}

/// Outlines have the fill's colour.
pub(in super::super) fn outlines_in_the_fill_s_colour(scene: &mut Scene, _: &mut Surface) -> bool {
    each_style(scene, |style| match (&mut style.outline, style.fill) {
        (Some(Outline { line, .. }), Some(Fill { color, .. })) => {
            line.color = color;
            true
        }
        _ => false,
    })
}

/// What is outside is painted in place of what is inside.
pub(in super::super) fn inside_out(scene: &mut Scene, _: &mut Surface) -> bool {
    scene.layers.iter_mut().fold(false, |any, layer| {
        let fill = layer.styles.iter_mut().find_map(|style| style.fill.take());
        let is_turned = fill.is_some() && layer.outside.is_none();
        layer.outside = fill.or(layer.outside);
        any | is_turned
    })
}

fn alphas(scene: &mut Scene, to: impl Fn(f64) -> f64) -> bool {
    each_color(scene, |Color([r, g, b, a])| Color([r, g, b, to(a)]))
}

pub(in super::super) fn opacity_twice(scene: &mut Scene, _: &mut Surface) -> bool {
    alphas(scene, |a| a * a)
}

pub(in super::super) fn alpha_dropped(scene: &mut Scene, _: &mut Surface) -> bool {
    alphas(scene, |_| 1.0)
}

pub(in super::super) fn a_little_less_opaque(scene: &mut Scene, _: &mut Surface) -> bool {
    alphas(scene, |a| if a < 1.0 { a - 0.03 } else { a })
}

/// Alpha in four bits.
pub(in super::super) fn alpha_in_four_bits(scene: &mut Scene, _: &mut Surface) -> bool {
    alphas(scene, |a| (a * 15.0).round() / 15.0)
}

pub(in super::super) fn premultiplied_twice(scene: &mut Scene, _: &mut Surface) -> bool {
    each_color(scene, |Color([r, g, b, a])| Color([r * a, g * a, b * a, a]))
}

/// Colours three codes off.
pub(in super::super) fn three_codes_off(scene: &mut Scene, _: &mut Surface) -> bool {
    let less = |v: f64| if v > 0.5 { v - 3.0 / 255.0 } else { v + 3.0 / 255.0 };
    each_color(scene, |Color([r, g, b, a])| Color([less(r), less(g), less(b), a]))
}

/// A layer's opacity is that of each of its features.
pub(in super::super) fn group_as_features(scene: &mut Scene, _: &mut Surface) -> bool {
    let has_group = scene.layers.iter().any(|layer| layer.opacity < 1.0);
    for layer in &mut scene.layers {
        let opacity = std::mem::replace(&mut layer.opacity, 1.0);
        for style in &mut layer.styles {
            let outline = style.outline.as_mut().map(|outline| &mut outline.line);
            let strokes = [style.line.as_mut(), style.point.as_mut(), outline].into_iter().flatten();
            strokes.for_each(|stroke| stroke.color = stroke.color.with_opacity(opacity));
            style.fill.iter_mut().for_each(|fill| fill.color = fill.color.with_opacity(opacity));
        }
    }
    has_group
}

pub(in super::super) fn group_ignored(scene: &mut Scene, _: &mut Surface) -> bool {
    scene.layers.iter_mut().fold(false, |any, layer| {
        let is_group = layer.opacity < 1.0;
        layer.opacity = 1.0;
        any | is_group
    })
}

/// A layer whose features show nothing, on top and below.
pub(in super::super) fn clear_layers_added(scene: &mut Scene, _: &mut Surface) -> bool {
    let Some(mut clear) = scene.layers.first().cloned() else { return false };
    for style in &mut clear.styles {
        let none = |color: &mut Color| *color = color.with_opacity(0.0);
        style.fill.iter_mut().for_each(|fill| none(&mut fill.color));
        style.outline.iter_mut().for_each(|outline| none(&mut outline.line.color));
        [&mut style.line, &mut style.point].into_iter().flatten().for_each(|line| none(&mut line.color));
    }
    scene.layers.insert(0, clear.clone());
    scene.layers.push(clear);
    true
}
