//! Tables of small scenes: what grows and what does not, by counts.

use super::*;
use crate::measure::Unwatched;
use crate::open::Opened;
use crate::scene_file::{Override, SceneText};

/// A study with a small picture and a share of its lines.
fn small(name: &str, changes: &[&str]) -> DataSet {
    let study = STUDIES.iter().find(|study| study.name == name).unwrap();
    let changes = study.changes.iter().chain(changes).map(|change| Override::parse(change).unwrap());
    let text = SceneText::parse(SCENE, None, &changes.collect::<Vec<_>>()).unwrap();
    measure(Opened::load(text, &|_| {}).unwrap(), 1, &Unwatched).unwrap()
}

const SMALL: [&str; 2] = ["image.width=60", "image.height=40"];

#[test]
fn every_study_is_a_scene_and_names_itself() {
    for study in &STUDIES {
        let changes: Vec<_> = study.changes.iter().map(|change| Override::parse(change).unwrap()).collect();
        let text = SceneText::parse(SCENE, None, &changes).unwrap();
        assert_eq!(text.file.name.as_str(), study.name);
    }
}

#[test]
fn terrains_and_lines_have_about_as_many_triangles_and_vertices_as_the_papers() {
    for (name, triangles) in [("468 triangles", 468), ("10,368 triangles", 10_368)] {
        assert_eq!(small(name, &SMALL).triangles, triangles);
    }
    for (name, vertices) in [("1,640 vertices", 1640_usize), ("10,171 vertices", 10_171)] {
        let found = small(name, &[SMALL[0], SMALL[1]]).vertices;
        assert!(found.abs_diff(vertices) < vertices / 50, "{name}: {found}");
    }
}

#[test]
fn more_samples_are_taken_on_borders_alone_and_stencil_volumes_have_none_of_them() {
    let set = small("1,640 vertices", &SMALL);
    let methods: Vec<&Row> = set.rows.iter().filter(|row| row.table == "Fig. 14").collect();
    assert_eq!(methods.len(), 9);
    let inverse: Vec<&&Row> = methods.iter().filter(|row| row.technique == "inverse-projection").collect();
    assert!(inverse[0].border_pixels > 0);
    assert!(inverse.iter().all(|row| row.border_pixels == inverse[0].border_pixels));
    let taken: Vec<u64> = inverse.iter().map(|row| row.samples).collect();
    assert!(taken.is_sorted_by(|a, b| a < b), "{taken:?}");
}

#[test]
fn the_page_and_the_csv_have_a_row_for_each_setting_with_the_papers_rate() {
    let tables = Tables::of(vec![small("4,101 vertices", &SMALL)], 1);
    let rows = &tables.data_sets[0].rows;
    assert_eq!(rows[0].paper_fps, Some(17.5));
    let page = page(&tables);
    assert!(page.contains("Table 5") && page.contains("17.5") && page.contains("inverse projection, 5 x 5"));
    assert!(!page.contains("<h2>Table 3</h2>"), "it was not measured");
    assert_eq!(tables.to_csv().lines().count(), 1 + rows.len());
}
