//! Which areas hold a pixel's samples (She 3.3 and 3.5), as far as the pixel's quadrilateral is known.

use super::outlines::{Area, Edge, Outlines};
use super::place::{NOWHERE, Place, Range, around, bilinear};
use crate::certainty::Known;
use crate::space::{Plan, PlanBox};
use crate::technique::inverse_projection::PointInPolygon;

/// The plan point that was looked at last, and the areas that hold it.
pub(super) type Last = Option<(Plan, Vec<Area>)>;

/// Judges samples by the rule of a scene.
pub(super) struct Judge<'a> {
    pub(super) outlines: &'a Outlines<'a>,
    pub(super) rule: PointInPolygon,
    /// How far rounding may move points, metres.
    pub(super) slack: f64,
}

/// What a pixel's corners may be in the plan: self, right, upper right, upper.
pub(super) type Quad<'a> = [&'a Place; 4];

/// An edge that may meet a pixel's quadrilateral, and where the quadrilateral's corners are of it: how far outward, and how far along.
struct NearEdge {
    edge: u32,
    /// Whether it meets the quadrilateral.
    meets: Known,
    outward: [Range; 4],
    along: [Range; 4],
}

/// What may hold a pixel's samples.
pub(super) struct Held {
    /// Whether any edge meets the quadrilateral.
    pub(super) is_partly: Known,
    /// How many edges meet it at least and at most.
    pub(super) edges: [usize; 2],
    /// Of each area that may have a part in the pixel, where any edge may meet it, whether it holds each sample (rows from the lower edge).
    pub(super) areas: Vec<(Area, Vec<Known>)>,
}

fn known(least: bool, most: bool) -> Known {
    if least == most { Known::of(least) } else { Known::Open }
}

/// One of two.
pub(super) fn either(a: Known, b: Known) -> Known {
    if a == b { a } else { Known::Open }
}

/// Whether a number is above another, up to a slack.
fn is_above(range: Range, limit: f64, slack: f64) -> Known {
    known(range[0] > limit + slack, range[1] > limit - slack)
}

impl Judge<'_> {
    /// Which areas hold a place as a whole, by winding numbers; those that surely do not are left out. `last`: what held the point that was
    /// looked at last.
    pub(super) fn holding(&self, place: &Place, last: &mut Last) -> Vec<(Area, Known)> {
        let bounds = place.bounds().grown(self.slack);
        let sure = |areas: &[Area]| areas.iter().map(|area| (*area, Known::In)).collect();
        let mut between = bounds;
        last.iter().for_each(|(at, _)| between.include(*at));
        if let Some((_, areas)) = last.as_ref().filter(|_| self.outlines.is_clear(&between)) {
            return sure(areas);
        }
        let (mut edges, mut holding) = (Vec::new(), Vec::new());
        self.outlines.near(&bounds, &mut edges);
        let at = place.point();
        self.outlines.holding(at, &mut holding);
        let mut all: Vec<(Area, Known)> = sure(&holding);
        *last = Some((at, holding));
        for edge in edges.into_iter().map(|edge| self.outlines.edge(edge)) {
            let outward = place.along(edge.from, edge.outward);
            let along = place.along(edge.from, edge.way);
            if self.may_cross(edge, outward, along) {
                match all.iter_mut().find(|(area, _)| *area == edge.area) {
                    Some(found) => found.1 = Known::Open,
                    None => all.push((edge.area, Known::Open)),
                }
            }
        }
        all.sort_unstable_by_key(|(area, _)| *area);
        all
    }

    /// Whether an edge may cross what lies between these ranges of it.
    fn may_cross(&self, edge: &Edge, outward: Range, along: Range) -> bool {
        let meets =
            |range: Range, low: f64, high: f64| range[0] <= high + self.slack && range[1] >= low - self.slack;
        meets(outward, 0.0, 0.0) && meets(along, 0.0, edge.length)
    }

    /// Which areas hold the samples of a pixel whose centre may be at a place; `holding`: which hold the centre.
    pub(super) fn held(&self, quad: Quad, samples: u32, holding: &[(Area, Known)]) -> Held {
        let near = self.near(quad);
        if near.is_empty() {
            return Held { is_partly: Known::Out, edges: [0, 0], areas: Vec::new() };
        }
        let mut held = Held { is_partly: Known::Out, edges: [0, near.len()], areas: Vec::new() };
        for edge in &near {
            held.is_partly = held.is_partly.or(edge.meets);
            held.edges[0] += usize::from(edge.meets == Known::In);
        }
        let place = |k: u32| (f64::from(k) + 0.5) / f64::from(samples);
        let places: Vec<[f64; 2]> =
            (0..samples).flat_map(|v| (0..samples).map(move |u| [place(u), place(v)])).collect();
        let area_of = |edge: &NearEdge| self.outlines.edge(edge.edge).area;
        let holders = self.holders(quad, &places);
        for of_area in near.chunk_by(|a, b| area_of(a) == area_of(b)) {
            let area = area_of(&of_area[0]);
            let whole = holding.iter().find(|(known, _)| *known == area).map_or(Known::Out, |(_, k)| *k);
            // Without an edge in the pixel the area holds all of it or none.
            let is_judged = of_area.iter().any(|edge| edge.meets == Known::In);
            let states = places.iter().enumerate().map(|(k, at)| {
                let judged = match self.rule {
                    PointInPolygon::EdgeNormals => self.by_normals(of_area, *at),
                    PointInPolygon::Winding => self.by_winding(of_area, *at, holders[k].contains(&area)),
                };
                if is_judged { judged } else { either(judged, whole) }
            });
            held.areas.push((area, states.collect()));
        }
        for (area, known) in holding {
            if !held.areas.iter().any(|(known, _)| known == area) {
                held.areas.push((*area, vec![*known; places.len()]));
            }
        }
        held.areas.sort_unstable_by_key(|(area, _)| *area);
        held
    }

    /// The areas that hold each sample if no edge crosses where it may be, where that is asked for.
    fn holders(&self, quad: Quad, places: &[[f64; 2]]) -> Vec<Vec<Area>> {
        if self.rule != PointInPolygon::Winding {
            return Vec::new();
        }
        let corners = quad.map(Place::point);
        let at = |[u, v]: &[f64; 2]| {
            let axis = |of: fn(&Plan) -> f64| bilinear(&corners.map(|p| [of(&p); 2]), *u, *v)[0];
            let mut holding = Vec::new();
            self.outlines.holding(Plan::new(axis(|p| p.x), axis(|p| p.y)), &mut holding);
            holding
        };
        places.iter().map(at).collect()
    }

    /// The edges that may meet a quadrilateral, by areas.
    fn near(&self, quad: Quad) -> Vec<NearEdge> {
        let mut bounds = PlanBox::EMPTY;
        quad.iter().for_each(|place| bounds.include_box(&place.bounds()));
        let mut edges = Vec::new();
        self.outlines.near(&bounds.grown(self.slack), &mut edges);
        let corners: [Vec<Plan>; 4] = quad.map(corners_of);
        let mut near = Vec::new();
        for number in edges {
            let edge = self.outlines.edge(number);
            let outward = quad.map(|place| place.along(edge.from, edge.outward));
            let along = quad.map(|place| place.along(edge.from, edge.way));
            let all = |ranges: &[Range; 4]| ranges.iter().fold(NOWHERE, |all, r| around(all, *r));
            if self.may_cross(edge, all(&outward), all(&along)) {
                let meets = known(self.surely_meets(edge, &outward, &corners), true);
                near.push(NearEdge { edge: number, meets, outward, along });
            }
        }
        near
    }

    /// Whether an edge meets a quadrilateral wherever its corners are: crosses a side of it, or starts in it.
    fn surely_meets(&self, edge: &Edge, outward: &[Range; 4], corners: &[Vec<Plan>; 4]) -> bool {
        let sides = [0, 1, 2, 3].map(|k| {
            let other = (k + 1) % 4;
            let off = [outward[k], outward[other]].map(|range| is_above(range, 0.0, self.slack));
            let is_across = matches!(off, [Known::In, Known::Out] | [Known::Out, Known::In]);
            let ends = [edge.from, edge.to].map(|end| self.side_of(&corners[k], &corners[other], end));
            (is_across, ends)
        });
        let is_crossed = |(is_across, ends): &(bool, [Known; 2])| {
            *is_across && matches!(ends, [Known::In, Known::Out] | [Known::Out, Known::In])
        };
        let first = sides[0].1[0];
        sides.iter().any(is_crossed)
            || (first != Known::Open && sides.iter().all(|(_, ends)| ends[0] == first))
    }

    /// Whether a point lies left of the line from any of some points to any of others.
    fn side_of(&self, from: &[Plan], to: &[Plan], at: Plan) -> Known {
        let mut all = NOWHERE;
        for p in from {
            for q in to {
                let (way, off) = (*q - *p, at - *p);
                let doubt = self.slack * (way.length() + off.length());
                let side = way.perp_dot(off);
                all = around(all, [side - doubt, side + doubt]);
            }
        }
        is_above(all, 0.0, 0.0)
    }

    /// Codes A and B: each edge whose pedal lies on it counts for or against the sample.
    fn by_normals(&self, edges: &[NearEdge], [u, v]: [f64; 2]) -> Known {
        let (mut least, mut most) = (0, 0);
        let is_alone = edges.len() == 1;
        for near in edges {
            let length = self.outlines.edge(near.edge).length;
            let outward = is_above(bilinear(&near.outward, u, v), 0.0, self.slack);
            let along = bilinear(&near.along, u, v);
            let is_on = (!is_above([-along[1], -along[0]], 0.0, self.slack))
                .and(!is_above(along, length, self.slack));
            // Where it is the only edge, it is the one that makes the pixel a partial one.
            let counts = if is_alone { is_on } else { is_on.and(near.meets) };
            let mut votes = match outward {
                Known::In => [-1, -1],
                Known::Out => [1, 1],
                Known::Open => [-1, 1],
            };
            votes = match counts {
                Known::In => votes,
                Known::Out => [0, 0],
                Known::Open => [votes[0].min(0), votes[1].max(0)],
            };
            (least, most) = (least + votes[0], most + votes[1]);
        }
        known(least > 0, most > 0)
    }

    /// By the winding number, which is that of a point of the sample's place unless an edge may cross it.
    fn by_winding(&self, edges: &[NearEdge], [u, v]: [f64; 2], is_in: bool) -> Known {
        let may_cross = |near: &NearEdge| {
            let [outward, along] = [&near.outward, &near.along].map(|of| bilinear(of, u, v));
            self.may_cross(self.outlines.edge(near.edge), outward, along)
        };
        if edges.iter().any(may_cross) { Known::Open } else { Known::of(is_in) }
    }
}

/// Places of more patches than this are taken as boxes.
const MOST_PATCHES: usize = 3;

/// Points whose hull holds a place.
fn corners_of(place: &Place) -> Vec<Plan> {
    let boxed = |plan: &PlanBox| {
        let (min, max) = (plan.min, plan.max);
        [min, Plan::new(max.x, min.y), max, Plan::new(min.x, max.y)]
    };
    if place.0.len() > MOST_PATCHES {
        return boxed(&place.bounds()).to_vec();
    }
    let of = |patch: &super::place::Patch| {
        let corners = patch.corners.unwrap_or_else(|| boxed(&patch.plan));
        corners.into_iter().chain(patch.others.iter().copied()).collect::<Vec<_>>()
    };
    place.0.iter().flat_map(of).collect()
}
