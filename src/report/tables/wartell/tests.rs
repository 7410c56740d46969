//! Tables of a small scene: each number against what the paper says of its kind, or against another way to it.

use super::*;
use crate::measure::Unwatched;
use crate::open::Opened;
use crate::scene_file::{LayerSource, Override, SceneFile, SceneText, VectorKind};
use std::sync::LazyLock;

/// The paper's scene with a coarse terrain as rough as that, a small picture and a share of its lines, measured once for all tests.
static SMALL: LazyLock<DataSet> = LazyLock::new(|| {
    let changes = [
        "image.width=120",
        "image.height=80",
        "terrain.generate.posts=[161, 161]",
        "terrain.generate.cell_m=288",
        "terrain.generate.height_m=8000",
        "terrain.generate.wavelength_m=2000",
        "layer.0.generate.scale=0.1",
        "layer.1.generate.scale=0.04",
    ];
    let changes: Vec<Override> = changes.iter().map(|change| Override::parse(change).unwrap()).collect();
    let text = SceneText::parse(SCENES[0], None, &changes).unwrap();
    measure(Opened::load(text, &|_| {}).unwrap(), 1, &Unwatched).unwrap()
});

fn rows(varied: &str) -> Vec<&'static Row> {
    SMALL.of(varied).collect()
}

#[test]
fn every_setting_is_understood_and_the_lines_are_as_many_as_the_papers() {
    for (_, changes) in SWEEPS.iter().flat_map(|sweep| sweep.settings) {
        let changes: Vec<Override> = changes.iter().map(|change| Override::parse(change).unwrap()).collect();
        assert!(SceneFile::parse(SCENES[0], None, &changes).unwrap().terrain.lod.is_some());
    }
    let file = SceneFile::parse(SCENES[0], None, &[]).unwrap();
    let borders = file.layers.iter().map(|layer| match &layer.source {
        LayerSource::Generate(generator) => match generator.kind {
            VectorKind::CaseStudy { data, scale, .. } => data.lines.scaled(scale, 4),
            _ => panic!("not the data of a study"),
        },
        _ => panic!("not generated"),
    });
    let all: Vec<_> = borders.collect();
    assert_eq!(all.iter().map(|amount| amount.decals).sum::<usize>(), 389);
    let points: usize = all.iter().map(|amount| amount.vertices).sum();
    assert!(points.abs_diff(paper::POINTS) < paper::POINTS / 15, "{points}");
}

#[test]
fn lines_are_primitives_and_points_more_and_do_not_change_the_mesh() {
    let [on, off] = rows(POLYLINES)[..] else { panic!("not two rows") };
    assert_eq!((SMALL.polylines, SMALL.posts), (4, [161, 161]));
    assert_eq!((on.triangles, on.deviation_m), (off.triangles, off.deviation_m));
    assert_eq!((off.count("primitives"), off.count("points")), (0, 0));
    assert!(on.count("primitives") >= 4 && on.count("points") >= SMALL.points as u64);
    assert!(off.changed_pixels > 20, "{}", off.changed_pixels);
}

#[test]
fn storage_shrinks_by_each_reduction_and_most_by_both() {
    let storage = &SMALL.storage;
    // The quad that holds all has its points once for each of 15 layers, and those of crossings.
    assert_eq!((storage.covering_triangles, storage.root.quads), (paper::COVERING_TRIANGLES, 1));
    assert!(storage.root.clipping_points >= 15 * SMALL.points as u64);
    assert_eq!(storage.root.forms[0].coordinate_bytes, 12 * storage.root.clipping_points);
    // It has no larger quad.
    assert_eq!(storage.root.forms[0].bytes(), storage.root.forms[2].bytes());
    let [naive, projectors, two_finest, both] = storage.all.forms;
    assert!(naive.factor == 1.0 && storage.all.quads > 1);
    assert!(projectors.factor > 1.0 && two_finest.factor > 1.0);
    assert!(both.factor > projectors.factor && both.factor > two_finest.factor);
    assert_eq!(projectors.topology_bytes, naive.topology_bytes);
}

#[test]
fn the_larger_the_error_the_fewer_triangles_and_none_is_farther_off_than_that() {
    let errors = rows("error_px");
    let triangles: Vec<usize> = errors.iter().map(|row| row.triangles).collect();
    assert!(triangles.is_sorted_by(|a, b| a >= b) && triangles[0] > triangles[4], "{triangles:?}");
    for (row, most) in errors.iter().zip([0.5, 1.0, 2.0, 4.0, 8.0]) {
        assert!(row.deviation_px <= most, "{row:?}");
    }
}

#[test]
fn what_is_cached_of_borrowed_quads_is_not_searched_for_and_the_same_is_drawn() {
    let [none, cached, searched, ..] = rows("borrow")[..] else { panic!("too few rows") };
    assert_eq!(none.count("borrowed_quads"), 0);
    assert!(cached.count("borrowed_quads") > 0);
    assert!(cached.count("clippings_visited") < searched.count("clippings_visited"));
    assert_eq!(cached.count("points"), searched.count("points"));
    assert_eq!(cached.changed_pixels, searched.changed_pixels);
}

#[test]
fn the_farther_back_the_mesh_is_moved_the_more_fragments_are_drawn() {
    let offsets = rows("offset");
    assert!(offsets[0].survival() < offsets[4].survival(), "{offsets:?}");
    assert!(offsets[4].survival() <= offsets[6].survival());
    assert!(offsets.iter().all(|row| row.count("fragments") == offsets[0].count("fragments")));
}

#[test]
fn a_tolerance_leaves_fewer_points_of_as_many() {
    let tolerances = rows("tolerance_px");
    let left: Vec<u64> = tolerances.iter().map(|row| row.count("points_drawn")).collect();
    assert_eq!(tolerances[0].count("points"), left[0]);
    assert!(left.windows(2).all(|pair| pair[0] >= pair[1]) && left[0] > left[4], "{left:?}");
    let all = rows(POLYLINES)[0].count("points");
    assert!(tolerances.iter().all(|row| row.count("points") == all));
}

#[test]
fn the_page_has_every_table_and_the_csv_a_row_for_each_setting() {
    let tables = Tables::of(vec![SMALL.clone()], 1);
    let page = page(&tables);
    assert!(page.contains("Table 1") && SWEEPS.iter().all(|sweep| page.contains(sweep.title)));
    let csv = tables.to_csv();
    assert_eq!(csv.lines().count(), 25);
    assert!(csv.lines().skip(1).all(|line| line.starts_with("counties,4,")));
}
