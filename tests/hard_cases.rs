//! The hard cases whose answers are exact: pictures that have to be equal, and closed forms. `drapery hard-cases` is the whole of it.
#![cfg(feature = "render")]

use drapery::hard_cases::{CaseResult, Curve, Plan, Row, Suite, Verdict, cases, run};

/// Cases in exact mathematics.
fn drawn(numbers: &[u32]) -> Vec<CaseResult> {
    run(&Plan { only: numbers.to_vec(), is_quick: true }, &|_| {}).unwrap_or_else(|e| panic!("{e}"))
}

/// Asserts that nothing fails, and that the truth and these techniques give the answer of each case, with the settings that they have by
/// default or, after a `+`, with some others.
fn assert_answers(expected: &[(u32, &[&str])]) -> Vec<CaseResult> {
    let numbers: Vec<u32> = expected.iter().map(|(number, _)| *number).collect();
    let results = drawn(&numbers);
    let suite = Suite { cases: results, curves: Vec::new() };
    assert_eq!(suite.failed().count(), 0, "{}", suite.text());
    for (number, techniques) in expected {
        let rows = &suite.cases.iter().find(|result| result.case.number == *number).unwrap().rows;
        let passes = |name: &str| {
            let is_it = |row: &&Row| match name.strip_suffix('+') {
                Some(name) => row.technique == name && !row.settings.is_empty(),
                None => row.technique == name && row.settings.is_empty(),
            };
            rows.iter().any(|row| is_it(&row) && row.verdict == Verdict::Pass)
        };
        for name in std::iter::once(&"truth").chain(*techniques) {
            assert!(passes(name), "case {number} by {name}: {}", suite.text());
        }
    }
    suite.cases
}

#[test]
fn volumes_are_the_same_whatever_clips_or_misses_them() {
    let results =
        assert_answers(&[(1, &["stencil-volume"]), (2, &["stencil-volume"]), (3, &["stencil-volume"])]);
    // What the paper warns of is seen: the measures can fail.
    for result in &results[..2] {
        let known = result.rows.iter().find(|row| row.verdict == Verdict::Artifact).unwrap();
        assert!(
            known.figures.iter().any(|figure| !figure.is_met()) && known.note.contains("4.2.1"),
            "{known:?}"
        );
    }
}

#[test]
fn pictures_do_not_depend_on_heights_levels_or_repetitions() {
    assert_answers(&[
        (
            8,
            &[
                "clipmap",
                "stencil-volume",
                "inverse-projection",
                "static-decal",
                "dynamic-line",
                "geometry-overlay",
            ],
        ),
        (14, &["geometry-overlay"]),
        (23, &["clipmap", "stencil-volume", "inverse-projection", "static-decal", "geometry-overlay"]),
    ]);
}

#[test]
fn pictures_do_not_depend_on_tiles_sequence_or_history() {
    let all = [
        "clipmap",
        "stencil-volume",
        "inverse-projection",
        "static-decal",
        "dynamic-line",
        "geometry-overlay",
    ];
    assert_answers(&[(29, &all), (32, &all)]);
}

#[test]
fn samples_of_shared_edges_have_one_owner_and_overlaps_are_composed_in_sequence() {
    let fills = ["clipmap", "stencil-volume", "inverse-projection", "static-decal"];
    let owners = ["clipmap", "stencil-volume", "inverse-projection+", "static-decal"];
    assert_answers(&[(31, &owners), (37, &fills), (41, &fills)]);
}

#[test]
fn a_stencil_of_eight_bits_wraps_at_256_volumes_and_nowhere_else() {
    assert_answers(&[(36, &["stencil-volume", "stencil-volume+"])]);
}

#[test]
fn areas_are_those_of_closed_forms() {
    let fills = ["clipmap", "stencil-volume", "inverse-projection+", "static-decal"];
    assert_answers(&[(33, &fills), (34, &fills), (35, &fills)]);
}

#[test]
fn strokes_are_as_wide_as_they_should_be() {
    let fills = ["clipmap", "stencil-volume", "inverse-projection", "static-decal"];
    assert_answers(&[(9, &fills), (22, &["clipmap+", "stencil-volume+", "static-decal+"]), (27, &fills)]);
}

#[test]
fn thin_lines_cover_their_area_where_a_technique_knows_areas() {
    assert_answers(&[(7, &["clipmap", "clipmap+", "static-decal+"]), (25, &["stencil-volume", "clipmap+"])]);
}

#[test]
fn dashes_are_as_long_as_they_should_be_where_they_are_drawn() {
    let suite = Suite { cases: drawn(&[26]), curves: Vec::new() };
    assert_eq!(suite.failed().count(), 0, "{}", suite.text());
}

#[test]
fn cases_are_numbered_from_1_to_55_and_say_what_is_right() {
    let all = cases();
    assert!(all.iter().map(|case| case.number).eq(1..=55));
    assert!(all.iter().all(|case| !case.title.is_empty() && case.answer.ends_with('.')));
}

#[test]
fn a_number_that_no_case_has_is_refused() {
    let error = run(&Plan { only: vec![3, 56], is_quick: true }, &|_| {}).unwrap_err();
    assert_eq!(error.what(), "there is no hard case 56");
    assert_eq!(error.help_text(), Some("cases are numbered from 1 to 55"));
}

#[test]
fn the_page_and_the_json_have_every_row() {
    let suite = Suite { cases: drawn(&[12]), curves: Vec::new() };
    let rows = suite.cases[0].rows.len();
    let json: serde_json::Value = serde_json::from_str(&suite.json().unwrap()).unwrap();
    assert_eq!(json["cases"][0]["rows"].as_array().unwrap().len(), rows);
    assert_eq!(json["cases"][0]["rows"][0]["verdict"], "pass");
    let page = suite.page().unwrap();
    assert_eq!(page.matches("<tr>").count(), rows + 1);
    assert_eq!(page.matches("<img").count(), suite.cases[0].pictures.len());
    assert!(!page.contains("http://") && !page.contains("https://"));
    assert_eq!(suite.text().lines().filter(|line| line.contains(" pass ")).count(), rows);
}

#[test]
fn curves_are_plotted_a_technique_each_with_a_place_for_zero() {
    let curve = |technique, machine, points: &[[f64; 2]]| Curve {
        over: "offset, m",
        error: "largest difference",
        technique,
        machine,
        points: points.to_vec(),
    };
    let curves = vec![
        curve("clipmap", "f64", &[[0.0, 0.0], [10.0, 0.0], [100.0, 0.0]]),
        curve("clipmap", "f32", &[[0.0, 0.0], [10.0, 0.0], [100.0, 0.01]]),
        curve("static-decal", "f64", &[[100.0, 0.001]]),
    ];
    let suite = Suite { cases: Vec::new(), curves };
    let page = suite.page().unwrap();
    assert_eq!(page.matches("role=\"img\"").count(), 2);
    // Zero lies on the axis's end, the largest value at the other.
    assert!(page.contains("M46.0 150.0L68.9 150.0L290.0 150.0"), "{page}");
    assert!(page.contains("M46.0 150.0L68.9 150.0L290.0 22.0"), "{page}");
    assert!(suite.json().unwrap().contains("\"stability\""));
}
