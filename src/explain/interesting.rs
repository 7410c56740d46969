//! The pixels of a picture that are worth a look: where a technique is farthest from the truth, or the truth is wide.

use super::account::{Account, Right, color_of};
use super::asking::{Asking, account};
use super::bench::Bench;
use super::close_up::close_up;
use super::names::Names;
use super::techniques::{Prepare, told};
use crate::buffer::Buffer;
use crate::compare::{Difference, Expected, Image};
use crate::error::{Error, Result};
use crate::math;
use crate::measure::Watch;
use crate::open::Opened;
use crate::parallel;
use crate::space::{Screen, ViewFrame};
use crate::stage::Stage;
use crate::technique::{Explanation, FrameOptions};
use crate::terrain::Mesh;
use crate::truth::{self, Budget, Truth, footprints_seen};
use crate::visibility::TILE;

/// What rounding to a code value may take a right colour away from the truth, and a little more.
const ROUNDING: f64 = 0.501 / 255.0;

/// Samples a side of a pixel's close-up: of those that are seen one by one in a page of many.
const CLOSE_UP: usize = 40;

/// The smallest square of which one pixel is chosen, pixels.
const LEAST_SQUARE: usize = 4;

/// The pixels of a picture that are worth a look.
#[derive(Debug)]
pub struct Interesting {
    /// What is told of each, the one with the widest disagreement first.
    pub accounts: Vec<Account>,
    /// The truth's picture, where techniques are wrong, and theirs, by name.
    pub pictures: Vec<(String, Buffer<[u8; 4]>)>,
    /// Columns and rows of the picture.
    pub size: [usize; 2],
    /// At most one pixel was chosen of each square of so many pixels a side.
    pub square: usize,
}

/// A picture by the techniques, each with how far its pixels are from the truth.
struct Measured {
    pictures: Vec<(String, Buffer<[u8; 4]>)>,
    /// Of each pixel, how far the techniques are from the truth at most, and how wide that is.
    off: Vec<f64>,
    wide: Vec<f64>,
}

/// Looks for the pixels of a scene's view that are worth a look, at most so many, and tells of each what there is to tell.
///
/// # Errors
/// When a technique that is asked for does not draw the scene.
pub fn picture(scene: &Opened, asking: &Asking, most: usize, watch: &dyn Watch) -> Result<Interesting> {
    let (stage, view) = (&scene.stage, &scene.view()?);
    let techniques = Prepare::new(stage, asking.kinds)?;
    let mesh = &*stage.mesh_for(view);
    watch.start("the truth");
    let truth = truth::certify(stage, view, &asking.budget, &|share| watch.done(share));
    let measured = measured(&truth, view, &techniques, watch)?;
    let (pixels, square) = chosen(&measured, view, (most, asking.budget.width));
    watch.start("explaining");
    let accounts = accounts((stage, view, mesh), asking, &techniques, (&pixels, watch))?;
    let mut pictures =
        vec![("truth".to_owned(), truth.image()), ("where".to_owned(), heat(&measured, view)?)];
    pictures.extend(measured.pictures);
    Ok(Interesting { accounts, pictures, size: [view.width(), view.height()], square })
}

fn measured(truth: &Truth, view: &ViewFrame, techniques: &Prepare, watch: &dyn Watch) -> Result<Measured> {
    let bounds = truth.low.values().iter().zip(truth.high.values());
    let right: Vec<Right> =
        bounds.map(|(low, high)| Right { low: *low, high: *high, estimate: *low }).collect();
    let mut all = Measured {
        pictures: Vec::new(),
        off: vec![0.0; right.len()],
        wide: right.iter().map(Right::width).collect(),
    };
    for (kind, prepared) in &techniques.prepared {
        watch.start(kind.name());
        let options = FrameOptions { tile: TILE, buffers: &[], progress: &|share| watch.done(share) };
        let image = prepared.frame(view, &options)?.image;
        for ((off, right), code) in all.off.iter_mut().zip(&right).zip(image.values()) {
            *off = math::max(right.distance(color_of(*code)), *off);
        }
        all.pictures.push((kind.name().to_owned(), image));
    }
    Ok(all)
}

/// At most so many pixels, the worst first, no two of a square; and the square's side.
fn chosen(measured: &Measured, view: &ViewFrame, (most, width): (usize, f64)) -> (Vec<[usize; 2]>, usize) {
    let score = |k: usize| {
        let wide = if measured.wide[k] > width { measured.wide[k] } else { 0.0 };
        let off = if measured.off[k] > ROUNDING { measured.off[k] } else { 0.0 };
        math::max(off, wide)
    };
    let columns = view.width();
    let mut side = LEAST_SQUARE;
    loop {
        let across = columns.div_ceil(side);
        let mut best: Vec<Option<usize>> = vec![None; across * view.height().div_ceil(side)];
        for k in (0..measured.off.len()).filter(|k| score(*k) > 0.0) {
            let known = &mut best[k / columns / side * across + k % columns / side];
            if known.is_none_or(|known| score(known) < score(k)) {
                *known = Some(k);
            }
        }
        let mut found: Vec<usize> = best.into_iter().flatten().collect();
        if found.len() <= most || side >= columns.max(view.height()) {
            found.sort_by(|a, b| score(*b).total_cmp(&score(*a)).then(a.cmp(b)));
            found.truncate(most);
            return (found.into_iter().map(|k| [k % columns, k / columns]).collect(), side);
        }
        side *= 2;
    }
}

/// What is told of some pixels.
fn accounts(
    (stage, view, mesh): (&Stage, &ViewFrame, &Mesh),
    asking: &Asking,
    techniques: &Prepare,
    (pixels, watch): (&[[usize; 2]], &dyn Watch),
) -> Result<Vec<Account>> {
    let names = Names::new(&stage.scene, asking.attributes);
    let window = [Screen::default(), Screen::new(view.width() as f64, view.height() as f64)];
    let footprints = footprints_seen(&stage.draw_list, (mesh, view), window);
    let budget = Budget { coverage: true, ..asking.budget };
    let bench = Bench::new((stage, view, mesh), (&footprints, &names), budget);
    let mut explained: Vec<(_, Vec<Explanation>)> = Vec::new();
    for (kind, prepared) in &techniques.prepared {
        explained.push((*kind, prepared.steps_of_all(view, pixels)?));
    }
    let nears = bench.look(pixels);
    let told = |k: usize| {
        let near = &nears[k];
        let mut account = account(&bench, near);
        account.close_up = Some(close_up(&bench, near, CLOSE_UP));
        account.left_out.clone_from(&techniques.left_out);
        for (kind, explained) in &explained {
            account.techniques.push(told(&bench, near, &account.truth, *kind, &explained[k]));
        }
        account
    };
    Ok(parallel::map_telling(pixels.len(), &|share| watch.done(share), told))
}

/// Where techniques are wrong, as `compare` shows it.
fn heat(measured: &Measured, view: &ViewFrame) -> Result<Buffer<[u8; 4]>> {
    let image = |values: Vec<f64>| Image::new(view.width(), view.height(), 1, values);
    let right = Expected::exactly(image(vec![0.0; measured.off.len()])?);
    let difference = Difference::of(&right, &image(measured.off.clone())?)
        .map_err(|what| Error::internal(format!("where techniques are wrong: {what}")).caused_by(what))?;
    Ok(difference.heat_map(ROUNDING))
}
