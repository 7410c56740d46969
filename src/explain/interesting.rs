//! The pixels of a picture that are worth a look: where a technique is farthest from the truth, or the truth is wide.

use super::account::{Account, ROUNDING, Right, color_of};
use super::asking::{Asking, account, name_items};
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

/// Samples a side of a pixel's close-up: of those that are seen one by one in a page of many.
const CLOSE_UP: usize = 40;

/// The smallest square of which one pixel is chosen, pixels.
const LEAST_SQUARE: usize = 4;

/// The pixels of a picture that are worth a look.
#[derive(Debug)]
pub struct Interesting {
    /// What is told of each: of each technique in turn the one where it is farthest from the truth, then the next.
    pub accounts: Vec<Account>,
    /// The truth's picture, where techniques are wrong, and theirs, by name.
    pub pictures: Vec<(String, Buffer<[u8; 4]>)>,
    /// Columns and rows of the picture.
    pub size: [usize; 2],
    /// Of each square of so many pixels a side at most one pixel was chosen for each technique.
    pub square: usize,
}

/// A picture by the techniques, each with how far its pixels are from the truth.
struct Measured {
    pictures: Vec<(String, Buffer<[u8; 4]>)>,
    /// Of each technique, how far each pixel is from the truth; at last, how wide that is where it is wider than asked for. 0: no more than rounding.
    off: Vec<Vec<f64>>,
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
    let measured = measured(&truth, (view, asking.budget.width), &techniques, watch)?;
    let (pixels, square) = chosen(&measured.off, view, most);
    watch.start("explaining");
    let accounts = accounts((stage, view, mesh), asking, &techniques, (&pixels, watch))?;
    let mut pictures =
        vec![("truth".to_owned(), truth.image()), ("where".to_owned(), heat(&measured, view)?)];
    pictures.extend(measured.pictures);
    Ok(Interesting { accounts, pictures, size: [view.width(), view.height()], square })
}

fn measured(
    truth: &Truth,
    (view, width): (&ViewFrame, f64),
    techniques: &Prepare,
    watch: &dyn Watch,
) -> Result<Measured> {
    let bounds = truth.low.values().iter().zip(truth.high.values());
    let right: Vec<Right> =
        bounds.map(|(low, high)| Right { low: *low, high: *high, estimate: *low }).collect();
    let beyond = |value: f64, least: f64| if value > least { value } else { 0.0 };
    let mut all = Measured { pictures: Vec::new(), off: Vec::new() };
    for (kind, prepared) in &techniques.prepared {
        watch.start(kind.name());
        let options = FrameOptions { tile: TILE, buffers: &[], progress: &|share| watch.done(share) };
        let image = prepared.frame(view, &options)?.image;
        let off = right.iter().zip(image.values());
        all.off.push(off.map(|(right, code)| beyond(right.distance(color_of(*code)), ROUNDING)).collect());
        all.pictures.push((kind.name().to_owned(), image));
    }
    all.off.push(right.iter().map(|right| beyond(right.width(), width)).collect());
    Ok(all)
}

/// At most so many pixels, the worst of each measure in turn, no two of a square for one measure; and the square's side.
fn chosen(off: &[Vec<f64>], view: &ViewFrame, most: usize) -> (Vec<[usize; 2]>, usize) {
    let (columns, rows) = (view.width(), view.height());
    let mut side = LEAST_SQUARE;
    let lists = loop {
        let lists: Vec<Vec<usize>> = off.iter().map(|off| worst_of_squares(off, columns, side)).collect();
        let longest = lists.iter().map(Vec::len).max().unwrap_or(0);
        if longest <= most || side >= columns.max(rows) {
            break lists;
        }
        side += side / 4;
    };
    let mut found: Vec<usize> = Vec::new();
    let rounds = lists.iter().map(Vec::len).max().unwrap_or(0);
    for k in (0..rounds).flat_map(|round| lists.iter().filter_map(move |list| list.get(round))) {
        if found.len() < most && !found.contains(k) {
            found.push(*k);
        }
    }
    (found.into_iter().map(|k| [k % columns, k / columns]).collect(), side)
}

/// The worst pixel of each square in which one is off, the worst of all first.
fn worst_of_squares(off: &[f64], columns: usize, side: usize) -> Vec<usize> {
    let across = columns.div_ceil(side);
    let mut best: Vec<Option<usize>> = vec![None; across * (off.len() / columns).div_ceil(side)];
    for k in (0..off.len()).filter(|k| off[*k] > 0.0) {
        let known = &mut best[k / columns / side * across + k % columns / side];
        if known.is_none_or(|known| off[known] < off[k]) {
            *known = Some(k);
        }
    }
    let mut found: Vec<usize> = best.into_iter().flatten().collect();
    found.sort_by(|a, b| off[*b].total_cmp(&off[*a]).then(a.cmp(b)));
    found
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
        name_items(&bench, &mut account);
        account
    };
    Ok(parallel::map_telling(pixels.len(), &|share| watch.done(share), told))
}

/// Where techniques are wrong, as `compare` shows it.
fn heat(measured: &Measured, view: &ViewFrame) -> Result<Buffer<[u8; 4]>> {
    let image = |values: Vec<f64>| Image::new(view.width(), view.height(), 1, values);
    let count = view.width() * view.height();
    let mut most = vec![0.0; count];
    for off in &measured.off[..measured.pictures.len()] {
        most.iter_mut().zip(off).for_each(|(most, off)| *most = math::max(*off, *most));
    }
    let right = Expected::exactly(image(vec![0.0; count])?);
    let difference = Difference::of(&right, &image(most)?)
        .map_err(|what| Error::internal(format!("where techniques are wrong: {what}")).caused_by(what))?;
    Ok(difference.heat_map(ROUNDING))
}
