//! A scene's parts, measured one after the other.

use super::super::change::change;
use super::amounts::{amounts, groups};
use super::decals::{Decals, Look, part};
use super::rows::{DataSet, Row};
use super::thesis::Study;
use crate::error::Result;
use crate::measure::{Drawn, Times, Watch, flight, scene_result};
use crate::scene::{Camera, ImageSettings};
use crate::scene_file::SceneText;
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::technique::{self, Kind};
use std::collections::BTreeMap;

/// Bytes that the thesis keeps of each pixel (4.3.2): the head of its list and how many lines that has.
const PIXEL_BYTES: u64 = 8;
/// Bytes of an entry of a list: the pointer to the next, the line's number and its colour.
const ENTRY_BYTES: u64 = 12;

/// Structures are built before the first frame, as the thesis does: else no time and no memory of the whole could be told.
const WHOLE: [&str; 2] =
    ["technique.static-decal.preparation=whole", "technique.dynamic-line.preparation=whole"];

/// Counts of frames that are work on decals: nodes, edges and segments that were looked at, entries that were made. They are the same in every run.
const WORK: [&str; 9] =
    ["nodes", "leaves", "quadtree_nodes", "edges", "vertices_seen", "boxes", "fragments", "entries", "faces"];

/// Cells a side of the thesis's grid (5.2.1).
const CELLS: u32 = 500;

/// What is to be measured, and under which words it is told.
pub(super) struct Case<'a> {
    /// The thesis's figure.
    pub(super) figure: &'static str,
    /// The part of the scene.
    pub(super) decals: Decals,
    /// How it looks.
    pub(super) look: Look,
    /// Changes of the scene file.
    pub(super) changes: &'a [&'a str],
    /// What is varied, by name.
    pub(super) factors: &'a [(&'static str, f64)],
    /// From where it is seen, and how large the picture is; `None`: as in the scene.
    pub(super) view: Option<&'a ViewFrame>,
}

/// A scene whose parts are measured.
pub(super) struct Bench<'a> {
    pub(super) text: SceneText,
    pub(super) stage: Stage,
    pub(super) repeat: u32,
    pub(super) watch: &'a dyn Watch,
    pub(super) rows: Vec<Row>,
}

impl Bench<'_> {
    /// Cells a side of the scene's own decal grid.
    pub(super) fn grid(&self) -> u32 {
        let all = Kind::StaticDecal.parameters(&self.stage.scene.technique);
        let grid = all.into_iter().find(|(name, _)| *name == "grid");
        grid.and_then(|(_, cells)| cells.to_string().parse().ok()).unwrap_or(CELLS)
    }

    /// The stage of a case; `None` where the scene has nothing of it, or its technique does not draw it, which is told.
    fn staged(&self, case: &Case) -> Result<Option<Stage>> {
        let Some(mut stage) = part(&self.stage, case.decals, &case.look)? else { return Ok(None) };
        change(&mut stage, &self.text, &[&WHOLE, case.changes].concat())?;
        match technique::applies(case.decals.kind(), &stage) {
            Ok(()) => Ok(Some(stage)),
            Err(error) if error.is_internal() => Err(error),
            Err(error) => {
                self.watch.note(&format!(
                    "{}: {} is left out: {}",
                    stage.scene.name,
                    case.decals.name(),
                    error.what()
                ));
                Ok(None)
            }
        }
    }

    /// Measures a case.
    pub(super) fn measure(&mut self, case: &Case) -> Result<()> {
        self.watch.start(&format!("{} {} {}", self.stage.scene.name, case.figure, case.decals.name()));
        let Some(stage) = self.staged(case)? else { return Ok(()) };
        let own = stage.view()?;
        let view = case.view.unwrap_or(&own);
        let drawn = Drawn::by(case.decals.kind(), (&stage, view), (self.repeat, &|_| false), self.watch)?;
        let pixels = (view.width() * view.height()) as u64;
        let [memory, work] = told(case.decals, drawn.structure_bytes as u64, pixels, &drawn.frame.counts);
        self.rows.push(row(case, case.factors, (memory, work), (drawn.prepare, drawn.draw)));
        Ok(())
    }

    /// Measures frames of several views of one preparation, each view with its own value of a factor.
    pub(super) fn frames(
        &mut self,
        case: &Case,
        factor: &'static str,
        views: &[(f64, ViewFrame)],
    ) -> Result<()> {
        self.watch.start(&format!("{} {} {}", self.stage.scene.name, case.figure, case.decals.name()));
        let Some(stage) = self.staged(case)? else { return Ok(()) };
        let frames: Vec<ViewFrame> = views.iter().map(|(_, view)| *view).collect();
        let (update, seen) = flight(case.decals.kind(), (&stage, &frames), self.repeat, self.watch)?;
        for ((value, view), seen) in views.iter().zip(seen) {
            let pixels = (view.width() * view.height()) as u64;
            let [memory, work] = told(case.decals, seen.structure_bytes as u64, pixels, &seen.counts);
            let factors = [case.factors, &[(factor, *value)]].concat();
            self.rows.push(row(case, &factors, (memory, work), (update, seen.draw)));
        }
        Ok(())
    }

    /// The scene's camera on a picture that is larger by a factor.
    pub(super) fn enlarged(&self, factor: f64) -> Result<ViewFrame> {
        let side = |pixels: usize| ((pixels as f64 * factor).round() as usize).max(1);
        let image = &self.stage.scene.image;
        let image = ImageSettings { width: side(image.width), height: side(image.height), ..*image };
        self.stage.scene.camera.view(&image)
    }

    /// The scene's camera, nearer to what it looks at by a factor.
    pub(super) fn nearer(&self, factor: f64) -> Result<ViewFrame> {
        let camera = self.stage.scene.camera;
        let eye = camera.target + (camera.eye - camera.target) * factor;
        Camera { eye, ..camera }.view(&self.stage.scene.image)
    }

    /// What was measured, beside the thesis's study of that name.
    pub(super) fn data_set(self, thesis: Option<Study>) -> DataSet {
        let image = &self.stage.scene.image;
        DataSet {
            scene: scene_result(&self.stage, &self.text.file.hash),
            grid: self.grid(),
            width: image.width,
            height: image.height,
            amounts: amounts(&self.stage),
            groups: groups(&self.stage),
            thesis,
            rows: self.rows,
        }
    }
}

/// Bytes of structures, of which dynamic lines have some for each pixel, and the work of a frame.
fn told(decals: Decals, structures: u64, pixels: u64, counts: &[(&'static str, u64)]) -> [u64; 2] {
    let count =
        |name: &str| counts.iter().filter(|(known, _)| *known == name).map(|(_, count)| count).sum::<u64>();
    let lists = if decals == Decals::DynamicLines {
        PIXEL_BYTES * pixels + ENTRY_BYTES * count("entries")
    } else {
        0
    };
    [structures + lists, WORK.iter().map(|name| count(name)).sum()]
}

fn row(
    case: &Case,
    factors: &[(&'static str, f64)],
    (memory_bytes, work): (u64, u64),
    (update_ms, render_ms): (Times, Times),
) -> Row {
    let factors: BTreeMap<&'static str, f64> = factors.iter().copied().collect();
    Row { figure: case.figure, decals: case.decals.name(), factors, memory_bytes, update_ms, render_ms, work }
}
