//! Dashes of strokes.

use crate::math::{max, min};

/// Which parts of a stroke are drawn: lengths along it in metres of the plan, in turn drawn and left out, over and over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dash {
    lengths: [f64; Dash::MOST],
    count: usize,
    offset: f64,
}

impl Dash {
    /// The most lengths.
    pub const MOST: usize = 16;

    /// No length is as short, metres: far above what two vertices must be apart.
    pub const SHORTEST: f64 = 1e-6;

    /// No length is as long, metres.
    pub const LONGEST: f64 = 1e12;

    /// The lengths of a pattern, and how far into it a stroke begins; `None` unless there is an even count of lengths, [`Self::MOST`] at most, all
    /// between the shortest and the longest, and the offset is finite.
    pub fn new(lengths: &[f64], offset: f64) -> Option<Self> {
        let is_pattern =
            !lengths.is_empty() && lengths.len().is_multiple_of(2) && lengths.len() <= Self::MOST;
        let is_length = |length: &f64| Self::SHORTEST < *length && *length < Self::LONGEST;
        if !is_pattern || !lengths.iter().all(is_length) || !offset.is_finite() {
            return None;
        }
        let mut all = [0.0; Self::MOST];
        all[..lengths.len()].copy_from_slice(lengths);
        Some(Self { lengths: all, count: lengths.len(), offset })
    }

    /// What is drawn, what is left out, and so on.
    pub fn lengths(&self) -> &[f64] {
        &self.lengths[..self.count]
    }

    /// How far into the pattern a stroke begins, metres.
    pub fn offset(&self) -> f64 {
        self.offset
    }

    /// The length after which it repeats itself.
    pub fn period(&self) -> f64 {
        self.lengths().iter().sum()
    }
}

/// How far it is along a path: in the plan, or over the ground.
pub trait Measure {
    /// What a path leads through.
    type Place: Copy;

    /// What is no longer is no dash, metres.
    const SHORTEST: f64;

    /// The length of a segment, metres.
    fn length(&self, from: Self::Place, to: Self::Place) -> f64;

    /// The place so far along a segment of a length, metres.
    fn place(&self, segment: [Self::Place; 2], length: f64, at: f64) -> Self::Place;

    /// Whether two consecutive places are one.
    fn is_same(&self, one: Self::Place, other: Self::Place) -> bool;

    /// A place after the beginning of a path that ends where it begins, as one after its end.
    fn after_the_end(&self, place: Self::Place, begin: Self::Place, end: Self::Place) -> Self::Place;
}

/// What is drawn of a path.
#[derive(Debug, Clone, PartialEq)]
pub enum Dashed<P> {
    /// All of it.
    Whole,
    /// These, each at least two distinct places.
    Parts(Vec<Vec<P>>),
}

/// A dash from one length along a path to another.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Stretch {
    from: f64,
    to: f64,
}

impl Dash {
    /// The dashes along a path of at least one place. Those of a closed one, which ends where it begins, that meet at its first place are one. A dash of no more
    /// than the distance of places that are the same is none.
    pub fn along<M: Measure>(&self, path: &[M::Place], is_closed: bool, measure: &M) -> Dashed<M::Place> {
        let path = Path { measure, places: path, along: lengths_along(path, measure) };
        let length = path.along[path.along.len() - 1];
        if length == 0.0 {
            return Dashed::Whole;
        }
        let mut stretches = self.stretches(length, M::SHORTEST);
        let joins = |stretches: &[Stretch]| {
            is_closed
                && stretches.first().is_some_and(|of| of.from <= 0.0)
                && stretches.last().is_some_and(|of| of.to >= length)
        };
        if let [only] = &stretches[..]
            && only.from <= 0.0
            && only.to >= length
        {
            return Dashed::Whole;
        }
        let over_the_start = if stretches.len() > 1 && joins(&stretches) { stretches.pop() } else { None };
        let mut parts: Vec<Vec<M::Place>> = stretches.iter().map(|of| path.part(of)).collect();
        if let (Some(last), Some(first)) = (over_the_start, parts.first_mut()) {
            let mut whole = path.part(&last);
            let (begin, end) = (path.places[0], path.places[path.places.len() - 1]);
            first.drain(1..).for_each(|p| path.push(&mut whole, measure.after_the_end(p, begin, end)));
            *first = whole;
        }
        parts.retain(|part| part.len() > 1);
        Dashed::Parts(parts)
    }

    /// The dashes of a path of a length that are longer than `shortest`, in their order, ends not cut off.
    fn stretches(&self, length: f64, shortest: f64) -> Vec<Stretch> {
        let period = self.period();
        let into = self.offset().rem_euclid(period);
        let mut found = Vec::new();
        for turn in 0_u32.. {
            let mut at = f64::from(turn) * period - into;
            if at >= length {
                break;
            }
            for lengths in self.lengths().chunks(2) {
                let stretch = Stretch { from: at, to: at + lengths[0] };
                if min(stretch.to, length) - max(stretch.from, 0.0) > shortest {
                    found.push(stretch);
                }
                at = stretch.to + lengths[1];
            }
        }
        found
    }
}

/// Of each place how far along a path it lies.
fn lengths_along<M: Measure>(path: &[M::Place], measure: &M) -> Vec<f64> {
    let mut along = 0.0;
    let steps = path.windows(2).map(|ends| {
        along += measure.length(ends[0], ends[1]);
        along
    });
    std::iter::once(0.0).chain(steps).collect()
}

/// A path, and of each of its places how far along it lies.
struct Path<'a, M: Measure> {
    measure: &'a M,
    places: &'a [M::Place],
    along: Vec<f64>,
}

impl<M: Measure> Path<'_, M> {
    /// The places of a stretch.
    fn part(&self, of: &Stretch) -> Vec<M::Place> {
        let mut part = vec![self.place(of.from)];
        let first = self.along.partition_point(|at| *at <= of.from);
        let end = self.along.partition_point(|at| *at < of.to);
        self.places[first..end.max(first)].iter().for_each(|p| self.push(&mut part, *p));
        self.push(&mut part, self.place(of.to));
        part
    }

    /// Adds a place; one that is the same as that before it stands in its place, but never in that of the first.
    fn push(&self, part: &mut Vec<M::Place>, p: M::Place) {
        let is_same = |last: &M::Place| self.measure.is_same(p, *last);
        while part.len() > 1 && part.last().is_some_and(is_same) {
            part.pop();
        }
        if !part.last().is_some_and(is_same) {
            part.push(p);
        }
    }

    /// The place at a length along the path; its ends beyond them.
    fn place(&self, at: f64) -> M::Place {
        let to = self.along.partition_point(|end| *end <= at);
        if to == 0 {
            return self.places[0];
        }
        let Some(end) = self.places.get(to) else { return self.places[self.places.len() - 1] };
        let start = self.along[to - 1];
        self.measure.place([self.places[to - 1], *end], self.along[to] - start, at - start)
    }
}
