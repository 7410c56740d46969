//! A scene and its pictures as files for a program that draws the same on a graphics processor.

use super::gltf::glb;
use super::manifest::stage_manifest;
use super::readme::readme;
use super::run_files::RunFiles;
use super::{
    Buffers, FeatureTable, Parameters, TilePicture, item_paints, items, plan_points, stage_allowed, tiles,
    triangles, vertices, write_features,
};
use crate::allowed;
use crate::buffer::Buffer;
use crate::error::Result;
use crate::measure::{Certified, Unwatched, Watch, view_result};
use crate::output::{Batch, ByName, Npy, RESULT_SCHEMA, RenderResult, write_png};
use crate::scene::{Column, GroundColors, Imagery};
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::technique::clipmap::{self, TILE_TEXELS};
use crate::technique::{self, Frame, Kind};
use crate::terrain::Mesh;
use crate::truth::Budget;
use std::path::Path;

/// A bundle to be made: mesh, features, matrices and parameters, a technique's picture with all its buffers, a clipmap's tiles, and the
/// truth. Its `README.md` tells what is where, and how the technique goes.
///
/// ```
/// use drapery::{Bundle, Opened, Technique};
/// # let folder = tempfile::tempdir().unwrap();
/// # let folder = folder.path().join("bundle");
/// let scene = Opened::parse(drapery::tutorial::SMALL_SCENE)?;
/// Bundle::of(&scene.stage, Technique::StencilVolume).write_to(&folder)?;
/// assert!(folder.join("parameters.json").exists());
/// # Ok::<(), drapery::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Bundle<'a> {
    /// What is drawn.
    pub stage: &'a Stage,
    /// The hash of its scene file (`SceneFile::hash`), for `result.json`.
    pub hash: &'a str,
    /// The columns of attributes of each layer, which a stage does not keep ([`load::attributes`](crate::source::load::attributes)); may be empty.
    pub attributes: &'a [Vec<Column>],
    /// What the client draws by.
    pub technique: Kind,
    /// How exact the truth is.
    pub budget: Budget,
    /// Whether it holds what pictures would be by other choices, for who fails: each takes as long as what is allowed, and as many bytes.
    pub alternatives: bool,
}

impl<'a> Bundle<'a> {
    /// A bundle with the default truth, of a scene that no file says.
    pub fn of(stage: &'a Stage, technique: Kind) -> Self {
        let budget = Budget::default();
        Self { stage, hash: "", attributes: &[], technique, budget, alternatives: false }
    }

    /// Writes the bundle into a folder, which is made where it is missing; times are not measured.
    ///
    /// # Errors
    /// As [`Bundle::write`].
    pub fn write_to(&self, folder: impl AsRef<Path>) -> Result<()> {
        self.write(Batch::into(folder.as_ref())?, &Unwatched)
    }

    /// Writes the bundle; the files are in their places when it returns.
    ///
    /// # Errors
    /// When the technique does not draw such a scene, or a file cannot be written: then no file is.
    pub fn write(&self, mut batch: Batch, watch: &dyn Watch) -> Result<()> {
        self.stage_into(&mut batch, watch)?;
        batch.commit()
    }

    /// Stages the bundle's files in the folder that a batch has entered.
    ///
    /// # Errors
    /// As [`Bundle::write`].
    pub fn stage_into(&self, batch: &mut Batch, watch: &dyn Watch) -> Result<()> {
        let stage = self.stage;
        let view = stage.view()?;
        technique::applies(self.technique, stage)?;
        let certified = Certified::of((stage, &view), &self.budget, 1, watch)?;
        let (buffers, view) = (&Buffers::All, &view);
        let mut files = RunFiles {
            stage,
            view,
            certified: Some(&certified),
            buffers,
            is_elsewhere: &in_tiles,
            batch,
            watch,
        };
        let truth = files.truth(&certified, &[])?;
        let (run, frame) = files.technique(self.technique, 1)?;
        watch.start("tiles and mesh");
        for TilePicture { name, picture } in tiles_of(&frame, stage) {
            batch.stage(&format!("tiles/{name}.png"), |to| write_png(&picture, to))?;
        }
        let mesh = stage.mesh_for(view);
        self.stage_scene(&mesh, batch)?;
        let parameters = Parameters::new((&stage.scene, &mesh, view), self.technique).to_json()?;
        let readme = readme(stage, self.technique, &frame.planes, &in_tiles);
        let (scene, notes) = (view_result(stage, view, self.hash), stage.scene.notes.clone());
        let result = RenderResult {
            schema: RESULT_SCHEMA,
            scene,
            notes,
            runs: vec![truth, run],
            pick: None,
            items: None,
        }
        .to_json()?;
        let texts = [("parameters.json", &parameters[..]), ("result.json", &result), ("README.md", &readme)];
        for (name, text) in texts {
            batch.stage(name, |to| to.write_all(text.as_bytes()))?;
        }
        self.stage_allowed(view, batch, watch)?;
        stage_manifest(self.technique.name(), batch)
    }

    /// What the technique's picture may be; where nobody knows, a word about it.
    fn stage_allowed(&self, view: &ViewFrame, batch: &mut Batch, watch: &dyn Watch) -> Result<()> {
        watch.start("what is allowed");
        match allowed::allowed(self.technique, (self.stage, view), &|share| watch.done(share)) {
            Ok(mut all) => {
                if self.alternatives {
                    watch.start("other choices");
                    let told = |share: f64| watch.done(share);
                    all.alternatives =
                        allowed::alternatives(self.technique, (self.stage, view), &all, &told)?;
                }
                let envelope = ByName::from_pairs(allowed::envelope(&self.stage.scene.device));
                stage_allowed((&all, &envelope), self.technique.name(), batch)
            }
            Err(error) if error.is_internal() => Err(error),
            Err(error) => {
                watch.note(&format!("the bundle does not say what is allowed: {}", error.what()));
                Ok(())
            }
        }
    }

    /// What is drawn: mesh, features, imagery.
    fn stage_scene(&self, mesh: &Mesh, batch: &mut Batch) -> Result<()> {
        let Stage { scene, draw_list, .. } = self.stage;
        for table in [vertices(mesh), triangles(mesh)].into_iter().chain(plan_points(mesh)) {
            let name = format!("mesh.{}.npy", table.name);
            let table = Npy::new(&table)?;
            batch.stage(&name, |to| table.write(to))?;
        }
        for (name, table) in [("items", items(draw_list)), ("items.paint", item_paints(draw_list))] {
            let table = Npy::new(&table)?;
            batch.stage(&format!("{name}.npy"), |to| table.write(to))?;
        }
        let scene_in_one = glb(scene, draw_list, mesh)?;
        batch.stage("scene.glb", |to| to.write_all(&scene_in_one))?;
        let (layers, list, plan_space) = (&scene.layers[..], draw_list, &scene.plan_space[..]);
        let origin = scene.origin.truncate();
        let (technique, said) = (self.technique, &scene.technique);
        let features = FeatureTable {
            layers,
            list,
            attributes: self.attributes,
            plan_space,
            origin,
            drawn_by: (technique, said),
        };
        batch.stage("features.geojson", |to| write_features(&features, to))?;
        if let GroundColors::Imagery(Imagery { texels, .. }) = &scene.ground.colors {
            let codes = texels.values().iter().map(|color| color.0.map(|v| (v * 255.0 + 0.5) as u8));
            let picture = Buffer::from_values(texels.width(), texels.height(), codes.collect());
            batch.stage("imagery.png", |to| write_png(&picture, to))?;
        }
        Ok(())
    }
}

/// Whether a buffer is in the pyramid of tiles.
fn in_tiles(name: &str) -> bool {
    name == "tiles"
}

/// The tiles of a frame that has such.
fn tiles_of(frame: &Frame, stage: &Stage) -> Vec<TilePicture> {
    let plane = |name: &str| frame.planes.iter().find(|plane| plane.name == name);
    let size = stage.scene.technique.get::<clipmap::Settings>().virtual_size;
    match (plane("tiles"), plane("tile-keys")) {
        (Some(pictures), Some(keys)) => tiles(pictures, keys, size, TILE_TEXELS),
        _ => Vec::new(),
    }
}
