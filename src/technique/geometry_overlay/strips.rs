//! The lines over the triangles in use: walks along the clippings of the quads that a view shows (Algorithm 1 and its variants, 3.2.1).
//!
//! Input: the quads in use, their DAGs. Output: [`Strip`]s in the order in which they are drawn, and what the walks cost. Refuses: nothing.

use super::Prepare;
use super::dag::{BlgTree, Borrowed, Cost, PolylineLods, QuadClipping, TriangleClipping};
use super::drawing::Strip;
use super::mesh::MeshInUse;
use super::settings;
use crate::math;
use crate::parallel;
use crate::space::{ViewFrame, World};
use crate::terrain::lod::{Post, Quad, QuadInUse};
use std::collections::BTreeMap;
use std::sync::Arc;

/// What a frame draws, and what that took.
#[derive(Debug, Default)]
pub(super) struct Overlay {
    /// In draw order; of an item, quad by quad.
    pub strips: Vec<Strip>,
    /// What the walks cost.
    pub cost: Cost,
    /// Quads in use that the view may see.
    pub quads: u64,
    /// Those of them that are drawn by another quad's vertices.
    pub borrowed: u64,
    /// Points before lines were simplified.
    pub points: u64,
}

/// What is drawn by the data of one quad.
struct Drawn<'a> {
    lods: &'a PolylineLods,
    data: Quad,
    /// Places, among the quads in use, of those that are drawn.
    in_use: Vec<usize>,
}

impl Prepare<'_> {
    /// The quads in use whose lines a view may see.
    pub(super) fn quads(&self, mesh: &MeshInUse, view: &ViewFrame) -> Vec<QuadInUse> {
        mesh.quads(view, 0.5 * self.stage.scene.device.max_line_width_px)
    }

    /// What is drawn of the quads that a view may see.
    pub(super) fn overlay(&self, mesh: &MeshInUse, view: &ViewFrame) -> Overlay {
        let in_use = self.quads(mesh, view);
        let mut by_data: BTreeMap<Quad, Vec<usize>> = BTreeMap::new();
        (0..).zip(&in_use).for_each(|(place, of)| by_data.entry(of.data).or_default().push(place));
        let data: Vec<Quad> = by_data.keys().copied().collect();
        let lods = self.store.of(mesh, &data);
        let drawn: Vec<Drawn> = by_data
            .into_iter()
            .zip(&lods)
            .map(|((data, in_use), lods)| Drawn { lods, data, in_use })
            .collect();
        let walk = Walk { prepared: self, mesh, view, in_use: &in_use };
        let mut parts = vec![Vec::new(); in_use.len()];
        let mut overlay = Overlay {
            quads: in_use.len() as u64,
            borrowed: in_use.iter().filter(|of| of.quad != of.data).count() as u64,
            ..Overlay::default()
        };
        for (of_quads, cost, points) in parallel::map(&drawn, |drawn| walk.walked(drawn)) {
            overlay.cost += cost;
            overlay.points += points;
            of_quads.into_iter().for_each(|(place, strips)| parts[place] = strips);
        }
        overlay.strips = parts.concat();
        overlay.strips.sort_by_key(|strip| strip.item);
        overlay
    }
}

/// What walks stand on.
struct Walk<'a> {
    prepared: &'a Prepare<'a>,
    mesh: &'a MeshInUse<'a>,
    view: &'a ViewFrame,
    in_use: &'a [QuadInUse],
}

/// The strips of quads by their places, what the walks cost, points before lines were simplified.
type Walked = (Vec<(usize, Vec<Strip>)>, Cost, u64);

impl Walk<'_> {
    fn has_vertex(&self, post: Post) -> bool {
        self.mesh.has_vertex(post)
    }

    fn walked(&self, drawn: &Drawn) -> Walked {
        let own = |place: &usize| self.in_use[*place].quad == drawn.data;
        let (mut all, mut cost, mut points) = (Vec::new(), Cost::default(), 0);
        for &place in drawn.in_use.iter().filter(|place| own(place)) {
            let mut strips = self.strips();
            for line in &drawn.lods.polylines {
                for quad in &line.quad_clippings {
                    let draw = |clipping: &TriangleClipping| strips.draw(line.chain, quad, clipping);
                    cost += quad.traverse(|post| self.has_vertex(post), draw);
                }
            }
            points += strips.points;
            all.push((place, strips.finished()));
        }
        let borrowed: Vec<usize> = drawn.in_use.iter().filter(|place| !own(place)).copied().collect();
        if !borrowed.is_empty() {
            points += self.add_borrowed(drawn, borrowed, &mut all, &mut cost);
        }
        (all, cost, points)
    }

    /// Those of quads that have no data of their own: where it is known where lines enter them, from there (the first variant); else by a walk
    /// over the whole quad that is borrowed from, which finds that out (the second).
    fn add_borrowed(
        &self,
        drawn: &Drawn,
        borrowed: Vec<usize>,
        all: &mut Vec<(usize, Vec<Strip>)>,
        cost: &mut Cost,
    ) -> u64 {
        let quad_of = |place: usize| self.in_use[place].quad;
        let known = |place: &usize| match self.prepared.settings.borrowed {
            settings::Borrowed::Cached => self.prepared.store.entrances(quad_of(*place), drawn.data),
            settings::Borrowed::Searched => None,
        };
        let mut unknown = BTreeMap::new();
        let mut points = 0;
        for place in borrowed {
            let Some(sub) = known(&place) else {
                unknown.insert(quad_of(place).into(), (place, self.strips()));
                continue;
            };
            let mut strips = self.strips();
            *cost += drawn.lods.traverse_cached(
                &sub,
                |post| self.has_vertex(post),
                |line, quad, clipping| strips.draw(line.chain, quad, clipping),
            );
            points += strips.points;
            all.push((place, strips.finished()));
        }
        if unknown.is_empty() {
            return points;
        }
        let squares = Borrowed::new(unknown.keys().copied());
        let numbered: Vec<_> = squares.squares().to_vec();
        let (subs, walk) = drawn.lods.traverse_borrowed(
            &squares,
            |post| self.has_vertex(post),
            |number, line, quad, clipping| {
                if let Some((_, strips)) = unknown.get_mut(&numbered[number]) {
                    strips.draw(line.chain, quad, clipping);
                }
            },
        );
        *cost += walk;
        let found = subs.into_iter().filter_map(|sub| {
            let (place, _) = unknown.get(&sub.square)?;
            Some((quad_of(*place), Arc::new(sub)))
        });
        self.prepared.store.keep_entrances(drawn.data, found);
        for (place, strips) in unknown.into_values() {
            points += strips.points;
            all.push((place, strips.finished()));
        }
        points
    }

    fn strips(&self) -> Strips<'_> {
        Strips { walk: self, done: Vec::new(), end: None, points: 0 }
    }
}

/// Strips being made, in the order of a walk.
struct Strips<'a> {
    walk: &'a Walk<'a>,
    done: Vec<Strip>,
    /// The chain that was drawn last, the first vertex of its quad clipping, and the crossing by which that was left: what goes on from there is the same
    /// primitive.
    end: Option<[u32; 3]>,
    /// Points before they were simplified.
    points: u64,
}

impl Strips<'_> {
    /// Draws a clipping: its points go to the strip that it continues, or begin one.
    fn draw(&mut self, chain: u32, of: &QuadClipping, clipping: &TriangleClipping) {
        let prepared = self.walk.prepared;
        let [entrance, exit] = clipping.crossings();
        let continued = entrance.map(|entrance| [chain, of.first_vertex, entrance]);
        if continued.is_none() || self.end != continued {
            let item = prepared.store.item_of(chain);
            self.done.push(Strip { item, clippings: Vec::new(), points: Vec::new() });
        }
        self.end = exit.map(|exit| [chain, of.first_vertex, exit]);
        let Some(strip) = self.done.last_mut().filter(|_| self.walk.mesh.is_drawn(&clipping.triangle)) else {
            return;
        };
        let first = strip.points.len();
        self.walk.mesh.add_points((of, clipping), &mut strip.points);
        self.points += (strip.points.len() - first) as u64;
        if prepared.settings.tolerance_px > 0.0 && strip.points.len() > first + 2 {
            let kept = self.walk.simplified(&strip.points[first..]);
            strip.points.truncate(first);
            strip.points.extend(kept);
        }
        if strip.points.len() > first {
            strip.clippings.push((clipping.triangle, first as u32..strip.points.len() as u32));
        }
    }

    fn finished(mut self) -> Vec<Strip> {
        self.done.retain(|strip| !strip.points.is_empty());
        self.done
    }
}

impl Walk<'_> {
    /// What a clipping's BLG tree leaves of its points by the tolerance in space that so many pixels are where it comes nearest to the eye (3.2.2).
    fn simplified(&self, points: &[World]) -> Vec<World> {
        let pixel = points.iter().map(|at| self.view.pixel_m(*at)).fold(f64::INFINITY, math::min);
        let tree = BlgTree::new(&points.iter().map(|at| at.to_vec()).collect::<Vec<_>>());
        let mut kept = vec![points[0]];
        tree.select(self.prepared.settings.tolerance_px * pixel, |point| kept.push(points[point as usize]));
        kept.push(points[points.len() - 1]);
        kept
    }
}
