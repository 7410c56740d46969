//! `drapery report --tables [SCENE]...`: the papers' own tables.

use crate::cli::bar::Bar;
use crate::cli::measure::{scene_result, timed};
use crate::cli::scene_input::SceneInput;
use drapery::draw_list::{Chain, Role};
use drapery::output::Batch;
use drapery::report::Times;
use drapery::report::tables::{
    DataSet, SolutionRow, TABLES_SCHEMA, Tables, VARIANTS, Variant, WIDTH_CHANGES, WidthRow, page,
};
use drapery::space::Plan;
use drapery::stage::Stage;
use drapery::technique::clipmap;
use drapery::{Error, Result};

/// Measures all data sets.
pub(super) fn measure(inputs: &[SceneInput], repeat: u32, bar: &Bar) -> Result<Tables> {
    let sets: Result<Vec<DataSet>> = inputs.iter().map(|input| data_set(input, repeat, bar)).collect();
    Ok(Tables { schema: TABLES_SCHEMA, repeat, data_sets: sets? })
}

/// Writes all files; they are in their places when it returns.
pub(super) fn write(tables: &Tables, mut batch: Batch) -> Result<()> {
    let json = tables.to_json()?;
    batch.stage("tables.html", |to| to.write_all(page(tables).as_bytes()))?;
    batch.stage("tables.csv", |to| to.write_all(tables.to_csv().as_bytes()))?;
    batch.stage("tables.json", |to| to.write_all(json.as_bytes()))?;
    batch.commit()
}

/// A data set in some lines, for people.
pub(super) fn told(set: &DataSet) -> String {
    let mut text = format!("{}: {} segments", set.scene.name, set.segments);
    for row in &set.solutions {
        text.push_str(&format!(
            "\n  {:<14} {:<8} {:>9.1} MiB  generation {:>8.0} ms  rendering {:>8.0} ms",
            row.solution,
            if row.is_combined { "combined" } else { "alone" },
            row.geometry_bytes as f64 / 1_048_576.0,
            row.generation_ms.median,
            row.rendering_ms.median,
        ));
    }
    for row in &set.width_changes {
        text.push_str(&format!("\n  width: {:>9.2} ms  {}", row.ms.median, row.name));
    }
    text
}

fn data_set(input: &SceneInput, repeat: u32, bar: &Bar) -> Result<DataSet> {
    let mut stage = input.stage(bar)?;
    let [features, segments, vertices] = counted(&stage);
    if segments == 0 {
        return Err(Error::new("there are no lines and no outlines to measure").help(
            "give a layer `line` or `outline`, or leave the scene out: then there are the paper's data sets",
        ));
    }
    let bounds = stage.mesh.plan_bounds();
    let size = bounds.max - bounds.min;
    let middle = Plan::new(bounds.min.x + 0.5 * size.x, bounds.min.y + 0.5 * size.y);
    let mut solutions = Vec::new();
    for (k, variant) in VARIANTS.iter().enumerate() {
        bar.start(&format!("{} {}/{}", variant.solution, k + 1, VARIANTS.len()));
        change(&mut stage, input, variant.changes)?;
        solutions.extend(solution(variant, &stage, middle, repeat)?);
    }
    Ok(DataSet {
        scene: scene_result(&stage, &input.file),
        features,
        segments,
        vertices,
        area_km2: size.x * size.y / 1e6,
        solutions,
        width_changes: width_changes(&mut stage, input, repeat, bar)?,
    })
}

/// How many lines and outlined polygons a scene has, with how many segments and vertices; of a line that ends where it begins, both ends.
fn counted(stage: &Stage) -> [usize; 3] {
    let (list, [mut features, mut segments, mut vertices]) = (&stage.draw_list, [0; 3]);
    for (number, item) in list.numbered() {
        let role = list.style_of(number).role;
        let path =
            |chain: &Chain| if role == Role::Line { list.path_of(chain) } else { list.vertices_of(chain) };
        features += usize::from(role != Role::Fill);
        segments += list.strokes(item).iter().map(|chain| chain.segments() as usize).sum::<usize>();
        vertices += list.strokes(item).iter().map(|chain| path(chain).len()).sum::<usize>();
    }
    [features, segments, vertices]
}

/// Measures a solution so often.
fn solution(variant: &Variant, stage: &Stage, middle: Plan, repeat: u32) -> Result<Option<SolutionRow>> {
    let (mut generation, mut rendering) = (Vec::new(), Vec::new());
    let mut last = None;
    for _ in 0..repeat {
        let (prepared, ms) = timed(|| clipmap::Prepare::new(stage))?;
        generation.push(ms);
        let (drawn, ms) = timed(|| Ok(prepared.reconstruct(middle)))?;
        rendering.push(ms);
        last = Some((drawn, prepared.memory()));
    }
    Ok(last.map(|((tiles, counts), (geometry_bytes, index_bytes))| SolutionRow {
        solution: variant.solution.into(),
        is_combined: variant.is_combined,
        geometry_bytes,
        index_bytes,
        generation_ms: Times::of(generation),
        rendering_ms: Times::of(rendering),
        tiles,
        line_primitives: counts.lines,
        quads: counts.quads,
    }))
}

fn width_changes(stage: &mut Stage, input: &SceneInput, repeat: u32, bar: &Bar) -> Result<Vec<WidthRow>> {
    let mut rows = Vec::new();
    for way in &WIDTH_CHANGES {
        bar.start("changing widths");
        change(stage, input, way.changes)?;
        let mut prepared = clipmap::Prepare::new(stage)?;
        let mut times = Vec::new();
        for _ in 0..repeat {
            // There and back, so that the next turn finds what this one found.
            for factor in [1.25, 0.8] {
                let (is_done, ms) = timed(|| Ok(prepared.change_width(factor)))?;
                if !is_done {
                    return Err(Error::internal(format!("widths cannot be changed: {}", way.name)));
                }
                times.push(ms);
            }
        }
        rows.push(WidthRow { name: way.name.into(), ms: Times::of(times) });
    }
    Ok(rows)
}

/// The stage with other settings of the technique.
fn change(stage: &mut Stage, input: &SceneInput, changes: &[&str]) -> Result<()> {
    stage.scene.technique = input.changed(changes)?.technique;
    Ok(())
}
