//! The judge's own test in small, and that it can fail. `drapery judge-test` is the whole of it.
#![cfg(feature = "render")]

use drapery::judge_test::{Plan, run};
use drapery::technique::Kind;

/// A scene, and a sample of the bugs and variants.
fn sample() -> Plan {
    Plan { kinds: vec![Kind::StencilVolume], scene: Some("hills".into()), every: 9, blind: false }
}

#[test]
fn the_judge_fails_planted_bugs_and_passes_other_right_pictures() {
    let trial = run(&sample(), &|_| {}).unwrap();
    assert_eq!(trial.faults(), [""; 0], "{}", trial.text());
    let json: serde_json::Value = serde_json::from_str(&trial.json().unwrap()).unwrap();
    let all = &json["all"];
    assert!(all["bugs"]["changed"].as_u64() >= Some(8) && all["variants"].as_u64() >= Some(6), "{all}");
    assert_eq!(all["bugs"]["caught"], all["bugs"]["changed"]);
    assert_eq!(all["passed"], all["variants"]);
}

#[test]
fn a_judge_that_allows_everything_is_found_out() {
    let trial = run(&Plan { blind: true, every: 20, ..sample() }, &|_| {}).unwrap();
    assert!(trial.faults()[0].starts_with("0.00 % of all bugs are caught"), "{:?}", trial.faults());
    assert!(trial.text().contains("FAIL") && !trial.text().contains("PASS"));
}

#[test]
fn a_scene_that_does_not_exist_is_refused_with_those_that_do() {
    let error = run(&Plan { scene: Some("valley".into()), ..sample() }, &|_| {}).unwrap_err();
    assert!(error.help_text().is_some_and(|help| help.contains("hills")));
}
