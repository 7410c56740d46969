//! A data set measured by each solution.

use super::super::change::change;
use super::{DataSet, SolutionRow, VARIANTS, Variant, WIDTH_CHANGES, WidthRow};
use crate::draw_list::{Chain, Role};
use crate::error::{Error, Result};
use crate::measure::{Times, Watch, scene_result, timed};
use crate::open::Opened;
use crate::scene_file::SceneText;
use crate::space::Plan;
use crate::stage::Stage;
use crate::technique::clipmap;

/// Measures a scene's lines and outlines, each thing `repeat` times (at least once).
///
/// # Errors
/// When the scene has neither lines nor outlines; internal errors.
pub fn measure(scene: Opened, repeat: u32, watch: &dyn Watch) -> Result<DataSet> {
    let Opened { text, mut stage } = scene;
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
        watch.start(&format!("{} {}/{}", variant.solution, k + 1, VARIANTS.len()));
        change(&mut stage, &text, variant.changes)?;
        solutions.extend(solution(variant, (&stage, middle), repeat, watch)?);
    }
    Ok(DataSet {
        scene: scene_result(&stage, &text.file.hash),
        features,
        segments,
        vertices,
        area_km2: size.x * size.y / 1e6,
        solutions,
        width_changes: width_changes(&mut stage, &text, repeat, watch)?,
    })
}

/// How many lines and outlined polygons a scene has, with how many segments and vertices; of a line that ends where it begins, both ends.
fn counted(stage: &Stage) -> [usize; 3] {
    let (list, [mut features, mut segments, mut vertices]) = (&stage.draw_list, [0; 3]);
    for (number, item) in list.numbered() {
        let role = list.style_of(number).role;
        if role == Role::Point {
            continue;
        }
        let path =
            |chain: &Chain| if role == Role::Line { list.path_of(chain) } else { list.vertices_of(chain) };
        features += usize::from(matches!(role, Role::Outline | Role::Line));
        segments += list.strokes(item).iter().map(|chain| chain.segments() as usize).sum::<usize>();
        vertices += list.strokes(item).iter().map(|chain| path(chain).len()).sum::<usize>();
    }
    [features, segments, vertices]
}

/// Measures a solution so often.
fn solution(
    variant: &Variant,
    (stage, middle): (&Stage, Plan),
    repeat: u32,
    watch: &dyn Watch,
) -> Result<Option<SolutionRow>> {
    let (mut generation, mut rendering) = (Vec::new(), Vec::new());
    let mut last = None;
    for _ in 0..repeat {
        let (prepared, ms) = timed(watch, || clipmap::Prepare::new(stage))?;
        generation.push(ms);
        let (drawn, ms) = timed(watch, || Ok(prepared.reconstruct(middle)))?;
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

fn width_changes(
    stage: &mut Stage,
    text: &SceneText,
    repeat: u32,
    watch: &dyn Watch,
) -> Result<Vec<WidthRow>> {
    let mut rows = Vec::new();
    for way in &WIDTH_CHANGES {
        watch.start("changing widths");
        change(stage, text, way.changes)?;
        let mut prepared = clipmap::Prepare::new(stage)?;
        let mut times = Vec::new();
        for _ in 0..repeat {
            // There and back, so that the next turn finds what this one found.
            for factor in [1.25, 0.8] {
                let (is_done, ms) = timed(watch, || Ok(prepared.change_width(factor)))?;
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
