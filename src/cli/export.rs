//! `drapery export [SCENE]`

use super::bar::Bar;
use super::measure::{Certified, TruthArguments, scene_result};
use super::render::draw::{Drawing, Wish};
use super::render::techniques::{self, Buffers, Name};
use super::scene_input::SceneInput;
use super::stop::{Outcome, Status};
use drapery::buffer::Buffer;
use drapery::export::{
    LAYOUT, Parameters, TilePicture, plan_points, tiles, triangles, vertices, write_features,
};
use drapery::output::{Batch, Npy, RESULT_SCHEMA, RenderResult, write_png};
use drapery::scene::{Ground, Imagery};
use drapery::stage::Stage;
use drapery::technique::clipmap::TILE_TEXELS;
use drapery::technique::{self, Frame, Kind, clipmap};
use drapery::terrain::Mesh;
use drapery::truth::Budget;
use drapery::{Error, Result, parallel};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  drapery export scene.toml -t clipmap -o bundle
  drapery export scene.toml -t stencil-volume --set image.width=800 -o bundle
  drapery compare bundle/clipmap.png mine.png --tolerance 1/255

Writes the mesh and vertex sequences as .npy, features as GeoJSON, matrices and parameters as JSON, the technique's picture with all its
buffers, a clipmap's tiles as z/x/y, and the truth with what each pixel may be. DIR/README.md tells what is where.";

#[derive(Debug, clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub(super) struct Arguments {
    /// The scene file, `-` for stdin; without it, a built-in generated scene.
    scene: Option<PathBuf>,
    /// What the client draws by.
    #[arg(short, long, value_name = "T")]
    technique: Name,
    /// Change the scene: a dotted path and a TOML value; may be repeated. No value removes the key.
    #[arg(long = "set", value_name = "PATH=VALUE")]
    overrides: Vec<String>,
    /// Where the files go; made where it is missing.
    #[arg(short, long, value_name = "DIR", default_value = "bundle")]
    output: PathBuf,
    /// How many threads; 0: as many as the machine has. The files are the same.
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
    #[command(flatten)]
    truth: TruthArguments,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let budget = arguments.truth.budget()?;
    if arguments.technique == Name::Truth {
        let refusal = Error::new("a client cannot draw by `truth`: it is in every bundle, to judge by");
        return Err(refusal.help("name a technique, such as -t clipmap").into());
    }
    let kind = techniques::built(arguments.technique)?;
    let scene = SceneInput::read(arguments.scene.as_deref(), &arguments.overrides)?;
    let batch = Batch::into(&arguments.output)?;
    let bar = Bar::new();
    let run = || export(&scene, (kind, &budget), batch, &bar);
    parallel::with_threads(arguments.threads, run)?.map_err(|error| scene.blame(error))?;
    bar.say(&format!("what is where: {}", arguments.output.join("README.md").display()));
    Ok(Status::Passed)
}

/// Writes a bundle; the files are in their places when it returns.
fn export(input: &SceneInput, (kind, budget): (Kind, &Budget), mut batch: Batch, bar: &Bar) -> Result<()> {
    let stage = input.stage(bar)?;
    let view = stage.view()?;
    technique::applies(kind, &stage)?;
    let wish = Wish { buffers: Buffers::All, repeat: 1 };
    let certified = Certified::of((&stage, &view), budget, wish.repeat, bar)?;
    let mut drawing = Drawing { stage: &stage, view: &view, certified: &certified, batch: &mut batch, bar };
    let truth = drawing.truth(&wish)?;
    let (run, frame) = drawing.run(kind, &wish)?;
    for TilePicture { name, picture } in tiles_of(&frame, &stage) {
        batch.stage(&format!("tiles/{name}.png"), |to| write_png(&picture, to))?;
    }
    let mesh = stage.mesh_for(&view);
    stage_scene(&stage, &mesh, &mut batch)?;
    let settings = (kind.name(), run.parameters.clone(), run.device.clone());
    let parameters = Parameters::new((&stage.scene, &mesh, &view), settings).to_json()?;
    let scene = scene_result(&stage, &input.file);
    let notes = stage.scene.notes.clone();
    let result = RenderResult { schema: RESULT_SCHEMA, scene, notes, runs: vec![truth, run] }.to_json()?;
    for (name, text) in
        [("parameters.json", &parameters[..]), ("result.json", &result), ("README.md", LAYOUT)]
    {
        batch.stage(name, |to| to.write_all(text.as_bytes()))?;
    }
    batch.commit()
}

/// What is drawn: mesh, features, imagery.
fn stage_scene(stage: &Stage, mesh: &Mesh, batch: &mut Batch) -> Result<()> {
    let Stage { scene, draw_list, .. } = stage;
    for table in [vertices(mesh), triangles(mesh)].into_iter().chain(plan_points(mesh)) {
        let name = format!("mesh.{}.npy", table.name);
        let table = Npy::new(&table)?;
        batch.stage(&name, |to| table.write(to))?;
    }
    batch.stage("features.geojson", |to| {
        write_features((&scene.layers, draw_list), scene.origin.truncate(), to)
    })?;
    if let Ground::Imagery(Imagery { texels, .. }) = &scene.ground {
        let codes = texels.values().iter().map(|color| color.0.map(|v| (v * 255.0 + 0.5) as u8));
        let picture = Buffer::from_values(texels.width(), texels.height(), codes.collect());
        batch.stage("imagery.png", |to| write_png(&picture, to))?;
    }
    Ok(())
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
