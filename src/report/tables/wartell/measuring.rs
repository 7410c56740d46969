//! A scene's frames and storage, measured one after the other.
//!
//! Input: an opened scene. Output: [`DataSet`]. Refuses: scenes that geometry overlay does not draw, without lines, without levels of detail.

use super::super::change::change;
use super::rows::{COUNTS, DataSet, POLYLINES, Row};
use super::storing::storage;
use super::sweeps::SWEEPS;
use crate::buffer::Buffer;
use crate::draw_list::{DrawList, Role};
use crate::error::{Error, Result};
use crate::measure::{Times, Watch, scene_result, timed};
use crate::open::Opened;
use crate::scene::Camera;
use crate::scene_file::SceneText;
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::technique::{FrameOptions, Prepared, geometry_overlay};
use crate::terrain::lod;
use std::sync::Arc;

/// Measures a scene's lines from its own camera, each thing `repeat` times (at least once).
///
/// # Errors
/// When geometry overlay does not draw the scene, or it has neither lines nor outlines, or no level-of-detail mesh; internal errors.
pub fn measure(scene: Opened, repeat: u32, watch: &dyn Watch) -> Result<DataSet> {
    let Opened { text, mut stage } = scene;
    geometry_overlay::applies(&stage)?;
    let (Some(_), Some(lattice)) = (stage.scene.lod, stage.mesh.lattice()) else {
        return Err(Error::new("there is no level-of-detail mesh to measure").help(
            "write terrain.lod = { error_px = 1.0 } and terrain.diagonal = \"alternating\" (or `--set` them)",
        ));
    };
    let posts = lattice.size();
    let (polylines, points) = counted(&stage.draw_list);
    if points == 0 {
        return Err(Error::new("there are no lines and no outlines to measure").help(
            "give a layer `line` or `outline`, or leave the scene out: then there is data like the paper's",
        ));
    }
    let camera = stage.scene.camera;
    // So that the mesh is made anew for the view, not taken from before.
    let away = Camera { eye: camera.target + (camera.eye - camera.target) * 1.0625, ..camera };
    let bench =
        Bench { view: stage.view()?, away: away.view(&stage.scene.image)?, repeat: repeat.max(1), watch };
    let mut rows = Vec::new();
    let bare = Stage::of_draw_list(
        stage.scene.clone(),
        DrawList::new(&mut [], &stage.mesh.plan_bounds())?,
        Arc::clone(&stage.mesh),
    )?;
    let mut first = None;
    for (setting, stage) in [("on", &stage), ("off", &bare)] {
        watch.start(&format!("{POLYLINES} {setting}"));
        rows.push(bench.row((POLYLINES, setting), stage, &mut first)?);
    }
    drop(bare);
    let storage = storage(&stage, posts, repeat, watch)?;
    for sweep in &SWEEPS {
        let mut first = None;
        for (setting, changes) in sweep.settings {
            watch.start(&format!("{} {setting}", sweep.varied));
            stage = changed(stage, &text, changes)?;
            rows.push(bench.row((sweep.varied, setting), &stage, &mut first)?);
        }
        stage = changed(stage, &text, &[])?;
    }
    let image = &stage.scene.image;
    Ok(DataSet {
        width: image.width,
        height: image.height,
        scene: scene_result(&stage, &text.file.hash),
        posts,
        polylines,
        points,
        storage,
        rows,
    })
}

/// How many lines are overlaid, and their points.
fn counted(list: &DrawList) -> (usize, usize) {
    let (mut lines, mut points) = (0, 0);
    for (number, item) in list.numbered() {
        let style = list.style_of(number);
        let chains = match style.role {
            Role::Fill if style.swath.is_some() => list.centre_lines(item),
            Role::Fill | Role::Outside => list.border(item),
            Role::Outline | Role::Line | Role::Point => list.strokes(item),
        };
        lines += chains.len();
        points += chains.iter().map(|chain| list.path_of(chain).len()).sum::<usize>();
    }
    (lines, points)
}

/// A stage with the settings that its scene's file has with some changes: of techniques, and of the level of detail.
fn changed(mut stage: Stage, text: &SceneText, changes: &[&str]) -> Result<Stage> {
    let lod = text.changed(changes)?.terrain.lod;
    if lod != stage.scene.lod {
        let Stage { mut scene, draw_list, mesh, .. } = stage;
        scene.lod = lod;
        stage = Stage::of_draw_list(scene, draw_list, mesh)?;
    }
    change(&mut stage, text, changes)?;
    Ok(stage)
}

/// How frames are measured.
struct Bench<'a> {
    view: ViewFrame,
    /// Another view.
    away: ViewFrame,
    repeat: u32,
    watch: &'a dyn Watch,
}

impl Bench<'_> {
    /// Measures a stage; `first` is the picture of the first setting, once there is one.
    fn row(
        &self,
        (varied, setting): (&'static str, &'static str),
        stage: &Stage,
        first: &mut Option<Buffer<[u8; 4]>>,
    ) -> Result<Row> {
        let (view, watch) = (&self.view, self.watch);
        let (mut mesh_ms, mut walk_ms, mut frame_ms) = (Vec::new(), Vec::new(), Vec::new());
        for _ in 0..self.repeat {
            stage.mesh_for(&self.away);
            mesh_ms.push(timed(watch, || Ok(stage.mesh_for(view)))?.1);
        }
        let prepared = geometry_overlay::Prepare::new(stage)?;
        let drawn = || prepared.frame(view, &FrameOptions::default());
        let (mut frame, first_frame_ms) = timed(watch, drawn)?;
        for _ in 0..self.repeat {
            walk_ms.push(timed(watch, || Ok(prepared.walk(view)))?.1);
            let (again, ms) = timed(watch, drawn)?;
            frame_ms.push(ms);
            frame = again;
        }
        let mesh = stage.mesh_for(view);
        let lod::Deviation { metres, pixels, .. } = mesh.deviation().unwrap_or_default();
        let first = first.get_or_insert_with(|| frame.image.clone());
        let pairs = first.values().iter().zip(frame.image.values());
        Ok(Row {
            varied,
            setting,
            mesh_ms: Times::of(mesh_ms),
            walk_ms: Times::of(walk_ms),
            first_frame_ms,
            frame_ms: Times::of(frame_ms),
            triangles: mesh.triangle_ids() as usize,
            vertices: mesh.vertices().count(),
            deviation_m: metres,
            deviation_px: pixels,
            changed_pixels: pairs.filter(|(a, b)| a != b).count(),
            counts: frame.counts.into_iter().filter(|(name, _)| COUNTS.contains(name)).collect(),
        })
    }
}
