//! Drafts that say less.

use super::draft::Draft;
use crate::scene::{Cap, Color, Join, Line, OutlineMode, Rule};
use toml::{Table, Value};

/// All drafts that leave one setting out, larger things first.
pub(super) fn plainer(draft: &Draft) -> Vec<Draft> {
    let mut all = of_the_head(draft);
    all.extend(of_the_terrain(draft));
    for k in 0..draft.layers.len() {
        all.extend(of_a_layer(draft, k));
    }
    all.extend(camera(draft));
    all
}

/// Without a table of settings, or a key of one.
fn of_the_head(draft: &Draft) -> Vec<Draft> {
    let mut all = Vec::new();
    for name in ["technique", "compositing", "device"] {
        let Some(Value::Table(table)) = draft.head.get(name) else { continue };
        all.push(with(draft, |head| drop(head.remove(name))));
        for key in table.keys() {
            all.push(with(draft, |head| {
                if let Some(Value::Table(table)) = head.get_mut(name) {
                    table.remove(key);
                }
            }));
        }
    }
    all
}

fn with(draft: &Draft, edit: impl FnOnce(&mut Table)) -> Draft {
    let mut plainer = draft.clone();
    edit(&mut plainer.head);
    plainer
}

/// What a terrain can do without: colours, levels, and posts.
fn of_the_terrain(draft: &Draft) -> Vec<Draft> {
    let Some(Value::Table(terrain)) = draft.head.get("terrain") else { return Vec::new() };
    let change = |edit: &dyn Fn(&mut Table)| {
        with(draft, |head| {
            if let Some(Value::Table(terrain)) = head.get_mut("terrain") {
                edit(terrain);
            }
        })
    };
    let mut all = Vec::new();
    for key in ["imagery", "light", "shade", "lod", "diagonal", "vertical_scale", "color"] {
        if terrain.contains_key(key) {
            all.push(change(&|terrain| drop(terrain.remove(key))));
        }
    }
    if let Some(posts) = terrain.get("generate").and_then(|made| made.get("posts")).and_then(Value::as_array)
    {
        let counts: Vec<i64> = posts.iter().filter_map(Value::as_integer).collect();
        // Half as many cells a side, around the same middle: as far apart, or twice.
        let fewer: Vec<Value> = counts.iter().map(|n| Value::from(((n - 1) / 2).max(1) + 1)).collect();
        if counts.iter().any(|n| *n > 2) {
            all.push(change(&|terrain| {
                if let Some(Value::Table(made)) = terrain.get_mut("generate") {
                    made.insert("posts".into(), Value::Array(fewer.clone()));
                }
            }));
        }
    }
    all
}

/// Of a layer: opacity, joins, caps, sides, rule.
fn of_a_layer(draft: &Draft, k: usize) -> Vec<Draft> {
    let layer = &draft.layers[k];
    let mut all = Vec::new();
    let mut change = |edit: &dyn Fn(&mut super::draft::DraftLayer)| {
        let mut plainer = draft.clone();
        edit(&mut plainer.layers[k]);
        if plainer != *draft {
            all.push(plainer);
        }
    };
    let is_area = layer.features.iter().any(crate::scene::Shape::is_area);
    if layer.style.outline.is_some() && (layer.style.fill.is_some() || !is_area) {
        change(&|layer| layer.style.outline = None);
    }
    if layer.style.outline.is_some() {
        change(&|layer| layer.style.fill = None);
    }
    if layer.style.line.is_some() && layer.features.iter().all(crate::scene::Shape::is_area) {
        change(&|layer| layer.style.line = None);
    }
    change(&|layer| layer.opacity = 1.0);
    let opaque = |Color([r, g, b, _]): Color| Color([r, g, b, 1.0]);
    change(&|layer| {
        layer.style.fill.iter_mut().for_each(|fill| fill.color = opaque(fill.color));
        strokes(layer).into_iter().for_each(|line| line.color = opaque(line.color));
    });
    change(&|layer| layer.style.fill.iter_mut().for_each(|fill| fill.rule = Rule::EvenOdd));
    change(&|layer| {
        layer.style.outline.iter_mut().for_each(|outline| outline.mode = OutlineMode::Normal);
    });
    change(&|layer| (layer.style.line_dash, layer.style.outline_dash) = (None, None));
    change(&|layer| strokes(layer).into_iter().for_each(|line| line.join = Join::Round));
    change(&|layer| strokes(layer).into_iter().for_each(|line| line.cap = Cap::Butt));
    all
}

fn strokes(layer: &mut super::draft::DraftLayer) -> Vec<&mut Line> {
    let outline = layer.style.outline.as_mut().map(|outline| &mut outline.line);
    [layer.style.line.as_mut(), outline].into_iter().flatten().collect()
}

fn camera(draft: &Draft) -> Vec<Draft> {
    let mut all = Vec::new();
    if draft.camera.far_m.is_some() {
        let mut plainer = draft.clone();
        plainer.camera.far_m = None;
        all.push(plainer);
    }
    if draft.camera.near_m != 1.0 {
        let mut plainer = draft.clone();
        plainer.camera.near_m = 1.0;
        all.push(plainer);
    }
    all
}
