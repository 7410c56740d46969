//! The generated studies are of the thesis's kinds, and what is deterministic in their tables follows the thesis.

use super::*;
use crate::measure::Unwatched;
use crate::scene_file::{Override, SceneText, TerrainSource};

/// A study with a share of its data, a coarse terrain and a small picture.
fn opened(text: &str, scale: f64) -> Opened {
    let file = SceneText::parse(text, None, &[]).unwrap().file;
    let TerrainSource::Generate(terrain) = &file.terrain.source else { panic!("a terrain of files") };
    let cell = terrain.cell_m * (terrain.posts.0 - 1) as f64 / 8.0;
    let mut changes = vec!["image.width=96".into(), "image.height=54".into()];
    changes.extend(["terrain.generate.posts=[9, 9]".into(), format!("terrain.generate.cell_m={cell}")]);
    changes.push("technique.static-decal.grid=16".into());
    changes.extend((0..file.layers.len()).map(|layer| format!("layer.{layer}.generate.scale={scale}")));
    let changes: Vec<Override> = changes.iter().map(|change| Override::parse(change).unwrap()).collect();
    Opened::load(SceneText::parse(text, None, &changes).unwrap(), &|_| {}).unwrap()
}

#[test]
fn the_studies_are_the_thesiss_with_its_groups_and_colors() {
    for (text, study) in SCENES.iter().zip(&STUDIES) {
        let scene = opened(text, 0.01);
        assert_eq!(scene.stage.scene.name, study.name);
        let ours = groups(&scene.stage);
        // A hundredth of nineteen isolines, of thirty borders is one.
        assert_eq!(ours, study.groups, "{}", study.name);
        let (ours, thesis) = (amounts(&scene.stage), study.amounts);
        // Some areas of a partition enclose another, which is a hole more.
        let polygons = Amount {
            decals: thesis.exterior.decals + thesis.interior.decals,
            vertices: thesis.exterior.vertices + thesis.interior.vertices,
        };
        for (ours, wanted, of) in [
            (ours.exterior, thesis.exterior, thesis.exterior),
            (ours.interior, thesis.interior, polygons),
            (ours.lines, thesis.lines, thesis.lines),
        ] {
            let near = |ours: usize, wanted: usize, of: usize| {
                (ours as f64 - 0.01 * wanted as f64).abs() <= 2.0 + 0.01 * 0.02 * of as f64
            };
            let is_near = near(ours.decals, wanted.decals, of.decals)
                && near(ours.vertices, wanted.vertices, of.vertices);
            assert!(is_near, "{} {ours:?} {wanted:?}", study.name);
        }
    }
}

#[test]
fn memory_follows_grid_depth_capacity_and_size_as_in_the_thesis() {
    let measured = |study: usize| {
        let Opened { text, stage } = opened(SCENES[study], 0.001);
        let mut bench = Bench { text, stage, repeat: 1, watch: &Unwatched, rows: Vec::new() };
        let numbers = ["5.5", "5.7", "5.9", "5.10", "5.12", "5.13"];
        figures::run(&mut bench, |figure| numbers.contains(&figure.number)).unwrap();
        bench.data_set(None)
    };
    let tables = Tables::of([0, 3, 7].map(measured).into(), 1);
    let of = |decals: &str, factor: &str| {
        tables.trends.iter().find(|trend| (trend.decals, trend.factor) == (decals, factor)).unwrap()
    };
    for (decals, factor) in [
        ("All decals", "Data complexity"),
        ("Static decals", "Grid resolution"),
        ("Polygons", "Leaf capacity"),
        ("Polygons", "Quad-tree depth"),
    ] {
        let trend = of(decals, factor);
        assert_eq!(trend.ours[0], trend.thesis[0], "{trend:?}");
    }
    assert_eq!(of("All decals", "Anti-aliasing").work, Some(Sign::More));
    // What is out of view costs no look at any decal.
    let away = tables.data_sets.iter().flat_map(|set| &set.rows).filter(|row| row.figure == "5.7");
    let work: Vec<(&str, u64)> = away.map(|row| (row.decals, row.work)).collect();
    assert_eq!(work.iter().filter(|(decals, _)| *decals == "polygons").map(|(_, work)| work).sum::<u64>(), 0);
    assert!(work.len() >= 6);
    // A page and a table of all of it, whatever the numbers.
    assert!(page(&tables).contains("Table 5.4"));
    let rows: usize = tables.data_sets.iter().map(|set| set.rows.len()).sum();
    assert_eq!(tables.to_csv().lines().count(), 1 + rows);
}
