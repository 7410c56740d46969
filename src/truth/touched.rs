//! Which items touch each pixel, by the truth's own coverage, and which hold its centre.

use super::{Budget, Centre, PixelCoverage, certify};
use crate::buffer::{Buffer, Touches};
use crate::footprint::{Footprints, PixelSize};
use crate::holding::Nearby;
use crate::parallel;
use crate::space::ViewFrame;
use crate::stage::Stage;

/// What may cover no more than this share of a pixel does not count as touching it: what the bounds of doubles leave open is far less.
const LEAST: f64 = 1e-6;

/// The items of a view's pixels.
#[derive(Debug)]
pub struct Touched {
    /// Those that touch each pixel, and among them those that hold its centre.
    pub touches: Touches,
    /// What each item covers of each pixel.
    pub coverage: Buffer<PixelCoverage>,
}

impl Touched {
    /// Finds them: all that may cover more than a millionth of the pixel, whatever lies over it. At the centre borders that are not straight are decided in plain doubles.
    /// `progress` is told the share that is done (0..=1), from any thread.
    pub fn of(stage: &Stage, view: &ViewFrame, budget: &Budget, progress: &(dyn Fn(f64) + Sync)) -> Self {
        let truth = certify(stage, view, &Budget { coverage: true, ..*budget }, progress);
        let (width, height) = (view.width(), view.height());
        let mesh = &*stage.mesh_for(view);
        let bounds = mesh.plan_bounds();
        let size = PixelSize::of(view, mesh);
        let footprints = Footprints::new(&stage.draw_list, size, &|plan| plan.meets(&bounds));
        let none = || Buffer::from_values(width, height, vec![PixelCoverage::default(); width * height]);
        let coverage = truth.coverage.unwrap_or_else(none);
        let rows = parallel::map_indices(height, |y| {
            let (mut row, mut nearby) = (Touches::new(width, true), Nearby::default());
            for x in 0..width {
                let items = coverage.at(x, y).items.iter().filter(|item| item.high > LEAST);
                items.for_each(|entry| row.push([x, y], entry.item, false));
                if let Some(centre) = truth.centres.at(x, y) {
                    at_centre(&footprints, (view, centre), &mut nearby, &mut |item| {
                        row.push([x, y], item, true)
                    });
                }
            }
            row
        });
        let mut touches = Touches::new(width, true);
        rows.into_iter().for_each(|row| touches.take(row));
        Self { touches, coverage }
    }
}

/// Calls `visit` with the items that hold what a pixel's centre sees.
fn at_centre(
    footprints: &Footprints,
    (view, centre): (&ViewFrame, &Centre),
    nearby: &mut Nearby,
    visit: &mut dyn FnMut(u32),
) {
    nearby.find_all(footprints, centre.plan);
    let from_eye = || (centre.world - view.eye()).length();
    let holding =
        nearby.items().iter().filter(|item| nearby.holds(footprints, item, (centre.plan, &from_eye)));
    holding.for_each(|item| visit(item.number));
}
