//! What a pixel may be, from what its samples may see.

use super::composition::Composed;
use crate::certainty::{Known, PaintMean, PaintRange};
use crate::draw_list::DrawList;
use crate::math;
use crate::resolve::Compositor;
use crate::truth::{Outcome, Sample};

/// Colours between two, straight alpha, encoded, 0..=1.
pub(super) type ColorRange = [[f64; 4]; 2];

/// What a pixel may be.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct PixelRange {
    /// Around all.
    pub(super) all: ColorRange,
    /// It is within one of these; none: anywhere within `all`.
    pub(super) choices: Vec<ColorRange>,
    /// With all open answers out, and with all in.
    pub(super) extremes: Option<[[f64; 4]; 2]>,
    /// The items that have a say.
    pub(super) items: Vec<u32>,
}

/// A pixel of so many combinations of its samples' outcomes has no list of them.
const MOST_CHOICES: usize = 8;

/// A rounding to code values: half of one, and a hair for arithmetic in single precision.
pub(super) const BLEND: f64 = 0.51 / 255.0;

/// Where colours are composed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Blending {
    /// In a shader: they are rounded once, when they are written.
    Shader,
    /// In a target of code values: they are rounded at each blend.
    Target,
    /// The same by a machine that rounds colours and opacities to code values before it multiplies them, too.
    CoarseTarget,
}

impl PixelRange {
    /// One place, of which all paints are known, or too many to be told; each is off by `slack` at most.
    pub(super) fn of_composed(of: &Composed, items: Vec<u32>, slack: f64, compositor: &Compositor) -> Self {
        let colors = |paint: &PaintRange| {
            let mut mean = PaintMean::NOTHING;
            mean.add(paint, 1.0);
            let [low, high, _] = mean.colors(compositor, 1e-12);
            [low, high]
        };
        let each: Vec<ColorRange> = of.each.iter().map(colors).collect();
        let extremes = match &each[..] {
            [first, .., last] => Some([first[0], last[0]]),
            _ => None,
        };
        let is_open = each.len() > 1;
        let choices = each.into_iter().filter(|_| is_open).map(|color| widened(color, slack)).collect();
        Self { all: widened(colors(&of.range), slack), choices, extremes, items }
    }

    /// The mean of samples.
    pub(super) fn of_samples(
        samples: &[Sample],
        (list, compositor): (&DrawList, &Compositor),
        blending: Blending,
    ) -> Self {
        let slack = match blending {
            Blending::Shader => BLEND,
            Blending::Target => BLEND * roundings(samples, list, 1.0),
            // The source's colour and its opacity are rounded before they are multiplied.
            Blending::CoarseTarget => BLEND * roundings(samples, list, 3.0),
        };
        Self::of_means(samples, compositor, slack)
    }

    /// The mean of samples, with what rounding may do to each channel.
    pub(super) fn of_means(samples: &[Sample], compositor: &Compositor, slack: f64) -> Self {
        let share = 1.0 / samples.len() as f64;
        let color = |paints: &mut dyn Iterator<Item = PaintRange>| {
            let mut mean = PaintMean::NOTHING;
            paints.for_each(|paint| mean.add(&paint, share));
            let [low, high, _] = mean.colors(compositor, 1e-12);
            [low, high]
        };
        let mut range = Self {
            all: widened(color(&mut samples.iter().map(Sample::paint)), slack),
            items: items_of(samples),
            ..Self::default()
        };
        let mixtures = mixtures(samples);
        if mixtures.len() > 1 {
            for mixture in mixtures {
                let choice = widened(color(&mut mixture.into_iter()), slack);
                if !range.choices.contains(&choice) {
                    range.choices.push(choice);
                }
            }
        }
        let ends: Option<Vec<_>> = samples.iter().map(ends_of).collect();
        if let Some(ends) = ends.filter(|ends| ends.iter().any(|[least, most]| least != most)) {
            let at = |end: usize| color(&mut ends.iter().map(|of| of[end]))[0];
            range.extremes = Some([at(0), at(1)]);
        }
        range
    }

    /// Any of some, at least one.
    pub(super) fn any_of(mut ranges: Vec<Self>) -> Self {
        if ranges.len() == 1 {
            return ranges.swap_remove(0);
        }
        let mut any = Self { all: [[1.0; 4], [0.0; 4]], ..Self::default() };
        for range in ranges {
            for c in 0..4 {
                any.all[0][c] = math::min(range.all[0][c], any.all[0][c]);
                any.all[1][c] = math::max(range.all[1][c], any.all[1][c]);
            }
            let own = if range.choices.is_empty() { vec![range.all] } else { range.choices };
            own.into_iter().for_each(|choice| {
                if !any.choices.contains(&choice) {
                    any.choices.push(choice);
                }
            });
            any.items.extend(range.items);
        }
        if any.choices.len() > MOST_CHOICES || any.choices.len() == 1 {
            any.choices.clear();
        }
        any.items.sort_unstable();
        any.items.dedup();
        any
    }
}

/// How many roundings a sample's colour is off by at most: its ground is rounded, each blend rounds so often, and less shows through of what
/// lies below; the mean of several samples is rounded, too.
fn roundings(samples: &[Sample], list: &DrawList, of_a_blend: f64) -> f64 {
    // Of items that were not told apart.
    const MOST_BLENDS: f64 = 4.0;
    let of_outcome = |outcome: &Outcome| {
        let Some(items) = &outcome.items else { return MOST_BLENDS * of_a_blend };
        let mut off = 1.0;
        for (item, known) in items {
            let style = list.style_of(*item);
            let alpha = style.paint.0[3];
            let blended = if alpha < 1.0 { off * (1.0 - alpha) + of_a_blend } else { 1.0 };
            off = if *known == Known::Open { math::max(off, blended) } else { blended };
            // A layer that is composed as a whole is one more blend.
            off += if style.group.is_some() { of_a_blend + 1.0 } else { 0.0 };
        }
        off
    };
    let most = samples.iter().flat_map(|sample| &sample.outcomes).map(of_outcome).fold(1.0, math::max);
    most + f64::from(u8::from(samples.len() > 1))
}

pub(super) fn widened([low, high]: ColorRange, slack: f64) -> ColorRange {
    [low.map(|v| v - slack), high.map(|v| v + slack)]
}

fn items_of(samples: &[Sample]) -> Vec<u32> {
    let outcomes = samples.iter().flat_map(|sample| &sample.outcomes);
    let mut items: Vec<u32> =
        outcomes.flat_map(|o| o.items.iter().flatten().map(|(item, _)| *item)).collect();
    items.sort_unstable();
    items.dedup();
    items
}

/// The different combinations of what samples' paints may be, whichever of alike samples has which; none where there are too many.
fn mixtures(samples: &[Sample]) -> Vec<Vec<PaintRange>> {
    let mut kinds: Vec<(Vec<PaintRange>, usize)> = Vec::new();
    for paints in samples.iter().map(different_paints) {
        match kinds.iter_mut().find(|(known, _)| *known == paints) {
            Some((_, count)) => *count += 1,
            None => kinds.push((paints, 1)),
        }
    }
    let mut all: Vec<Vec<PaintRange>> = vec![Vec::new()];
    for (paints, count) in kinds {
        let shares = shares(&paints, count);
        if all.len() * shares.len() > MOST_CHOICES {
            return Vec::new();
        }
        let joined = |of: &Vec<PaintRange>| {
            shares.iter().map(|share| [&of[..], &share[..]].concat()).collect::<Vec<_>>()
        };
        all = all.iter().flat_map(joined).collect();
    }
    all
}

/// The ways in which so many samples may share some paints, order aside; more than are listed where there are too many.
fn shares(paints: &[PaintRange], count: usize) -> Vec<Vec<PaintRange>> {
    let [first, rest @ ..] = paints else { return Vec::new() };
    if rest.is_empty() || count == 0 {
        return vec![vec![*first; count]];
    }
    let mut all = Vec::new();
    for of_first in (0..=count).rev() {
        for share in shares(rest, count - of_first) {
            all.push([vec![*first; of_first], share].concat());
            if all.len() > MOST_CHOICES {
                return all;
            }
        }
    }
    all
}

fn different_paints(sample: &Sample) -> Vec<PaintRange> {
    let mut paints: Vec<PaintRange> = Vec::new();
    for outcome in &sample.outcomes {
        if !paints.contains(&outcome.paint) {
            paints.push(outcome.paint);
        }
    }
    paints
}

/// The paints of a sample in the fewest items and in the most; `None` where its outcomes are not a question of more or fewer.
fn ends_of(sample: &Sample) -> Option<[PaintRange; 2]> {
    let count = |outcome: &Outcome| outcome.items.as_ref().map(Vec::len);
    let mut ends = [sample.outcomes.first()?; 2];
    for outcome in &sample.outcomes {
        if outcome.paint.width() > 0.0
            || outcome.triangle == crate::terrain::SKY && ends[0].triangle != outcome.triangle
        {
            return None;
        }
        let held = count(outcome)?;
        if held < count(ends[0])? {
            ends[0] = outcome;
        }
        if held > count(ends[1])? {
            ends[1] = outcome;
        }
    }
    Some(ends.map(|outcome| outcome.paint))
}
