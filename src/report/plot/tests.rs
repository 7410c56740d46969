use super::*;
use crate::measure::Times;
use crate::output::{ByName, SceneResult};
use crate::report::Errors;

fn run(technique: &str, varied: &str, line: Option<&str>, (ms, error): (f64, f64)) -> Run {
    let error = Errors {
        max: error,
        mean: error,
        rmse: error,
        p99: error,
        over_one_code_value: 0.0,
        flip_mean: None,
    };
    Run {
        technique: technique.into(),
        varied: vec![varied.into()],
        is_own: false,
        line: line.map(Into::into),
        parameters: ByName::default(),
        device: ByName::default(),
        prepare_ms: Times::of(vec![]),
        frame_ms: Times::of(vec![ms, ms * 1.5]),
        structure_bytes: 0,
        counts: ByName::default(),
        error,
        error_on_features: error,
        is_rounded: true,
        image_hash: String::new(),
        on_front: false,
    }
}

fn scene(runs: Vec<Run>) -> SceneReport {
    let scene = SceneResult {
        name: "a <b> & c".into(),
        hash: String::new(),
        plan_space: String::new(),
        surface_error: None,
        origin: [0.0; 2],
        origin_height: 0.0,
    };
    SceneReport {
        scene,
        width: 1,
        height: 1,
        notes: vec![],
        reference_width_max: 0.0,
        feature_pixels: 1,
        runs,
    }
}

#[test]
fn lines_are_series_of_their_own_and_what_is_on_none_is_another() {
    let runs = [
        run(TRUTH, "", None, (9.0, 0.1)),
        run("a", "n=1", Some("x=1"), (1.0, 0.5)),
        run("a", "n=2", Some("x=1"), (2.0, 0.4)),
        run("a", "n=1", Some("x=2"), (1.0, 0.3)),
        run("a", "y=1", None, (1.0, 0.2)),
    ];
    let names: Vec<String> =
        series(&runs.iter().collect::<Vec<_>>()).into_iter().map(|one| one.name).collect();
    assert_eq!(names, ["truth (half its width)", "a, x=1", "a, x=2", "a, other settings"]);
    let all: Vec<&Run> = runs.iter().collect();
    assert_ne!(series(&all)[1].dash, series(&all)[2].dash);
}

#[test]
fn a_plot_of_zero_errors_and_of_no_time_is_drawn_in_the_field() {
    let view = View { metric: Metric::Rmse, scope: Scope::All };
    let svg = svg(&scene(vec![run("a", "", None, (0.0, 0.0)), run("b", "", None, (0.0, 0.0))]), view);
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    assert!(svg.contains("a &lt;b&gt; &amp; c"), "{svg}");
}

#[test]
fn the_front_is_a_staircase_from_the_top_to_the_right() {
    let runs =
        [run("a", "", None, (1.0, 0.5)), run("b", "", None, (10.0, 0.1)), run("c", "", None, (20.0, 0.4))];
    let axes = Axes {
        time: LogAxis::around(&[1.0, 20.0]),
        error: LogAxis::around(&[0.1, 0.5]),
        metric: Metric::Rmse,
    };
    let path = front(&axes, &runs.iter().collect::<Vec<_>>()).into_string();
    let corners: Vec<&str> = path.split(['M', 'L']).skip(1).collect();
    assert_eq!(corners.len(), 5, "{path}");
    assert!(corners[0].ends_with(&fixed(FIELD[1])) && corners[4].starts_with(&fixed(FIELD[2])), "{path}");
}
