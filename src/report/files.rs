//! The files of a report.

use super::page::{Section, page};
use super::plot::{self, View};
use super::{Exhibit, Measured, REPORT_SCHEMA, Report, table};
use crate::error::Result;
use crate::output::Batch;

/// The page, in the folder of the report.
pub const PAGE: &str = "report.html";

/// Writes what was measured, each thing `repeat` times, as `report.html` ([`PAGE`]), `report.csv`, `report.json` and plots; they are in
/// their places when it returns what `report.json` says.
///
/// # Errors
/// When a file cannot be written: then none is.
pub fn write(measured: Vec<Measured>, repeat: u32, mut batch: Batch) -> Result<Report> {
    let (scenes, exhibits) = measured.into_iter().map(|scene| (scene.report, scene.exhibits)).unzip();
    let report = Report { schema: REPORT_SCHEMA, repeat, scenes };
    stage(&report, exhibits, &mut batch)?;
    batch.commit()?;
    Ok(report)
}

fn stage(report: &Report, exhibits: Vec<Vec<Exhibit>>, batch: &mut Batch) -> Result<()> {
    let names = file_names(report);
    for (scene, plots) in report.scenes.iter().zip(&names) {
        // Where nothing was scored there is nothing to plot.
        let plots = if scene.feature_pixels > 0 { &plots[..] } else { &[] };
        for (view, name) in View::all().zip(plots) {
            batch.stage(name, |to| to.write_all(plot::svg(scene, view).as_bytes()))?;
        }
    }
    let parts = report.scenes.iter().zip(&exhibits).zip(&names);
    let sections: Vec<Section> =
        parts.map(|((scene, exhibits), plots)| Section { scene, exhibits, plots }).collect();
    let page = page(report, &sections)?;
    batch.stage(PAGE, |to| to.write_all(page.as_bytes()))?;
    batch.stage("report.csv", |to| to.write_all(table::csv(report).as_bytes()))?;
    let json = report.to_json()?;
    batch.stage("report.json", |to| to.write_all(json.as_bytes()))
}

/// The names of each scene's plots: the scene's name, with a number where another scene has the same.
fn file_names(report: &Report) -> Vec<Vec<String>> {
    let mut stems: Vec<String> = Vec::new();
    for scene in &report.scenes {
        let plain = |c: char| if c.is_alphanumeric() || c == '-' || c == '_' { c } else { '-' };
        let stem: String = scene.scene.name.chars().map(plain).collect();
        let again = |k: usize| if k == 1 { stem.clone() } else { format!("{stem}-{k}") };
        let free = (1..).map(again).find(|name| !stems.contains(name));
        stems.push(free.unwrap_or(stem));
    }
    let plots = |stem: &String| View::all().map(|view| format!("{stem}-{}.svg", view.name())).collect();
    stems.iter().map(plots).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::SceneResult;
    use crate::report::SceneReport;

    fn named(name: &str) -> SceneReport {
        let (hash, plan_space) = (String::new(), String::new());
        SceneReport {
            scene: SceneResult {
                name: name.into(),
                hash,
                plan_space,
                origin: [0.0; 2],
                origin_height: 0.0,
                surface_error: None,
            },
            width: 1,
            height: 1,
            notes: Vec::new(),
            reference_width_max: 0.0,
            feature_pixels: 0,
            runs: Vec::new(),
        }
    }

    #[test]
    fn plots_of_scenes_of_one_name_have_names_of_their_own_and_stay_in_the_folder() {
        let scenes = ["valley", "../up", "valley", "valley-2", "valley"].map(named).to_vec();
        let report = Report { schema: REPORT_SCHEMA, repeat: 1, scenes };
        let first: Vec<String> = file_names(&report).into_iter().map(|names| names[0].clone()).collect();
        let expected = [
            "valley-feature-rmse-techniques.svg",
            "---up-feature-rmse-techniques.svg",
            "valley-2-feature-rmse-techniques.svg",
            "valley-2-2-feature-rmse-techniques.svg",
            "valley-3-feature-rmse-techniques.svg",
        ];
        assert_eq!(first, expected);
    }
}
