//! The structures of static decals as arrays: a reader that has nothing but these finds, as a shader would, the items that the library finds.
#![cfg(feature = "render")]

mod drawing;

use drapery::Bundle;
use drapery::buffer::{Plane, Values};
use drapery::decal::{Hits, LookupCounts, Palette};
use drapery::draw_list::DrawList;
use drapery::resolve::Compositor;
use drapery::scene::BlendMode;
use drapery::space::Plan;
use drapery::stage::Stage;
use drapery::technique::static_decal::Prepare;
use drapery::technique::{Frame, FrameOptions, Kind, Prepared};
use drawing::stage;
use std::collections::BTreeSet;

/// Everything that static decals draw.
const SCENE: &str = include_str!("../src/technique/static_decal/every_decal.toml");

/// The number of no row.
const NONE: u32 = u32::MAX;

type Point = [f64; 2];

/// A table: numbers of a row, all numbers.
struct Table<'a, T>(usize, &'a [T]);

impl<'a, T> Table<'a, T> {
    fn row(&self, k: u32) -> &'a [T] {
        &self.1[k as usize * self.0..][..self.0]
    }
}

/// What a shader is given.
struct Reader<'a> {
    /// Children of a node: of the settings, it needs this alone.
    children: u32,
    planes: &'a [Plane],
}

impl<'a> Reader<'a> {
    fn plane(&self, name: &str) -> &'a Plane {
        self.planes.iter().find(|plane| plane.name == name).unwrap()
    }

    fn whole(&self, name: &str) -> Table<'a, u32> {
        let plane = self.plane(name);
        let Values::U32(values) = &plane.values else { panic!("{name} has no whole numbers") };
        Table(plane.width, values)
    }

    fn real(&self, name: &str) -> Table<'a, f64> {
        let plane = self.plane(name);
        let Values::F64(values) = &plane.values else { panic!("{name} has no doubles") };
        Table(plane.width, values)
    }

    fn vertex(&self, k: u32) -> Point {
        let row = self.real("decal-vertices").row(k);
        [row[0], row[1]]
    }

    fn style(&self, item: u32) -> (&'a [u32], &'a [f64]) {
        let style = self.whole("items").row(item)[2];
        (self.whole("styles").row(style), self.real("style-values").row(style))
    }

    /// Algorithm 3.5 without its colours: the items that hold a point.
    fn find(&self, at: Point) -> BTreeSet<u32> {
        let mut found = BTreeSet::new();
        let Some(cell) = self.cell_of(at) else { return found };
        let cell = self.whole("cells").row(cell);
        for leaf in self.walk("line", cell[0], cell[1], at) {
            let segment = self.whole("segments").row(cell[2] + leaf);
            if self.segment_holds(segment, at) && self.is_on_the_side(segment, cell, at) {
                found.insert(segment[0]);
            }
        }
        for leaf in self.walk("polygon", cell[4], cell[5], at) {
            let polygon = self.whole("polygons").row(cell[6] + leaf);
            let is_inside = polygon[1] != NONE && self.area_holds(polygon[1], at);
            let is_outside_that_counts = self.style(polygon[0]).0[0] == 1;
            if is_inside != is_outside_that_counts {
                found.insert(polygon[0]);
            }
        }
        found
    }

    /// Eqs. 4.3, 4.4.
    fn cell_of(&self, at: Point) -> Option<u32> {
        let (grid, cells) = (self.real("grid"), self.plane("cells").height as f64);
        let side = cells.sqrt();
        let place = |k: usize| (at[k] - grid.row(0)[k]) / ((grid.row(1)[k] - grid.row(0)[k]) / side);
        let (x, y) = (place(0), place(1));
        let is_inside = x >= 0.0 && y >= 0.0 && x < side && y < side;
        is_inside.then_some(x as u32 + side as u32 * y as u32)
    }

    /// The leaves whose boxes hold a point, without a stack (4.4.1, Eqs. 4.5 to 4.7).
    fn walk(&self, which: &str, first: u32, count: u32, at: Point) -> Vec<u32> {
        let (nodes, boxes) = (self.whole(&format!("{which}-nodes")), self.real(&format!("{which}-boxes")));
        let mut found = Vec::new();
        if count == 0 {
            return found;
        }
        let (mut node, internal) = (0, (count - 1) / self.children);
        loop {
            let number = nodes.row(first + node)[0];
            let is_hit = number != NONE && holds(boxes.row(number), at);
            if is_hit && node < internal {
                node = self.children * node + 1;
                continue;
            }
            if is_hit {
                found.push(node - internal);
            }
            while node % self.children == 0 {
                if node == 0 {
                    return found;
                }
                node = (node - 1) / self.children;
            }
            node += 1;
        }
    }

    /// Whether a stroke's segment holds a point: rectangle, caps, the join at its start.
    fn segment_holds(&self, segment: &[u32], at: Point) -> bool {
        let (words, values) = self.style(segment[0]);
        let (half, limit) = (values[4], values[5]);
        let (from, to) = (self.vertex(segment[1]), self.vertex(segment[2]));
        let neighbour = |k: usize| (segment[k] != NONE).then(|| self.vertex(segment[k]));
        let (before, after) = (neighbour(3), neighbour(4));
        let (u, w, along) = (minus(at, from), minus(at, to), minus(to, from));
        let length = length(along);
        let d = if length > 0.0 { [along[0] / length, along[1] / length] } else { [1.0, 0.0] };
        let has_disc = |is_joined: bool| if is_joined { words[3] == 0 } else { words[4] == 2 };
        if (has_disc(before.is_some()) && self::length(u) <= half)
            || (has_disc(after.is_some()) && self::length(w) <= half)
        {
            return true;
        }
        let square = |is_joined: bool| if !is_joined && words[4] == 1 { half } else { 0.0 };
        let (low, high) = (-square(before.is_some()), length + square(after.is_some()));
        if cross(d, u).abs() <= half && low <= dot(d, u) && dot(d, u) <= high {
            return length > 0.0 || words[4] == 1;
        }
        let Some(before) = before else { return false };
        let into = minus(from, before);
        let e = [into[0] / self::length(into), into[1] / self::length(into)];
        let (turn, cosine) = (cross(e, d), dot(e, d));
        let is_beyond_limit = turn == 0.0 && cosine < 0.0 || limit * limit * (1.0 + cosine) < 2.0;
        match (words[3], is_beyond_limit) {
            (3, true) => return self::length(u) <= half,
            (0, _) => return false,
            _ if turn == 0.0 => return false,
            _ => {}
        }
        // Across both segments, to the outer side of the turn.
        let outward = |d: Point| if turn > 0.0 { [d[1], -d[0]] } else { [-d[1], d[0]] };
        let (m, n) = (outward(e), outward(d));
        let is_between = dot(e, u) >= 0.0 && dot(d, u) <= 0.0;
        let is_miter = words[3] >= 2 && !is_beyond_limit;
        is_between
            && if is_miter {
                dot(m, u) <= half && dot(n, u) <= half
            } else {
                dot([m[0] + n[0], m[1] + n[1]], u) <= half * (1.0 + cosine)
            }
    }

    /// Whether a point is on the side of an outline's polygon that counts.
    fn is_on_the_side(&self, segment: &[u32], cell: &[u32], at: Point) -> bool {
        let cut = self.style(segment[0]).0[2];
        if cut == 0 {
            return true;
        }
        if segment[5] != 0 {
            let (from, to) = (self.vertex(segment[1]), self.vertex(segment[2]));
            return (cross(minus(to, from), minus(at, from)) > 0.0) == (segment[5] == 1);
        }
        let feature = |item: u32| &self.whole("items").row(item)[..2];
        let is_own = |area: &u32| feature(self.whole("areas").row(*area)[0]) == feature(segment[0]);
        let own = (cell[8]..cell[8] + cell[9]).find(is_own);
        own.is_some_and(|area| self.area_holds(area, at)) == (cut == 1)
    }

    /// Whether a point is inside of any member of an area.
    fn area_holds(&self, area: u32, at: Point) -> bool {
        let row = self.whole("areas").row(area);
        let is_nonzero = self.style(row[0]).0[1] == 1;
        let mut turns: std::collections::BTreeMap<u32, i32> = Default::default();
        for part in row[1]..row[1] + row[2] {
            let part = self.whole("ring-parts").row(part);
            let ring = self.whole("rings").row(part[0]);
            assert!(ring[0] == row[0] && (ring[2]..ring[2] + ring[3]).contains(&part[1]));
            *turns.entry(ring[1]).or_default() += self.winding(ring[2], part[1], at);
        }
        turns.values().any(|turns| if is_nonzero { *turns != 0 } else { turns % 2 != 0 })
    }

    /// The winding number of a point by the quadtree of a ring, from a node on.
    fn winding(&self, root: u32, mut node: u32, at: Point) -> i32 {
        let (boxes, nodes) = (self.real("quadtree-boxes"), self.whole("quadtree-nodes"));
        let (whole, part) = (boxes.row(root), boxes.row(node));
        let is_below =
            |k: usize| at[k] < part[k + 2] || (at[k] == part[k + 2] && part[k + 2] == whole[k + 2]);
        if at[0] < part[0] || at[1] < part[1] || !is_below(0) || !is_below(1) {
            return 0;
        }
        loop {
            let [kind, value] = nodes.row(node) else { panic!("a node has two columns") };
            match kind {
                0 => {
                    let first = boxes.row(*value);
                    node = value + u32::from(at[0] >= first[2]) + 2 * u32::from(at[1] >= first[3]);
                }
                1 => return 0,
                2 => return *value as i32,
                3 => return self.winding_in_leaf(boxes.row(node), *value, at),
                other => panic!("a node has no type {other}"),
            }
        }
    }

    /// Counts what crosses the way from the point to the east until it is above the leaf's south-east corner, and from there down to it.
    fn winding_in_leaf(&self, plan: &[f64], leaf: u32, at: Point) -> i32 {
        let leaf = self.whole("quadtree-leaves").row(leaf);
        let corner = [plan[2], plan[1]];
        let mut turns = leaf[2] as i32;
        for edge in leaf[0]..leaf[0] + leaf[1] {
            let ends = self.whole("quadtree-edges").row(edge);
            let (a, b) = (self.vertex(ends[0]), self.vertex(ends[1]));
            let slope = [b[0] - a[0], b[1] - a[1]];
            if (a[1] <= at[1]) != (b[1] <= at[1]) {
                let x = a[0] + slope[0] * ((at[1] - a[1]) / slope[1]);
                if x > at[0] && x <= corner[0] {
                    turns += if slope[1] > 0.0 { 1 } else { -1 };
                }
            }
            if (a[0] <= corner[0]) != (b[0] <= corner[0]) {
                let y = a[1] + slope[1] * ((corner[0] - a[0]) / slope[0]);
                let is_above = y > corner[1] || (y == corner[1] && slope[1] * slope[0] > 0.0);
                if is_above && y <= at[1] {
                    turns += if slope[0] > 0.0 { 1 } else { -1 };
                }
            }
        }
        turns
    }
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn length(a: Point) -> f64 {
    dot(a, a).sqrt()
}

fn holds(plan: &[f64], at: Point) -> bool {
    plan[0] <= at[0] && at[0] <= plan[2] && plan[1] <= at[1] && at[1] <= plan[3]
}

fn names() -> Vec<String> {
    let planes = Kind::StaticDecal.declaration().planes.iter().filter(|plane| plane.is_structure);
    planes.map(|plane| plane.name.to_owned()).collect()
}

fn structures(prepared: &Prepare, stage: &Stage) -> Frame {
    let buffers = names();
    let options = FrameOptions { buffers: &buffers, ..FrameOptions::default() };
    prepared.frame(&stage.view().unwrap(), &options).unwrap()
}

fn stage_of(settings: &[&str]) -> Stage {
    let changes: Vec<String> = settings.iter().map(|set| format!("technique.static-decal.{set}")).collect();
    stage(SCENE, &changes.iter().map(String::as_str).collect::<Vec<_>>())
}

/// Points of the plan without a pattern, a few beside the terrain.
fn points(stage: &Stage, count: u64) -> impl Iterator<Item = Point> {
    let bounds = stage.mesh.plan_bounds();
    let share = |k: u64, by: u64| (k.wrapping_mul(by) >> 11) as f64 / (1u64 << 53) as f64 * 1.06 - 0.03;
    (1..=count).map(move |k| {
        let (s, t) = (share(k, 0x9e37_79b9_7f4a_7c15), share(k, 0xd1b5_4a32_d192_ed03));
        let size = bounds.max - bounds.min;
        [bounds.min.x + s * size.x, bounds.min.y + t * size.y]
    })
}

/// The items that the library finds; none hides another here.
fn found(prepared: &Prepare, list: &DrawList, compositor: Compositor, at: Point) -> BTreeSet<u32> {
    let palette = Palette::new(list, compositor, BlendMode::Additive);
    let mut hits = Hits::default();
    let point = [Plan::new(at[0], at[1])];
    prepared.decals().find(&point, &palette, &mut hits, &mut LookupCounts::default());
    hits.found().iter().map(|hit| hit.item).collect()
}

/// Compares the reader with the library at many points; how many items they have found.
#[track_caller]
fn compare(settings: &[&str]) -> usize {
    let stage = stage_of(settings);
    let prepared = Prepare::new(&stage, &|_| {}).unwrap();
    let frame = structures(&prepared, &stage);
    let children = if settings.contains(&"hierarchy=wide") { 8 } else { 2 };
    let reader = Reader { children, planes: &frame.planes };
    let compositor = Compositor::new(stage.scene.compositing);
    let of_point = |at: Point| {
        let right = found(&prepared, &stage.draw_list, compositor, at);
        assert_eq!(reader.find(at), right, "{settings:?} {at:?}");
        right.len()
    };
    points(&stage, 700).map(of_point).sum()
}

#[test]
fn the_arrays_alone_tell_which_items_hold_a_point() {
    for (k, grid) in ["grid=1", "grid=50"].into_iter().enumerate() {
        for (l, capacity) in ["leaf_capacity=1", "leaf_capacity=8"].into_iter().enumerate() {
            for (m, leaves) in ["leaf_polygons=corner", "leaf_polygons=clipped"].into_iter().enumerate() {
                for (n, hierarchy) in ["hierarchy=binary", "hierarchy=wide"].into_iter().enumerate() {
                    let joins = if (k + l + m + n) % 2 == 0 { "joins=thesis" } else { "joins=style" };
                    let outlines = if (k + m) % 2 == 0 { "outlines=side" } else { "outlines=polygon" };
                    let items = compare(&[grid, capacity, leaves, hierarchy, joins, outlines]);
                    assert!(items > 1000, "the points would not tell");
                }
            }
        }
    }
    assert!(compare(&["hierarchy=curve", "grid=9", "depth=2"]) > 1000);
}

#[test]
fn the_arrays_are_of_all_cells_whatever_was_drawn_before() {
    let of = |settings: &[&str], draws_before: bool| -> Vec<Plane> {
        let stage = stage_of(settings);
        let prepared = Prepare::new(&stage, &|_| {}).unwrap();
        if draws_before {
            prepared.frame(&stage.view().unwrap(), &FrameOptions::default()).unwrap();
        }
        structures(&prepared, &stage).planes
    };
    let whole = of(&["grid=20", "preparation=whole"], false);
    assert_eq!(whole, of(&["grid=20"], false));
    assert_eq!(whole, of(&["grid=20"], true));
    assert_eq!(whole.len(), names().len());
}

#[test]
fn a_frame_tells_the_bytes_of_what_has_been_built_by_what_they_are_for() {
    let whole = stage_of(&["grid=20", "preparation=whole"]);
    let stage = stage_of(&["grid=20"]);
    let prepared = Prepare::new(&stage, &|_| {}).unwrap();
    let parts = ["grid_bytes", "line_bytes", "polygon_bytes", "quadtree_bytes", "index_bytes"];
    let count = |frame: &Frame, name: &str| drawing::count(frame, name);
    let seen = prepared.frame(&stage.view().unwrap(), &FrameOptions::default()).unwrap();
    let prepared = Prepare::new(&whole, &|_| {}).unwrap();
    let all = prepared.frame(&whole.view().unwrap(), &FrameOptions::default()).unwrap();
    let sum = parts.iter().map(|name| count(&all, name)).sum::<u64>();
    assert_eq!(sum, prepared.structure_bytes() as u64);
    assert!(count(&seen, "cells") < 400 && count(&all, "cells") == 400, "something lies outside everywhere");
    for name in &parts[..3] {
        assert!(count(&seen, name) < count(&all, name), "{name}");
    }
}

#[test]
fn a_bundle_has_the_arrays_and_tells_their_layout_and_their_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let stage = stage_of(&["grid=6"]);
    Bundle::of(&stage, Kind::StaticDecal).write_to(folder.path()).unwrap();
    let read = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    let layout = String::from_utf8(read("README.md")).unwrap();
    let result: serde_json::Value = serde_json::from_slice(&read("result.json")).unwrap();
    let buffers = result["runs"][1]["buffers"].as_array().unwrap();
    for name in names() {
        let file = format!("static-decal.{name}.npy");
        assert!(layout.contains(&format!("`{file}`")), "{file} is not told");
        let bytes = read(&file);
        let head = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        let told = buffers.iter().find(|buffer| buffer["name"] == name.as_str()).unwrap();
        assert_eq!(told["bytes"], bytes.len() - head, "{name}");
    }
}
