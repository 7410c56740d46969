//! Edits of features' shapes.

use crate::math::max;
use crate::scene::{Feature, Scene, Shape, Surface};
use crate::space::{Plan, PlanBox};
use glam::DVec2;

/// Whether an edit made features other than they were.
fn each_feature(scene: &mut Scene, edit: impl Fn(&mut Feature) -> bool) -> bool {
    let features = scene.layers.iter_mut().flat_map(|layer| &mut layer.features);
    features.fold(false, |any, feature| edit(feature) | any)
}

/// Of the first feature of which an edit makes another.
fn first_feature(scene: &mut Scene, edit: impl Fn(&mut Feature) -> bool) -> bool {
    scene.layers.iter_mut().flat_map(|layer| &mut layer.features).any(edit)
}

fn parts(shape: &mut Shape) -> Vec<&mut Vec<Plan>> {
    match shape {
        Shape::Polygon(parts) | Shape::Line(parts) => parts.iter_mut().collect(),
        Shape::MultiPolygon(members) => members.iter_mut().flatten().collect(),
        Shape::Points(points) => vec![points],
        Shape::Swath { members, lines } => members.iter_mut().flatten().chain(lines).collect(),
    }
}

/// Every vertex is elsewhere.
fn each_vertex(scene: &mut Scene, edit: impl Fn(Plan) -> Plan) -> bool {
    each_feature(scene, |feature| {
        parts(&mut feature.shape).into_iter().flatten().for_each(|p| *p = edit(*p));
        true
    })
}

/// How far features reach, metres.
fn extent(scene: &Scene) -> f64 {
    let features = scene.layers.iter().flat_map(|layer| &layer.features);
    let points = features.flat_map(|feature| feature.shape.parts()).flatten();
    let reach = points.map(|p| max(p.x.abs(), p.y.abs()));
    reach.fold(0.0, max)
}

/// The last line of the last layer that has several, or one.
pub(in super::super) fn line_missing(scene: &mut Scene, _: &mut Surface) -> bool {
    last_missing(scene, |shape| matches!(shape, Shape::Line(_)))
}

/// The last polygon.
pub(in super::super) fn polygon_missing(scene: &mut Scene, _: &mut Surface) -> bool {
    last_missing(scene, Shape::is_area)
}

fn last_missing(scene: &mut Scene, is_it: impl Fn(&Shape) -> bool) -> bool {
    scene.layers.iter_mut().rev().any(|layer| {
        let found = layer.features.iter().rposition(|feature| is_it(&feature.shape));
        found.map(|at| layer.features.remove(at)).is_some()
    })
}

pub(in super::super) fn first_layer_missing(scene: &mut Scene, _: &mut Surface) -> bool {
    scene.layers.first_mut().is_some_and(|layer| {
        layer.features.clear();
        true
    })
}

/// Of each layer only its first feature.
pub(in super::super) fn first_features_only(scene: &mut Scene, _: &mut Surface) -> bool {
    scene.layers.iter_mut().fold(false, |any, layer| {
        let is_longer = layer.features.len() > 1;
        layer.features.truncate(1);
        any | is_longer
    })
}

/// Where two features of a layer may lie on one another.
pub(in super::super) fn features_reversed(scene: &mut Scene, _: &mut Surface) -> bool {
    scene.layers.iter_mut().fold(false, |any, layer| {
        let boxes: Vec<PlanBox> = layer.features.iter().map(|feature| around(&feature.shape)).collect();
        let meets = |k: usize| boxes[..k].iter().any(|other| other.meets(&boxes[k]));
        let is_other = (0..boxes.len()).any(meets);
        layer.features.reverse();
        any | is_other
    })
}

fn around(shape: &Shape) -> PlanBox {
    PlanBox::around(shape.parts().flatten().copied())
}

pub(in super::super) fn layers_reversed(scene: &mut Scene, _: &mut Surface) -> bool {
    scene.layers.reverse();
    scene.layers.len() > 1
}

/// The middle vertex of a line lies a fiftieth of the data's extent elsewhere.
pub(in super::super) fn line_vertex_moved(scene: &mut Scene, _: &mut Surface) -> bool {
    vertex_moved(scene, |shape| matches!(shape, Shape::Line(_)))
}

/// A corner of a polygon does.
pub(in super::super) fn corner_moved(scene: &mut Scene, _: &mut Surface) -> bool {
    vertex_moved(scene, Shape::is_area)
}

fn vertex_moved(scene: &mut Scene, is_it: impl Fn(&Shape) -> bool) -> bool {
    let by = DVec2::splat(extent(scene) / 50.0);
    first_feature(scene, |feature| {
        if !is_it(&feature.shape) {
            return false;
        }
        let mut parts = parts(&mut feature.shape);
        let middle = parts.first_mut().and_then(|part| {
            let half = part.len() / 2;
            part.get_mut(half)
        });
        middle.map(|p| *p = *p + by).is_some()
    })
}

/// Lines end a vertex early.
pub(in super::super) fn last_vertices_dropped(scene: &mut Scene, _: &mut Surface) -> bool {
    each_feature(scene, |feature| match &mut feature.shape {
        Shape::Line(parts) => parts.iter_mut().fold(false, |any, part| {
            let is_long = part.len() > 2;
            part.truncate(if is_long { part.len() - 1 } else { part.len() });
            any | is_long
        }),
        _ => false,
    })
}

/// Of rings the last vertex is missing.
pub(in super::super) fn last_corners_dropped(scene: &mut Scene, _: &mut Surface) -> bool {
    each_feature(scene, |feature| {
        feature.shape.is_area()
            && parts(&mut feature.shape).into_iter().fold(false, |any, ring| {
                let is_long = ring.len() > 3;
                ring.truncate(if is_long { ring.len() - 1 } else { ring.len() });
                any | is_long
            })
    })
}

/// Lines run back to where they began.
pub(in super::super) fn lines_closed(scene: &mut Scene, _: &mut Surface) -> bool {
    each_line(scene, |part| match part.first().copied().filter(|_| part.len() > 2) {
        Some(first) => {
            part.push(first);
            true
        }
        None => false,
    })
}

fn each_line(scene: &mut Scene, edit: impl Fn(&mut Vec<Plan>) -> bool) -> bool {
    each_feature(scene, |feature| match &mut feature.shape {
        Shape::Line(parts) => parts.iter_mut().fold(false, |any, part| edit(part) | any),
        _ => false,
    })
}

pub(in super::super) fn holes_dropped(scene: &mut Scene, _: &mut Surface) -> bool {
    each_feature(scene, |feature| match &mut feature.shape {
        Shape::Polygon(rings) => {
            let has_hole = rings.len() > 1;
            rings.truncate(1);
            has_hole
        }
        _ => false,
    })
}

/// Only the holes are filled.
pub(in super::super) fn shells_dropped(scene: &mut Scene, _: &mut Surface) -> bool {
    each_feature(scene, |feature| match &mut feature.shape {
        Shape::Polygon(rings) if rings.len() > 1 => {
            rings.remove(0);
            true
        }
        _ => false,
    })
}

/// Segments of a line one by one, all one feature: nothing joins them.
pub(in super::super) fn joins_missing(scene: &mut Scene, _: &mut Surface) -> bool {
    each_feature(scene, |feature| match &mut feature.shape {
        Shape::Line(parts) => {
            let is_long = parts.iter().any(|part| part.len() > 2);
            *parts = parts.iter().flat_map(|part| part.windows(2).map(<[Plan]>::to_vec)).collect();
            is_long
        }
        _ => false,
    })
}

/// Segments of a line one by one, each a feature: they are blended over one another where they meet.
pub(in super::super) fn segments_blended(scene: &mut Scene, _: &mut Surface) -> bool {
    scene.layers.iter_mut().fold(false, |any, layer| {
        let before = layer.features.len();
        let split = |feature: &Feature| -> Vec<Feature> {
            let Shape::Line(parts) = &feature.shape else { return vec![feature.clone()] };
            let segments = parts.iter().flat_map(|part| part.windows(2));
            let alone =
                |segment: &[Plan]| Feature { shape: Shape::Line(vec![segment.to_vec()]), ..feature.clone() };
            segments.map(alone).collect()
        };
        layer.features = layer.features.iter().flat_map(split).collect();
        any | (layer.features.len() > before)
    })
}

/// Every feature twice.
pub(in super::super) fn features_twice(scene: &mut Scene, _: &mut Surface) -> bool {
    for layer in &mut scene.layers {
        layer.features =
            layer.features.iter().flat_map(|feature| [feature.clone(), feature.clone()]).collect();
    }
    true
}

/// East and north change places.
pub(in super::super) fn axes_swapped(scene: &mut Scene, _: &mut Surface) -> bool {
    each_vertex(scene, |p| Plan::new(p.y, p.x))
}

/// Vertices in whole metres.
pub(in super::super) fn vertices_in_whole_metres(scene: &mut Scene, _: &mut Surface) -> bool {
    let is_whole = |p: Plan| p.x.fract() == 0.0 && p.y.fract() == 0.0;
    let features = scene.layers.iter().flat_map(|layer| &layer.features);
    let any = features.flat_map(|feature| feature.shape.parts()).flatten().any(|p| !is_whole(*p));
    each_vertex(scene, |p| Plan::new(p.x.round(), p.y.round())) && any
}

/// The origin is taken from absolute coordinates in single precision.
pub(in super::super) fn origin_in_single_precision(scene: &mut Scene, _: &mut Surface) -> bool {
    let origin = scene.origin;
    let single = |v: f64, origin: f64| f64::from((v + origin) as f32) - origin;
    each_vertex(scene, |p| Plan::new(single(p.x, origin.x), single(p.y, origin.y)))
        && max(origin.x.abs(), origin.y.abs()) > 1e5
}

/// The whole data lie a hundredth of their extent too far east.
pub(in super::super) fn data_moved_east(scene: &mut Scene, _: &mut Surface) -> bool {
    let by = DVec2::new(extent(scene) / 100.0, 0.0);
    each_vertex(scene, |p| p + by)
}

/// Data are a hundredth too large.
pub(in super::super) fn data_scaled(scene: &mut Scene, _: &mut Surface) -> bool {
    each_vertex(scene, |p| Plan::from(p.to_vec() * 1.01))
}

/// Segments have a further vertex in their middles: the same line.
pub(in super::super) fn segments_split(scene: &mut Scene, _: &mut Surface) -> bool {
    // Where coordinates are multiples of a small power of two, middles are exact.
    each_feature(scene, |feature| match &mut feature.shape {
        Shape::Points(_) => false,
        shape => {
            let is_area = shape.is_area();
            for part in parts(shape) {
                let closing = if is_area { part.first().copied() } else { None };
                let ends: Vec<Plan> = part.iter().copied().chain(closing).collect();
                let middle = |pair: &[Plan]| Plan::from((pair[0].to_vec() + pair[1].to_vec()) / 2.0);
                let mut split: Vec<Plan> = ends.windows(2).flat_map(|pair| [pair[0], middle(pair)]).collect();
                split.extend(ends.last().filter(|_| !is_area));
                *part = split;
            }
            true
        }
    })
}

/// Rings begin elsewhere.
pub(in super::super) fn rings_rotated(scene: &mut Scene, _: &mut Surface) -> bool {
    each_feature(scene, |feature| {
        feature.shape.is_area()
            && parts(&mut feature.shape).into_iter().fold(false, |any, ring| {
                let by = ring.len().min(2);
                ring.rotate_left(by);
                any | (by > 0)
            })
    })
}

/// Rings run the other way.
pub(in super::super) fn rings_reversed(scene: &mut Scene, _: &mut Surface) -> bool {
    each_feature(scene, |feature| {
        feature.shape.is_area() && {
            parts(&mut feature.shape).into_iter().for_each(|ring| ring.reverse());
            true
        }
    })
}

/// Lines run the other way.
pub(in super::super) fn lines_reversed(scene: &mut Scene, _: &mut Surface) -> bool {
    each_line(scene, |part| {
        part.reverse();
        true
    })
}

/// A vertex of each part is there twice.
pub(in super::super) fn vertices_repeated(scene: &mut Scene, _: &mut Surface) -> bool {
    each_feature(scene, |feature| match &mut feature.shape {
        Shape::Points(_) => false,
        shape => {
            for part in parts(shape) {
                let second = part[1];
                part.insert(1, second);
            }
            true
        }
    })
}

/// A feature far from the terrain, in each layer.
pub(in super::super) fn far_features_added(scene: &mut Scene, _: &mut Surface) -> bool {
    let far = DVec2::new(64.0 * extent(scene), 0.0);
    scene.layers.iter_mut().fold(false, |any, layer| {
        let Some(mut feature) = layer.features.first().cloned() else { return any };
        parts(&mut feature.shape).into_iter().flatten().for_each(|p| *p = *p + far);
        layer.features.push(feature);
        true
    })
}

/// Each layer's features are two layers of the same styles, one after the other: the same picture where the layer is no group.
pub(in super::super) fn layers_cut_in_two(scene: &mut Scene, _: &mut Surface) -> bool {
    let mut any = false;
    scene.layers = std::mem::take(&mut scene.layers)
        .into_iter()
        .flat_map(|mut layer| {
            if layer.features.len() < 2 || layer.opacity < 1.0 || layer.outside.is_some() {
                return vec![layer];
            }
            any = true;
            let mut rest = layer.clone();
            rest.features = layer.features.split_off(1);
            vec![layer, rest]
        })
        .collect();
    any
}
