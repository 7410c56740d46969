//! Which pixels the features of a scene touch.

use super::Watch;
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::truth::{Budget, PixelCoverage, certify};

/// How well coverages need to be known: items are cut along their borders, so that what they cover is found long before.
const ENOUGH: Budget = Budget { width: 0.05, depth: 8, coverage: true };

/// A pixel of which more than this is too crowded to tell what covers it is touched.
const CROWDED: f64 = 1e-3;

/// For each pixel of a view, rows from the top, whether an item surely covers a part of what it sees.
pub fn touched(stage: &Stage, view: &ViewFrame, watch: &dyn Watch) -> Vec<bool> {
    if stage.draw_list.items().is_empty() {
        return vec![false; view.width() * view.height()];
    }
    watch.start("where features are");
    let truth = certify(stage, view, &ENOUGH, &|share| watch.done(share));
    let is_touched =
        |pixel: &PixelCoverage| pixel.others > CROWDED || pixel.items.iter().any(|item| item.low > 0.0);
    truth.coverage.iter().flat_map(|pixels| pixels.values()).map(is_touched).collect()
}
