//! What is kept of lines, chunk by chunk.

use super::limit::{MOST, too_many};
use super::style::{Keep, StrokeStyle};
use crate::error::Result;
use crate::math;
use crate::scene::{OffsetForm, Width};
use crate::space::{Plan, PlanBox};
use crate::technique::clipmap::tessellation::{OffsetVertex, Pair, Polyline, Sagitta, Strips};
use glam::DVec2;
use std::ops::Range;

/// Segments of a chunk.
const CHUNK: usize = 32;

/// A width at which inner boundaries meet wherever they can: for lines whose width is not known when offsets are made.
const THIN_M: f64 = 1e-3;

/// Lines in memory.
#[derive(Debug)]
pub(super) struct Strokes {
    /// The item of each part, and whether it is a loop.
    part_items: Vec<(u32, bool)>,
    /// Where the vertices of each part begin, and where the last ones end.
    part_starts: Vec<u32>,
    vertices: Vec<Plan>,
    /// The part of each chunk and its place there.
    chunks: Vec<(u32, u32)>,
    /// The box around each chunk's vertices.
    pub(super) boxes: Vec<PlanBox>,
    /// Where the strips of each chunk begin in `strip_ends`; nothing where no strips are stored.
    chunk_strips: Vec<u32>,
    strip_ends: Vec<u32>,
    stored: Stored,
}

/// The vertices of stored strips.
#[derive(Debug)]
enum Stored {
    /// As they are drawn.
    Pairs(Vec<Pair<Plan>>),
    /// With offsets for half a width of a metre (solution 4b).
    Rectangular(Vec<OffsetVertex>),
    /// The same, each offset a length and an angle.
    Polar(Vec<PolarVertex>),
}

/// A vertex with its offsets to the left and to the right, lengths and angles.
#[derive(Debug, Clone, Copy, PartialEq)]
struct PolarVertex {
    at: Plan,
    left: [f64; 2],
    right: [f64; 2],
}

impl Stored {
    fn len(&self) -> usize {
        match self {
            Self::Pairs(vertices) => vertices.len(),
            Self::Rectangular(vertices) => vertices.len(),
            Self::Polar(vertices) => vertices.len(),
        }
    }

    fn bytes(&self) -> usize {
        match self {
            Self::Pairs(vertices) => size_of_val(&vertices[..]),
            Self::Rectangular(vertices) => size_of_val(&vertices[..]),
            Self::Polar(vertices) => size_of_val(&vertices[..]),
        }
    }

    /// Adds a strip that has been made for half a width.
    fn push(&mut self, strip: &[OffsetVertex], half: f64) {
        match self {
            Self::Pairs(vertices) => vertices.extend(strip.iter().map(|v| v.pair(1.0))),
            Self::Rectangular(vertices) => vertices.extend(strip.iter().map(|v| OffsetVertex {
                at: v.at,
                left: v.left / half,
                right: v.right / half,
            })),
            Self::Polar(vertices) => vertices.extend(strip.iter().map(|v| {
                let polar = |offset: DVec2| [offset.length() / half, math::atan2(offset.y, offset.x)];
                PolarVertex { at: v.at, left: polar(v.left), right: polar(v.right) }
            })),
        }
    }

    fn append(&mut self, other: Self) {
        match (self, other) {
            (Self::Pairs(vertices), Self::Pairs(more)) => vertices.extend(more),
            (Self::Rectangular(vertices), Self::Rectangular(more)) => vertices.extend(more),
            (Self::Polar(vertices), Self::Polar(more)) => vertices.extend(more),
            // All strokes of a scene are stored alike.
            _ => {}
        }
    }

    /// A vertex of the line, where it is kept (otherwise the strip's left one), and its pair for half a width.
    #[inline]
    fn get(&self, at: usize, half: f64) -> (Plan, Pair<Plan>) {
        match self {
            Self::Pairs(vertices) => (vertices[at].left, vertices[at]),
            Self::Rectangular(vertices) => (vertices[at].at, vertices[at].pair(half)),
            Self::Polar(vertices) => {
                let PolarVertex { at, left, right } = vertices[at];
                let offset = |[length, angle]: [f64; 2]| {
                    DVec2::new(math::cos(angle), math::sin(angle)) * (length * half)
                };
                (at, Pair { left: at + offset(left), right: at + offset(right) })
            }
        }
    }
}

impl Strokes {
    /// No lines, whose offsets are to be stored in a form, or whose strips where there is none.
    pub(super) fn new(offsets: Option<OffsetForm>) -> Self {
        Self {
            part_items: Vec::new(),
            part_starts: Vec::new(),
            vertices: Vec::new(),
            chunks: Vec::new(),
            boxes: Vec::new(),
            chunk_strips: Vec::new(),
            strip_ends: Vec::new(),
            stored: match offsets {
                None => Stored::Pairs(Vec::new()),
                Some(OffsetForm::Rectangular) => Stored::Rectangular(Vec::new()),
                Some(OffsetForm::Polar) => Stored::Polar(Vec::new()),
            },
        }
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.part_items[..])
            + size_of_val(&self.part_starts[..])
            + size_of_val(&self.vertices[..])
            + size_of_val(&self.chunks[..])
            + size_of_val(&self.chunk_strips[..])
            + size_of_val(&self.strip_ends[..])
            + self.stored.bytes()
    }

    /// Adds a part of a stroke; a line of one vertex is a dot.
    pub(super) fn push(&mut self, item: u32, line: &Polyline, style: &StrokeStyle) {
        let part = self.part_items.len() as u32;
        self.part_items.push((item, line.is_loop));
        self.part_starts.push(self.vertices.len() as u32);
        let n = line.vertices.len();
        match style.keep {
            Keep::Lines | Keep::Both => self.vertices.extend(line.vertices),
            Keep::Adjacency => {
                // An open line begins and ends twice; a loop is closed, and runs on by a vertex on both sides.
                let at = |k: usize| line.vertices[k % n];
                let (before, after) =
                    if line.is_loop { (at(n - 1), &[at(0), at(1)][..]) } else { (at(0), &[at(n - 1)][..]) };
                self.vertices.push(before);
                self.vertices.extend(line.vertices);
                self.vertices.extend(after);
            }
            Keep::Strips | Keep::Offsets => {}
        }
        let segments = line.segments();
        for place in 0..segments.div_ceil(CHUNK).max(1) {
            let of_chunk = place * CHUNK..segments.min((place + 1) * CHUNK);
            self.chunks.push((part, place as u32));
            let vertices = (of_chunk.start..=of_chunk.end).map(|k| line.vertices[k % n]);
            self.boxes.push(PlanBox::around(vertices));
            if style.keep.has_strips() {
                self.store(line, of_chunk, style);
            }
        }
    }

    /// Stores the strips of a chunk.
    fn store(&mut self, line: &Polyline, segments: Range<usize>, style: &StrokeStyle) {
        let half = match style.width {
            Width::Metres(width) => 0.5 * width,
            Width::Pixels(_) => THIN_M,
        };
        let mut strips = Strips::default();
        match line.vertices {
            [at] => style.tessellation.dot(*at, half, Sagitta::DEFAULT, &mut strips),
            _ => style.tessellation.part(line, segments, half, Sagitta::DEFAULT, &mut strips),
        }
        self.chunk_strips.push(self.strip_ends.len() as u32);
        for strip in strips.iter() {
            self.stored.push(strip, half);
            self.strip_ends.push(self.stored.len() as u32);
        }
    }

    /// Adds another's strokes after these.
    ///
    /// # Errors
    /// When there are too many.
    pub(super) fn append(&mut self, other: Self) -> Result<()> {
        let (vertices, stored) = (self.vertices.len(), self.stored.len());
        if vertices + other.vertices.len() > MOST || stored + other.stored.len() > MOST {
            return Err(too_many("vertices"));
        }
        let (parts, strips) = (self.part_items.len() as u32, self.strip_ends.len() as u32);
        self.part_items.extend(other.part_items);
        self.part_starts.extend(other.part_starts.iter().map(|start| start + vertices as u32));
        self.vertices.extend(other.vertices);
        self.chunks.extend(other.chunks.iter().map(|(part, place)| (part + parts, *place)));
        self.boxes.extend(other.boxes);
        // Chunks without strips before those that have some: theirs are empty.
        if !other.chunk_strips.is_empty() {
            let chunks_before = self.chunks.len() - other.chunk_strips.len();
            self.chunk_strips.resize(chunks_before, strips);
        }
        self.chunk_strips.extend(other.chunk_strips.iter().map(|start| start + strips));
        self.strip_ends.extend(other.strip_ends.iter().map(|end| end + stored as u32));
        self.stored.append(other.stored);
        Ok(())
    }

    /// Ends the lists of beginnings, when all strokes are there.
    pub(super) fn finish(&mut self) {
        self.part_starts.push(self.vertices.len() as u32);
        if !self.chunk_strips.is_empty() {
            self.chunk_strips.resize(self.chunks.len() + 1, self.strip_ends.len() as u32);
        }
    }

    /// Scales all stored pairs about their middles: what a change of the width takes where pairs have the line in the middle (methods 1,
    /// 2 and 3a; 4.2.5, 5.1).
    pub(super) fn scale_pairs(&mut self, factor: f64) {
        if let Stored::Pairs(pairs) = &mut self.stored {
            crate::parallel::for_each_chunk(pairs, 1 << 14, |_, pairs| {
                for pair in pairs {
                    let half = (pair.right - pair.left) * 0.5;
                    let middle = pair.left + half;
                    (pair.left, pair.right) = (middle + half * -factor, middle + half * factor);
                }
            });
        }
    }

    /// Tessellates all stored strips anew from the lines that are kept beside them (methods 3b; 5.1).
    pub(super) fn retessellate(&mut self, style_of: impl Fn(u32) -> Option<StrokeStyle> + Sync) {
        let blocks = crate::parallel::map_indices(self.chunks.len().div_ceil(1 << 12), |block| {
            let chunks = block << 12..((block + 1) << 12).min(self.chunks.len());
            let mut made = Self::new(None);
            for chunk in chunks {
                let (part, place) = self.chunks[chunk];
                let (item, is_loop) = self.part_items[part as usize];
                let vertices = self.vertices_of(part as usize);
                match style_of(item).filter(|style| style.keep == Keep::Both) {
                    Some(style) => {
                        let line = Polyline { vertices, is_loop };
                        let first = place as usize * CHUNK;
                        made.store(&line, first..line.segments().min(first + CHUNK), &style);
                    }
                    // A chunk without strips: its width is in pixels.
                    None => made.chunk_strips.push(made.strip_ends.len() as u32),
                }
            }
            made
        });
        let mut all = Self::new(None);
        for block in blocks {
            let (stored, strips) = (all.stored.len() as u32, all.strip_ends.len() as u32);
            all.chunk_strips.extend(block.chunk_strips.iter().map(|start| start + strips));
            all.strip_ends.extend(block.strip_ends.iter().map(|end| end + stored));
            all.stored.append(block.stored);
        }
        all.chunk_strips.push(all.strip_ends.len() as u32);
        (self.chunk_strips, self.strip_ends, self.stored) = (all.chunk_strips, all.strip_ends, all.stored);
    }

    fn vertices_of(&self, part: usize) -> &[Plan] {
        &self.vertices[self.part_starts[part] as usize..self.part_starts[part + 1] as usize]
    }

    /// A chunk.
    pub(super) fn chunk(&self, chunk: u32) -> Chunk<'_> {
        Chunk { strokes: self, chunk }
    }
}

/// Up to 32 segments of a part.
#[derive(Debug, Clone, Copy)]
pub(in crate::technique::clipmap) struct Chunk<'s> {
    strokes: &'s Strokes,
    chunk: u32,
}

impl<'s> Chunk<'s> {
    fn part(&self) -> usize {
        self.strokes.chunks[self.chunk as usize].0 as usize
    }

    /// The item that it is a part of.
    pub(in crate::technique::clipmap) fn item(&self) -> u32 {
        self.strokes.part_items[self.part()].0
    }

    /// The first segment's number in the part.
    fn first(&self) -> usize {
        self.strokes.chunks[self.chunk as usize].1 as usize * CHUNK
    }

    /// Calls `visit` with the segments that are drawn as line primitives.
    pub(in crate::technique::clipmap) fn segments(
        &self,
        style: &StrokeStyle,
        visit: &mut impl FnMut(Plan, Plan),
    ) {
        let (vertices, first) = (self.strokes.vertices_of(self.part()), self.first());
        let mut along = |vertices: &[Plan]| {
            let windows = vertices.windows(2).skip(first).take(CHUNK);
            windows.for_each(|pair| visit(pair[0], pair[1]));
        };
        match (style.keep, vertices) {
            (Keep::Lines | Keep::Both, [start, .., end]) => {
                along(vertices);
                let is_loop = self.strokes.part_items[self.part()].1;
                if is_loop && (first..first + CHUNK).contains(&(vertices.len() - 1)) {
                    visit(*end, *start);
                }
            }
            // Between the vertex before the line and the one after it.
            (Keep::Adjacency, [_, line @ .., _]) => along(line),
            (Keep::Lines | Keep::Both | Keep::Adjacency, _) => {}
            // Wireframe: the sides of the quadrilaterals (4.3.2).
            (Keep::Strips, _) => self.stored(1.0, &mut |strip| {
                let pairs: Vec<Pair<Plan>> = strip.map(|(_, pair)| pair).collect();
                for sides in pairs.windows(2) {
                    let (from, to) = (sides[0], sides[1]);
                    visit(from.left, from.right);
                    visit(from.right, to.right);
                    visit(to.right, to.left);
                    visit(to.left, from.left);
                }
            }),
            // The duplicates of offsets' vertices make segments of no length.
            (Keep::Offsets, _) => self.stored(1.0, &mut |strip| {
                let mut last = None;
                for (at, _) in strip {
                    if let Some(from) = last.replace(at).filter(|from| *from != at) {
                        visit(from, at);
                    }
                }
            }),
        }
    }

    /// Calls `visit` with the strips of polygons of half a width in metres.
    pub(in crate::technique::clipmap) fn strips(
        &self,
        style: &StrokeStyle,
        (half, sagitta): (f64, Sagitta),
        room: &mut Strips,
        visit: &mut impl FnMut(&mut dyn Iterator<Item = Pair<Plan>>),
    ) {
        if style.keep.has_strips() {
            return self.stored(half, &mut |strip| visit(&mut strip.map(|(_, pair)| pair)));
        }
        room.clear();
        let (vertices, first) = (self.strokes.vertices_of(self.part()), self.first());
        let tessellation = &style.tessellation;
        match (style.keep, vertices) {
            (Keep::Adjacency, [_, at, _]) | (Keep::Lines, [at]) => tessellation.dot(*at, half, sagitta, room),
            // As many segments as windows of four.
            (Keep::Adjacency, _) => {
                let segments = vertices.windows(4).skip(first).take(CHUNK);
                tessellation.adjacency(segments, half, sagitta, room);
            }
            _ => {
                let line = Polyline { vertices, is_loop: self.strokes.part_items[self.part()].1 };
                tessellation.part(&line, first..line.segments().min(first + CHUNK), half, sagitta, room);
            }
        }
        for strip in room.iter() {
            visit(&mut strip.iter().map(|v| v.pair(1.0)));
        }
    }

    /// Calls `visit` with the stored strips.
    fn stored(&self, half: f64, visit: &mut impl FnMut(&mut dyn Iterator<Item = (Plan, Pair<Plan>)>)) {
        let Strokes { chunk_strips, strip_ends, stored, .. } = self.strokes;
        let chunk = self.chunk as usize;
        for k in chunk_strips[chunk] as usize..chunk_strips[chunk + 1] as usize {
            let start = if k == 0 { 0 } else { strip_ends[k - 1] };
            visit(&mut (start as usize..strip_ends[k] as usize).map(|at| stored.get(at, half)));
        }
    }
}
