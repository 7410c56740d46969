//! A scene's frames, measured one after the other.
//!
//! Input: an opened scene. Output: [`DataSet`]. Refuses: scenes that inverse projection or stencil volumes do not draw.

use super::super::change::change;
use super::studies::{METHODS, OF_ANY, STUDIES, TILES, Table, WINDOWS};
use super::{DataSet, Row};
use crate::draw_list::DrawList;
use crate::error::Result;
use crate::measure::{Times, Watch, scene_result, timed};
use crate::open::Opened;
use crate::stage::Stage;
use crate::technique::{self, FrameOptions, Kind};
use std::sync::Arc;

/// Measures a scene for the tables that its study is of (by its name; a scene of no study for those that any scene has), each frame `repeat` times
/// (at least once).
///
/// # Errors
/// When a technique does not draw the scene; internal errors.
pub fn measure(scene: Opened, repeat: u32, watch: &dyn Watch) -> Result<DataSet> {
    let Opened { text, mut stage } = scene;
    technique::applies(Kind::InverseProjection, &stage)?;
    technique::applies(Kind::StencilVolume, &stage)?;
    let study = STUDIES.iter().find(|study| study.name == stage.scene.name);
    let bench = Bench { repeat: repeat.max(1), watch };
    let mut rows = Vec::new();
    for table in study.map_or(OF_ANY, |study| study.tables) {
        watch.start(&format!("{}, {}", stage.scene.name, table.number()));
        let paper_fps = study.and_then(|study| study.paper_fps);
        match table {
            Table::Blocks => bench.blocks(&stage, &mut rows)?,
            Table::Window => bench.windows(&mut stage, &mut rows)?,
            Table::Terrain | Table::Vertices => {
                let setting = stage.scene.name.clone();
                let row = bench.row((*table, setting, Kind::InverseProjection), &stage, None)?;
                rows.push(Row { paper_fps, ..row });
            }
            Table::Methods => {
                for (kind, words, setting) in METHODS {
                    change(&mut stage, &text, &[setting])?;
                    rows.push(bench.row((*table, words.to_owned(), kind), &stage, None)?);
                }
                change(&mut stage, &text, &[])?;
            }
        }
    }
    let image = &stage.scene.image;
    let edges = rows.iter().map(|row| row.vertices).max().unwrap_or(0);
    Ok(DataSet {
        width: image.width,
        height: image.height,
        scene: scene_result(&stage, &text.file.hash),
        triangles: stage.mesh.triangle_ids() as usize,
        vertices: edges,
        rows,
    })
}

/// How frames are measured.
struct Bench<'a> {
    repeat: u32,
    watch: &'a dyn Watch,
}

impl Bench<'_> {
    /// Table 2.
    fn blocks(&self, stage: &Stage, rows: &mut Vec<Row>) -> Result<()> {
        for side in TILES {
            let setting = format!("{side} × {side}");
            rows.push(self.row((Table::Blocks, setting, Kind::InverseProjection), stage, Some(side))?);
        }
        Ok(())
    }

    /// Table 3: each size of the picture without vectors, and with them.
    fn windows(&self, stage: &mut Stage, rows: &mut Vec<Row>) -> Result<()> {
        let (width, height) = (stage.scene.image.width, stage.scene.image.height);
        for (columns, lines, paper) in WINDOWS {
            (stage.scene.image.width, stage.scene.image.height) = (columns, lines);
            let nothing = DrawList::new(&mut [], &stage.mesh.plan_bounds())?;
            let bare = Stage::of_draw_list(stage.scene.clone(), nothing, Arc::clone(&stage.mesh))?;
            for (stage, words, fps) in
                [(&bare, "terrain", paper[0]), (&*stage, "terrain and vectors", paper[1])]
            {
                let setting = format!("{columns} × {lines}, {words}");
                let row = self.row((Table::Window, setting, Kind::InverseProjection), stage, None)?;
                rows.push(Row { paper_fps: Some(fps), ..row });
            }
        }
        (stage.scene.image.width, stage.scene.image.height) = (width, height);
        Ok(())
    }

    /// Measures a frame, in tiles of a size that is not the usual one where it says so.
    fn row(
        &self,
        (table, setting, kind): (Table, String, Kind),
        stage: &Stage,
        tile: Option<usize>,
    ) -> Result<Row> {
        let prepared = technique::prepare(kind, stage)?;
        let view = stage.view()?;
        let usual = FrameOptions::default();
        let options = FrameOptions { tile: tile.unwrap_or(usual.tile), ..usual };
        // What is made when it is first seen is made before.
        let mut frame = prepared.frame(&view, &options)?;
        let mut frame_ms = Vec::new();
        for _ in 0..self.repeat {
            let (again, ms) = timed(self.watch, || prepared.frame(&view, &options))?;
            frame_ms.push(ms);
            frame = again;
        }
        let count =
            |name: &str| frame.counts.iter().find(|(counted, _)| *counted == name).map_or(0, |(_, n)| *n);
        Ok(Row {
            table: table.number(),
            setting,
            technique: kind.name(),
            frame_ms: Times::of(frame_ms),
            paper_fps: None,
            vertices: count("edges") as usize,
            border_pixels: count("pixels_p"),
            samples: count("samples"),
            edge_tests: count("edge_tests"),
        })
    }
}
