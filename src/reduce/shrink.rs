//! What is left out, in which order.

use super::draft::Draft;
use super::fewest::fewest;
use super::settings::plainer;
use super::{crop, vertices};
use crate::error::Result;
use std::collections::BTreeMap;

/// How a draft fails.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Failing {
    /// How many pixels are wrong.
    pub pixels: usize,
    /// The middle of where most of them are: column, row.
    pub at: [usize; 2],
}

/// What came out.
#[derive(Debug, Clone)]
pub struct Reduced {
    /// The smallest draft that still fails.
    pub draft: Draft,
    /// How it fails.
    pub failing: Failing,
    /// How many drafts were tried.
    pub tries: usize,
}

/// Pictures no larger than this a side are small enough, pixels.
const SMALL: usize = 32;

/// Rounds in which everything is tried once more.
const ROUNDS: usize = 3;

/// Tells how a draft fails; `None`: it does not, or cannot be told.
type Fails<'a> = dyn FnMut(&Draft) -> Result<Option<Failing>> + 'a;

/// Makes a draft smaller that fails as `failing` tells, in so many tries at most.
///
/// # Errors
/// What `fails` has as an error: nobody can go on.
pub fn reduce(draft: Draft, failing: Failing, most: usize, fails: &mut Fails) -> Result<Reduced> {
    let mut search =
        Search { best: Reduced { draft, failing, tries: 0 }, most, fails, known: BTreeMap::new() };
    for _ in 0..ROUNDS {
        let before = search.best.draft.clone();
        search.fewer_features()?;
        if search.smaller_picture()? {
            search.fewer_features()?;
        }
        search.fewer_vertices()?;
        search.plainer()?;
        if search.best.draft == before {
            break;
        }
    }
    search.whole_metres()?;
    Ok(search.best)
}

struct Search<'a, 'f> {
    best: Reduced,
    most: usize,
    fails: &'a mut Fails<'f>,
    /// Scenes that were tried, and how they fail.
    known: BTreeMap<String, Option<Failing>>,
}

impl Search<'_, '_> {
    /// Whether a draft still fails; then it is the best so far.
    fn holds(&mut self, draft: Draft) -> Result<bool> {
        let text = draft.text();
        let failing = match self.known.get(&text) {
            Some(known) => *known,
            None if self.best.tries >= self.most => None,
            None => {
                self.best.tries += 1;
                let failing = (self.fails)(&draft)?;
                self.known.insert(text, failing);
                failing
            }
        };
        if let Some(failing) = failing {
            (self.best.draft, self.best.failing) = (draft, failing);
        }
        Ok(failing.is_some())
    }

    fn fewer_features(&mut self) -> Result<()> {
        let whole = self.best.draft.clone();
        let all = whole.layers.iter().enumerate();
        let all: Vec<(usize, usize)> =
            all.flat_map(|(k, layer)| (0..layer.features.len()).map(move |l| (k, l))).collect();
        fewest(all, &mut |kept| {
            let mut draft = whole.clone();
            for layer in &mut draft.layers {
                layer.features.clear();
            }
            for (k, l) in kept {
                draft.layers[*k].features.push(whole.layers[*k].features[*l].clone());
            }
            draft.layers.retain(|layer| !layer.features.is_empty());
            self.holds(draft)
        })?;
        Ok(())
    }

    /// Whether there is a smaller picture that fails.
    fn smaller_picture(&mut self) -> Result<bool> {
        let mut is_smaller = false;
        for side in [SMALL, 2 * SMALL, 4 * SMALL] {
            let at = self.best.failing.at;
            if let Some(smaller) = crop::cropped(&self.best.draft, at, side)?
                && self.holds(smaller)?
            {
                is_smaller = true;
                break;
            }
        }
        while self.best.draft.image.width.max(self.best.draft.image.height) > SMALL {
            let coarser = crop::coarser(&self.best.draft);
            if !self.holds(coarser)? {
                break;
            }
            is_smaller = true;
        }
        Ok(is_smaller)
    }

    fn fewer_vertices(&mut self) -> Result<()> {
        let layers = 0..self.best.draft.layers.len();
        let places: Vec<(usize, usize)> =
            layers.flat_map(|k| (0..self.best.draft.layers[k].features.len()).map(move |l| (k, l))).collect();
        for (k, l) in places {
            let whole = self.best.draft.clone();
            let shape = &whole.layers[k].features[l];
            fewest((0..shape.parts().count()).collect(), &mut |parts: &[usize]| {
                let places = vertices::places(shape).into_iter().filter(|(part, _)| parts.contains(part));
                self.holds_with(&whole, (k, l), &places.collect::<Vec<_>>())
            })?;
            let whole = self.best.draft.clone();
            let shape = &whole.layers[k].features[l];
            fewest(vertices::places(shape), &mut |kept| self.holds_with(&whole, (k, l), kept))?;
        }
        Ok(())
    }

    /// Whether a draft still fails with some vertices of a feature.
    fn holds_with(
        &mut self,
        whole: &Draft,
        (k, l): (usize, usize),
        kept: &[vertices::Place],
    ) -> Result<bool> {
        let Some(fewer) = vertices::with(&whole.layers[k].features[l], kept) else { return Ok(false) };
        let mut draft = whole.clone();
        draft.layers[k].features[l] = fewer;
        self.holds(draft)
    }

    fn plainer(&mut self) -> Result<()> {
        loop {
            let mut is_plainer = false;
            for draft in plainer(&self.best.draft) {
                // Those that were made of a draft that is the best no more are for the next round.
                if self.holds(draft)? {
                    is_plainer = true;
                    break;
                }
            }
            if !is_plainer {
                return Ok(());
            }
        }
    }

    fn whole_metres(&mut self) -> Result<()> {
        for k in 0..self.best.draft.layers.len() {
            for l in 0..self.best.draft.layers[k].features.len() {
                let mut draft = self.best.draft.clone();
                if let Some(whole) = vertices::in_whole_metres(&draft.layers[k].features[l]) {
                    draft.layers[k].features[l] = whole;
                    self.holds(draft)?;
                }
            }
        }
        Ok(())
    }
}
