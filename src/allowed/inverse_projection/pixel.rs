//! What a pixel may be: its quadrilaterals (She 3.2), its classes (3.3), the means of its samples (3.4).

use super::judgment::{Held, Judge, Last};
use super::outlines::{Area, Part};
use super::place::Place;
use super::sight::{Eye, Sight, Spread};
use crate::allowed::pixel::PixelRange;
use crate::certainty::{Known, PaintRange};
use crate::draw_list::Side;
use crate::math;
use crate::resolve::{Compositor, Paint, Stack};
use crate::scene::BlendMode;
use crate::space::{PlanBox, Screen};
use crate::technique::inverse_projection::{Settings, Silhouette};
use crate::terrain::SKY;
use crate::truth::{Outcome, Sample};

/// What pixels of a picture are made from.
pub(super) struct Painter<'a> {
    pub(super) eye: Eye<'a>,
    pub(super) judge: Judge<'a>,
    pub(super) settings: &'a Settings,
    pub(super) compositor: Compositor,
    pub(super) mode: BlendMode,
    pub(super) sky: Paint,
    /// The paint of each style of items.
    pub(super) paints: Vec<Paint>,
}

/// What a pixel's rays may end in.
pub(super) struct Rays<'a> {
    pub(super) centre: &'a Sight,
    /// Self, right, upper right, upper; the first is the centre's own where corners are centres.
    pub(super) corners: [&'a Sight; 4],
    /// Where they are on the screen.
    pub(super) places: [Screen; 4],
    pub(super) is_centre_a_corner: bool,
}

/// What a pixel may be.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Judged {
    pub(super) range: PixelRange,
    /// Whether it may be N, P, F.
    pub(super) classes: [bool; 3],
    /// The least and the greatest coordinates of its quadrilateral.
    pub(super) quad: [[f64; 8]; 2],
    /// How many edges meet it, at least and at most.
    pub(super) edges: [usize; 2],
}

/// Of more combinations of what its corners see a pixel is judged by the hulls of each.
const MOST_COMBINATIONS: usize = 16;

/// A sample with so many open answers is told all combinations of them; one with more has a range of paints.
const MOST_OPEN: usize = 3;

/// How blends of 8-bit targets are rounded: half a code value each.
const BLEND: f64 = 0.5 / 255.0;

/// What has been found of a pixel.
struct Findings<'p> {
    painter: &'p Painter<'p>,
    last: &'p mut Last,
    ranges: Vec<PixelRange>,
    classes: [bool; 3],
    quad: [[f64; 8]; 2],
    edges: [usize; 2],
}

const N: usize = 0;
const P: usize = 1;
const F: usize = 2;

impl Painter<'_> {
    /// What a pixel may be; `last` is what is known of the one before.
    pub(super) fn judged(&self, rays: &Rays, last: &mut Last) -> Judged {
        let mut findings = Findings {
            painter: self,
            last,
            ranges: Vec::new(),
            classes: [false; 3],
            quad: [[f64::INFINITY; 8], [f64::NEG_INFINITY; 8]],
            edges: [usize::MAX, 0],
        };
        if rays.centre.is_sky {
            findings.add_sky();
        }
        let counts = rays.corners.map(Sight::count);
        let combinations: usize = counts.iter().product();
        if combinations <= MOST_COMBINATIONS {
            findings.add_all(rays);
        } else {
            let (centre, corners) = (rays.centre.joined(), rays.corners.map(Sight::joined));
            findings.add_all(&Rays { centre: &centre, corners: corners.each_ref(), ..*rays });
        }
        let Findings { ranges, classes, quad, edges, .. } = findings;
        Judged { range: PixelRange::any_of(ranges), classes, quad, edges }
    }
}

impl Findings<'_> {
    fn add_sky(&mut self) {
        let paint = PaintRange::exact(self.painter.sky);
        let sky = Outcome {
            triangle: SKY,
            paint,
            ground: paint,
            items: Some(Vec::new()),
            plan: PlanBox::EMPTY,
            depth: (f64::INFINITY, f64::INFINITY),
        };
        self.add_samples(&[Sample { outcomes: vec![sky] }], false);
        self.classes[N] = true;
        self.include([[f64::INFINITY; 2]; 8]);
        self.edges[0] = 0;
    }

    /// Each combination of what centre and corners may see.
    fn add_all(&mut self, rays: &Rays) {
        for (k, centre) in rays.centre.spreads.iter().enumerate() {
            let holding = self.painter.judge.holding(&centre.place, self.last);
            let mut is_refused = Known::Out;
            let mut is_first = true;
            let mut add = |found: Known| {
                is_refused = if is_first || is_refused == found { found } else { Known::Open };
                is_first = false;
            };
            let seen = rays.corners;
            let of = |corner: usize| match (corner, rays.is_centre_a_corner) {
                (0, true) => &rays.centre.spreads[k..=k],
                _ => &seen[corner].spreads[..],
            };
            if (usize::from(rays.is_centre_a_corner)..4).any(|corner| seen[corner].is_sky) {
                add(Known::In);
            }
            for a in of(0) {
                for b in of(1) {
                    for c in of(2) {
                        for d in of(3) {
                            let corners = [a, b, c, d];
                            let spans = self.spans_silhouette(corners, &rays.places);
                            add(spans);
                            if spans != Known::In {
                                self.add_quad((centre, &holding), corners);
                            }
                        }
                    }
                }
            }
            if is_refused != Known::Out {
                self.add_refused(centre, &holding);
            }
        }
    }

    fn spans_silhouette(&self, corners: [&Spread; 4], places: &[Screen; 4]) -> Known {
        if self.painter.settings.silhouette == Silhouette::Smear {
            return Known::Out;
        }
        let side = |k: usize| {
            let other = (k + 1) % 4;
            self.painter.eye.silhouette([(corners[k], places[k]), (corners[other], places[other])])
        };
        (0..4).fold(Known::Out, |any, k| any.or(side(k)))
    }

    /// One sample at the centre.
    fn add_refused(&mut self, centre: &Spread, holding: &[(Area, Known)]) {
        let states: Vec<(Area, Vec<Known>)> = holding.iter().map(|(area, k)| (*area, vec![*k])).collect();
        self.add_whole_classes(holding);
        self.add_held(centre, &states, 1);
        let bounds = self.painter.bounds(&centre.place);
        self.include([0, 1, 2, 3].map(|_| axes(&bounds)).concat().try_into().unwrap_or_default());
        self.edges[0] = 0;
    }

    /// A quadrilateral, of which edges may be part.
    fn add_quad(&mut self, (centre, holding): (&Spread, &[(Area, Known)]), corners: [&Spread; 4]) {
        let samples = self.painter.settings.samples;
        let quad = corners.map(|spread| &spread.place);
        let Held { is_partly, edges, areas } = self.painter.judge.held(quad, samples, holding);
        if is_partly != Known::Out {
            self.classes[P] = true;
        }
        if is_partly != Known::In {
            self.add_whole_classes(holding);
        }
        match is_partly {
            Known::Out => {
                let whole: Vec<_> = holding.iter().map(|(area, k)| (*area, vec![*k])).collect();
                self.add_held(centre, &whole, 1);
            }
            _ => self.add_held(centre, &areas, (samples * samples) as usize),
        }
        let bounds = quad.map(|place| axes(&self.painter.bounds(place)));
        self.include(bounds.concat().try_into().unwrap_or_default());
        self.edges = [self.edges[0].min(edges[0]), self.edges[1].max(edges[1])];
    }

    /// The classes of a pixel without an edge whose centre lies so.
    fn add_whole_classes(&mut self, holding: &[(Area, Known)]) {
        let painted = holding.iter().filter(|(area, _)| self.painter.judge.outlines.is_painted(*area));
        let is_covered = painted.fold(Known::Out, |any, (_, known)| any.or(*known));
        self.classes[N] |= is_covered != Known::In;
        self.classes[F] |= is_covered != Known::Out;
    }

    fn include(&mut self, values: [[f64; 2]; 8]) {
        for (k, [low, high]) in values.into_iter().enumerate() {
            self.quad[0][k] = math::min(low, self.quad[0][k]);
            self.quad[1][k] = math::max(high, self.quad[1][k]);
        }
    }

    /// The mean of samples that areas hold so, over each paint that the ground may have.
    fn add_held(&mut self, centre: &Spread, areas: &[(Area, Vec<Known>)], count: usize) {
        let items = items_of(self.painter, areas, count);
        let triangle = 0;
        for ground in &centre.paints {
            let samples: Vec<Sample> = (0..count)
                .map(|k| {
                    let held: Vec<(u32, Known)> = items.iter().map(|(item, of)| (*item, of[k])).collect();
                    self.painter.sample(*ground, triangle, &held)
                })
                .collect();
            self.add_samples(&samples, !items.is_empty());
        }
    }

    fn add_samples(&mut self, samples: &[Sample], is_painted: bool) {
        // The ground, and what is drawn over it.
        let slack = BLEND * if is_painted { 2.0 } else { 1.0 };
        let range = PixelRange::of_means(samples, &self.painter.compositor, slack);
        if !self.ranges.contains(&range) {
            self.ranges.push(range);
        }
    }
}

fn axes(plan: &PlanBox) -> [[f64; 2]; 2] {
    [[plan.min.x, plan.max.x], [plan.min.y, plan.max.y]]
}

/// Whether each item holds each sample; those that hold none are left out.
fn items_of(painter: &Painter, areas: &[(Area, Vec<Known>)], count: usize) -> Vec<(u32, Vec<Known>)> {
    let list = painter.judge.outlines.list;
    let out = vec![Known::Out; count];
    let state = |item: u32, part: Part| {
        let found = areas.binary_search_by_key(&Area { item, part }, |(area, _)| *area);
        found.map_or(&out, |at| &areas[at].1)
    };
    let mut items = Vec::new();
    for (area, states) in areas.iter().filter(|(area, _)| painter.judge.outlines.is_painted(*area)) {
        let style = list.style_of(area.item);
        let mut held = states.clone();
        if let (Part::Stroke, Some(side)) = (area.part, style.cut) {
            let polygon = state(list.area_owner(area.item), Part::Polygon);
            for (held, inside) in held.iter_mut().zip(polygon) {
                *held = held.and(if side == Side::Inside { *inside } else { !*inside });
            }
        }
        if held.iter().any(|known| *known != Known::Out) {
            items.push((area.item, held));
        }
    }
    items
}

impl Painter<'_> {
    /// A box around a place, with what rounding may do.
    fn bounds(&self, place: &Place) -> PlanBox {
        place.bounds().grown(self.judge.slack)
    }

    /// What a sample over a ground may be that items hold so.
    fn sample(&self, ground: PaintRange, triangle: u32, held: &[(u32, Known)]) -> Sample {
        let held: Vec<(u32, Known)> = held.iter().copied().filter(|(_, k)| *k != Known::Out).collect();
        let open: Vec<usize> = (0..held.len()).filter(|k| held[*k].1 == Known::Open).collect();
        let (plan, depth) = (PlanBox::EMPTY, (0.0, 0.0));
        let outcome = |items: Vec<(u32, Known)>| {
            let paint = self.composed(ground, &items);
            Outcome { triangle, paint, ground, items: Some(items), plan, depth }
        };
        if open.len() > MOST_OPEN {
            return Sample { outcomes: vec![outcome(held)] };
        }
        let answered = |answers: u32| {
            let mut items = held.clone();
            for (bit, k) in open.iter().enumerate() {
                items[*k].1 = Known::of(answers >> bit & 1 == 1);
            }
            items.retain(|(_, known)| *known == Known::In);
            outcome(items)
        };
        Sample { outcomes: (0..1u32 << open.len()).map(answered).collect() }
    }

    fn composed(&self, ground: PaintRange, items: &[(u32, Known)]) -> PaintRange {
        let list = self.judge.outlines.list;
        let mut stack = Stack::on(ground);
        for (item, known) in items {
            let paint = self.paints[list.items()[*item as usize].style as usize];
            stack.draw(list.style_of(*item).group, |below| below.under_known(*known, paint, self.mode));
        }
        stack.finished()
    }
}
