//! The studies have as much as the thesis's tables tell, and its character.

use super::super::features;
use super::super::tests::*;
use super::*;
use crate::parameter::Named;
use crate::scene_file::{VectorGenerator, VectorKind};
use crate::space::Plan;
use std::collections::{BTreeMap, BTreeSet};

fn made(study: Study, data: &'static DataGroup, scale: f64) -> Vec<Shape> {
    let kind = VectorKind::CaseStudy { study, data, scale };
    let generator = VectorGenerator { kind, seed: 5, count: 0, window: None };
    features(&generator, window()).into_iter().map(|feature| feature.shape).collect()
}

/// Outer rings, holes and lines with their vertices.
fn amounts(shapes: &[Shape]) -> [Amount; 3] {
    let mut all = [Amount::default(); 3];
    for shape in shapes {
        for (number, part) in shape.parts().enumerate() {
            let amount = &mut all[if shape.is_area() { number.min(1) } else { 2 }];
            amount.decals += 1;
            amount.vertices += part.len();
        }
    }
    all
}

fn twice_area(ring: &[Plan]) -> f64 {
    (0..ring.len()).map(|k| ring[k].to_vec().perp_dot(ring[(k + 1) % ring.len()].to_vec())).sum()
}

#[test]
fn a_twentieth_of_a_group_has_a_twentieth_of_what_the_thesis_has_within_two_percent() {
    for (name, study) in Study::NAMES {
        for data in study.groups() {
            let got = amounts(&made(*study, data, 0.05));
            let (rings, lines) = (data.exterior, data.lines);
            // A catchment may lie in another, which then has a hole that the thesis does not tell of.
            let with_holes = [rings.decals + data.interior.decals, rings.vertices + data.interior.vertices];
            let wanted = [(rings, [0; 2]), (data.interior, with_holes), (lines, [0; 2])];
            for (got, (wanted, of)) in got.into_iter().zip(wanted) {
                let is_near = |got: usize, wanted: usize, of: usize| {
                    let [got, wanted, of] = [got as f64, 0.05 * wanted as f64, 0.05 * of.max(wanted) as f64];
                    (got - wanted).abs() <= 1.0 + 0.02 * of
                };
                let told = format!("{name} {:?}: {got:?} of {wanted:?}", data.group);
                assert!(is_near(got.decals, wanted.decals, of[0]), "{told}");
                assert!(is_near(got.vertices, wanted.vertices, of[1]), "{told}");
            }
        }
    }
}

#[test]
fn at_the_least_scale_something_is_left_of_every_group() {
    for (_, study) in Study::NAMES {
        for data in study.groups() {
            let shapes = made(*study, data, 1e-9);
            assert_eq!(shapes.len(), 1, "{:?}", data.group);
            let least = if shapes[0].is_area() { 3 } else { 2 };
            assert!(shapes[0].parts().all(|part| part.len() >= least));
        }
    }
}

#[test]
fn all_of_a_study_lies_in_its_window_and_holes_run_the_other_way() {
    let near = window().grown(1e-6);
    for (_, study) in Study::NAMES {
        for data in study.groups() {
            for shape in made(*study, data, 0.01) {
                for (number, part) in shape.parts().enumerate() {
                    assert!(part.iter().all(|p| near.meets(&PlanBox::around([*p]))), "{:?}", data.group);
                    let turns = twice_area(part);
                    assert!(!shape.is_area() || (turns > 0.0) == (number == 0), "{:?}", data.group);
                }
            }
        }
    }
}

#[test]
fn catchments_share_the_vertices_of_their_borders_and_fill_the_window() {
    let data = Study::Catchments.group(Group::Catchments).unwrap();
    let shapes = made(Study::Catchments, data, 0.005);
    let key = |a: Plan, b: Plan| [a.x, a.y, b.x, b.y].map(f64::to_bits);
    let mut edges: BTreeSet<[u64; 4]> = BTreeSet::new();
    let rings = || shapes.iter().flat_map(Shape::parts);
    let all = || rings().flat_map(|ring| (0..ring.len()).map(|k| (ring[k], ring[(k + 1) % ring.len()])));
    for (a, b) in all() {
        assert!(a != b && edges.insert(key(a, b)), "an edge is used twice in one direction");
    }
    let w = window();
    let is_outer = |a: Plan, b: Plan| {
        [w.min.x, w.max.x].iter().any(|x| a.x == *x && b.x == *x)
            || [w.min.y, w.max.y].iter().any(|y| a.y == *y && b.y == *y)
    };
    for (a, b) in all() {
        assert_eq!(edges.contains(&key(b, a)), !is_outer(a, b));
    }
    let size = w.max - w.min;
    let sum: f64 = shapes.iter().map(area).sum();
    assert!((sum / (size.x * size.y) - 1.0).abs() < 1e-9);
}

#[test]
fn floods_lie_in_one_another_and_have_a_hundred_islands_each() {
    let data = Study::Floods.group(Group::Floods).unwrap();
    let shapes = made(Study::Floods, data, 0.05);
    let mean = |level: usize| -> f64 {
        let outer = shapes.iter().skip(level).step_by(FLOODS.levels);
        outer.map(|shape| 0.5 * twice_area(shape.parts().next().unwrap())).sum()
    };
    assert!(mean(0) > mean(1) && mean(1) > mean(2));
    let holes = amounts(&shapes)[1].decals;
    assert!((120..240).contains(&(holes / shapes.len())));
    // Much of the land is dry: what is flooded covers less than a fifth of the window.
    let size = window().max - window().min;
    assert!(mean(0) < 0.2 * size.x * size.y);
}

#[test]
fn lakes_differ_in_size_by_a_hundred_times_and_the_largest_have_the_islands() {
    let data = Study::Rivers.group(Group::Lakes).unwrap();
    let shapes = made(Study::Rivers, data, 0.1);
    let of = |shape: &Shape| (shape.parts().next().unwrap().len(), shape.parts().count() - 1);
    let with: Vec<usize> =
        shapes.iter().map(of).filter(|(_, islands)| *islands > 0).map(|(n, _)| n).collect();
    let without = shapes.iter().map(of).filter(|(_, islands)| *islands == 0).map(|(n, _)| n);
    assert!(with.iter().min() >= without.max().as_ref());
    let areas: Vec<f64> = shapes.iter().map(area).collect();
    let [least, most] =
        [crate::math::min, crate::math::max].map(|pick| areas.iter().copied().reduce(pick).unwrap());
    assert!(most > 100.0 * least);
}

#[test]
fn streets_meet_at_crossings_and_buildings_have_right_angles() {
    let roads = made(Study::Surroundings, Study::Surroundings.group(Group::Roads).unwrap(), 0.01);
    let mut ends: BTreeMap<[u64; 2], usize> = BTreeMap::new();
    for line in roads.iter().flat_map(Shape::parts) {
        for p in [line[0], line[line.len() - 1]] {
            *ends.entry([p.x, p.y].map(f64::to_bits)).or_default() += 1;
        }
    }
    assert!(ends.len() * 3 < roads.len() * 2, "each crossing has more than three ends of streets on average");
    let buildings = made(Study::Surroundings, Study::Surroundings.group(Group::Buildings).unwrap(), 0.002);
    for ring in buildings.iter().flat_map(Shape::parts) {
        for k in 0..ring.len() {
            let (a, b, c) = (ring[k], ring[(k + 1) % ring.len()], ring[(k + 2) % ring.len()]);
            let ([u, v], size) = ([b - a, c - b], (b - a).length() * (c - b).length());
            // A wall may have a vertex in its middle.
            assert!((u.perp_dot(v).abs() - size).abs() < 1e-6 * size || u.perp_dot(v).abs() < 1e-6 * size);
        }
    }
}

#[test]
fn half_of_the_rivers_begin_at_another() {
    let rivers = made(Study::Rivers, Study::Rivers.group(Group::Rivers).unwrap(), 0.1);
    let lines: Vec<&Vec<Plan>> = rivers.iter().flat_map(Shape::parts).collect();
    let joins = (1..lines.len()).filter(|&at| lines[..at].iter().any(|line| line.contains(&lines[at][0])));
    let share = joins.count() as f64 / lines.len() as f64;
    assert!((0.35..0.65).contains(&share), "{share}");
}

#[test]
fn columns_tell_levels_kinds_and_areas() {
    let data = Study::Floods.group(Group::Floods).unwrap();
    let kind = VectorKind::CaseStudy { study: Study::Floods, data, scale: 0.02 };
    let generator = VectorGenerator { kind, seed: 5, count: 0, window: None };
    let all = features(&generator, window());
    let columns = super::super::columns(&generator, window(), &all);
    assert_eq!(columns.iter().map(|column| column.name.as_str()).collect::<Vec<_>>(), ["class", "area_m2"]);
    assert_eq!((columns[0].value(0), columns[0].value(4)), (&Attribute::Integer(0), &Attribute::Integer(1)));
    let Attribute::Number(told) = columns[1].value(3) else { panic!("{:?}", columns[1].value(3)) };
    let rings: f64 = all[3].shape.parts().map(|ring| 0.5 * twice_area(ring)).sum();
    assert!((told / rings - 1.0).abs() < 1e-6);
}

#[test]
fn studies_keep_their_bits() {
    let of = |study: Study| {
        let shapes = study.groups().iter().flat_map(|data| made(study, data, 0.003));
        let parts: Vec<Vec<Plan>> =
            shapes.flat_map(|shape| shape.parts().cloned().collect::<Vec<_>>()).collect();
        bits(&parts)
    };
    let all: Vec<String> = Study::NAMES.iter().map(|(_, study)| of(*study)).collect();
    assert_eq!(
        all,
        [
            "4e4889057beeadbb",
            "f5cef430f702f6f6",
            "8df9d763fe202add",
            "17485ed8b13bc6f0",
            "07f1e7f56faffa05",
            "000c255249837693",
            "40b8bf4a5f972a21",
            "1b15be0e472067cd",
        ]
    );
}
