//! A question about pixels, answered.

use super::absence::presence;
use super::account::{Account, Centre, Covering, Ray, Right};
use super::bench::{Bench, Near, Seen};
use super::close_up::close_up;
use super::ladder::ladder;
use super::margin::{margins, silhouette};
use super::names::Names;
use super::scenery::Scenery;
use super::search::Wanted;
use super::techniques::{Prepare, told, try_others};
use crate::error::{Error, Result};
use crate::open::Opened;
use crate::scene::Column;
use crate::space::{Screen, ViewFrame};
use crate::stage::Stage;
use crate::technique::{self, Kind};
use crate::truth::{Budget, footprints_seen};
use std::collections::BTreeMap;

/// Of a pixel's centre no more margins are told.
const MOST_MARGINS: usize = 3;

/// What is asked about pixels.
#[derive(Debug, Clone, Copy)]
pub struct Asking<'a> {
    /// The techniques; `None`: all that draw the scene.
    pub kinds: Option<&'a [Kind]>,
    /// A feature that is looked for: a layer's name, `LAYER/NUMBER`, or what a column says.
    pub feature: Option<&'a str>,
    /// The columns of attributes of each layer, as far as they are known.
    pub attributes: &'a [Vec<Column>],
    /// Samples a side of a close-up of the pixel, for a page; 0: none is made.
    pub close_up: usize,
    /// How exact the truth is to be.
    pub budget: Budget,
}

/// Why a pixel (column, row) of a scene's view has its colour; with what other settings make of it. The stage is as it was afterwards.
///
/// # Errors
/// When the picture has no such pixel, a technique that is asked for does not draw the scene, or there is no such feature.
pub fn pixel(scene: &mut Opened, asking: &Asking, at: [usize; 2]) -> Result<Account> {
    let view = scene.view()?;
    is_in(&view, at)?;
    let mut account = one_pixel(&scene.stage, &view, asking, at)?;
    try_others(&mut account, (&scene.text, &mut scene.stage), &view)?;
    Ok(account)
}

fn is_in(view: &ViewFrame, [x, y]: [usize; 2]) -> Result<()> {
    let (width, height) = (view.width(), view.height());
    if x < width && y < height {
        return Ok(());
    }
    Err(Error::new(format!("there is no pixel {x},{y} in a picture of {width} x {height}"))
        .help("pixels are counted from 0, columns from the left, rows from the top"))
}

fn one_pixel(stage: &Stage, view: &ViewFrame, asking: &Asking, at: [usize; 2]) -> Result<Account> {
    let names = Names::new(&stage.scene, asking.attributes);
    let wanted = asking.feature.map(|feature| Wanted::find(feature, &names, &stage.draw_list)).transpose()?;
    let techniques = Prepare::new(stage, asking.kinds)?;
    let mesh = &*stage.mesh_for(view);
    let corner = |more: f64| Screen::new(at[0] as f64 + more, at[1] as f64 + more);
    let footprints = footprints_seen(&stage.draw_list, (mesh, view), [corner(-1.0), corner(2.0)]);
    let budget = Budget { coverage: true, ..asking.budget };
    let bench = Bench::new((stage, view, mesh), (&footprints, &names), budget);
    let nears = bench.look(&[at]);
    let near = nears.first().ok_or_else(|| Error::internal("a pixel was not looked at"))?;
    let mut account = account(&bench, near);
    for (kind, prepared) in &techniques.prepared {
        let explained = technique::explain(prepared.as_ref(), view, at)?;
        account.techniques.push(told(&bench, near, &account.truth, *kind, &explained));
    }
    if asking.close_up > 0 {
        account.close_up = Some(close_up(&bench, near, asking.close_up));
    }
    account.left_out = techniques.left_out;
    name_items(&bench, &mut account);
    account.feature = wanted.map(|wanted| presence(&bench, near, &wanted, &account));
    Ok(account)
}

/// Names all items that an account speaks of.
pub(super) fn name_items(bench: &Bench, account: &mut Account) {
    let shapes = account.scenery.shapes.iter().map(|shape| shape.item);
    let steps =
        account.techniques.iter().flat_map(|by| &by.steps).flat_map(|step| step.items.iter().copied());
    let covering = account.covering.iter().map(|covering| covering.item);
    account.items = shapes.chain(steps).chain(covering).map(|item| (item, bench.name_of(item))).collect();
}

/// What is to be told of a pixel, whatever techniques do.
pub(super) fn account(bench: &Bench, near: &Near) -> Account {
    let [x, y] = near.pixel;
    let middle = Screen::new(x as f64 + 0.5, y as f64 + 0.5);
    let look = &near.look;
    let seen = look.centre.and_then(|centre| bench.on_triangle(centre.triangle, middle));
    let coverage = look.coverage.items.iter().filter(|item| item.high > 0.0);
    Account {
        pixel: near.pixel,
        ray: ray(bench, middle),
        centre: seen.as_ref().map(|seen| centre(bench, near, seen)),
        scenery: Scenery::of(bench, near),
        items: BTreeMap::new(),
        covering: coverage
            .map(|covering| Covering {
                item: covering.item,
                name: bench.name_of(covering.item),
                color: bench.backdrop.compositor.encoded(bench.paint_of(covering.item)),
                low: covering.low,
                high: covering.high,
            })
            .collect(),
        others: look.coverage.others,
        truth: Right { low: look.low, high: look.high, estimate: look.estimate },
        ladder: ladder(bench, near, seen.as_ref()),
        techniques: Vec::new(),
        left_out: Vec::new(),
        close_up: None,
        feature: None,
    }
}

fn ray(bench: &Bench, at: Screen) -> Ray {
    let ray = bench.view.ray(at);
    let direction = (ray.through - ray.from).normalize_or_zero();
    Ray { from: bench.absolute_world(ray.from), direction: direction.to_array() }
}

fn centre(bench: &Bench, near: &Near, seen: &Seen) -> Centre {
    let mut margins = margins(bench, seen);
    margins.truncate(MOST_MARGINS);
    Centre {
        triangle: seen.triangle,
        plan: bench.absolute(seen.hit.plan),
        world: bench.absolute_world(seen.hit.world),
        depth: seen.hit.depth,
        pixel: bench.reach(seen).map(|reach| [reach.dx.to_array(), reach.dy.to_array()]),
        margins,
        silhouette: silhouette(near, seen),
    }
}
