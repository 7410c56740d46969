//! Terrain matching (3.2.2, 4.2.2, Algorithm 3.1, Fig. 3.5): segments are divided into parts, and the ends of parts stand on the terrain.
//!
//! Input: the draw list, a terrain that is draped vertically, the longest part. Output: pieces of lines, each of up to
//! [`PARTS_A_PIECE`] parts, with their vertices on the terrain. Where a vertex has no terrain under it (beside it, in a hole) it is put at the
//! middle of the terrain's heights. Refuses: parts so short that there are more than [`MOST_PARTS`].
//!
//! Pieces are found at once, their vertices when someone asks for them first, so that a view takes memory for what it sees alone; a tree of their boxes tells
//! which those are.

use crate::draw_list::{Chain, DrawList};
use crate::error::{Error, Result};
use crate::index::BoxTree;
use crate::parallel;
use crate::scene::Width;
use crate::space::{Plan, PlanBox, World};
use crate::terrain::Mesh;
use std::ops::Range;
use std::sync::OnceLock;

/// The most parts of a piece.
const PARTS_A_PIECE: u64 = 256;

/// The most parts of all lines together: their vertices take 24 bytes each.
const MOST_PARTS: u64 = 1 << 28;

/// Chains that one piece of parallel work looks at.
const CHAINS_AT_A_TIME: usize = 256;

/// A chain of a stroke whose width is in pixels.
#[derive(Debug, Clone)]
pub struct LineChain {
    /// Its item.
    pub item: u32,
    /// Its vertices in the draw list.
    pub chain: Chain,
    /// Its pieces.
    pub pieces: Range<u32>,
}

/// Consecutive parts of a chain's segments. A dot is a piece without a part.
#[derive(Debug)]
pub struct Piece {
    /// Where it begins: a segment of its chain and a part of this, both from 0.
    from: (u32, u32),
    /// How many parts there are.
    pub parts: u32,
    /// The box around its vertices.
    pub plan: PlanBox,
    vertices: OnceLock<Box<[World]>>,
}

/// All lines whose widths are in pixels, in draw order.
#[derive(Debug)]
pub struct MatchedLines<'s> {
    list: &'s DrawList,
    mesh: &'s Mesh,
    l_max: f64,
    middle: f64,
    /// The chains.
    pub chains: Vec<LineChain>,
    /// Their pieces.
    pub pieces: Vec<Piece>,
    /// Of their boxes.
    tree: BoxTree,
    /// How many parts there are in all.
    pub parts: u64,
    /// How many vertices the chains have.
    pub chain_vertices: u64,
}

impl<'s> MatchedLines<'s> {
    /// The dynamic lines of a list over a terrain; `l_max`: the longest part, metres, by default half the terrain's resolution (4.2.2).
    ///
    /// # Errors
    /// When there are too many parts.
    pub fn new(list: &'s DrawList, mesh: &'s Mesh, l_max: Option<f64>) -> Result<Self> {
        let l_max = l_max.unwrap_or_else(|| mesh.resolution() / 2.0);
        let is_dynamic = |item: &u32| {
            let stroke = list.style_of(*item).stroke;
            stroke.is_some_and(|line| matches!(line.width, Width::Pixels(_)))
        };
        let items = list.numbered().filter(|(number, _)| is_dynamic(number));
        let chains: Vec<(u32, Chain)> = items
            .flat_map(|(number, item)| list.strokes(item).iter().map(move |chain| (number, *chain)))
            .collect();
        let counts =
            parallel::map(&chains, |(_, chain)| segments(list, chain).map(|s| parts(s, l_max)).sum());
        let total: f64 = counts.iter().sum();
        if total > MOST_PARTS as f64 {
            return Err(Error::unsupported(format!(
                "dynamic-line: parts of at most {l_max} m cut the lines into {total:e}, at most 2^28 can be kept"
            ))
            .help("give technique.dynamic-line.l_max more metres, or the layers fewer features by `where`"));
        }
        let (low, high) = mesh.heights().unwrap_or_default();
        let mut lines = Self {
            list,
            mesh,
            l_max,
            middle: (low + high) / 2.0,
            chains: Vec::with_capacity(chains.len()),
            pieces: Vec::new(),
            tree: BoxTree::default(),
            parts: total as u64,
            chain_vertices: chains.iter().map(|(_, chain)| u64::from(chain.count)).sum(),
        };
        let cut = parallel::map_indices(chains.len().div_ceil(CHAINS_AT_A_TIME), |k| {
            let first = k * CHAINS_AT_A_TIME;
            let some = &chains[first..chains.len().min(first + CHAINS_AT_A_TIME)];
            some.iter().map(|(item, chain)| (*item, *chain, lines.cut(chain))).collect::<Vec<_>>()
        });
        for (item, chain, pieces) in cut.into_iter().flatten() {
            let first = lines.pieces.len() as u32;
            lines.pieces.extend(pieces);
            lines.chains.push(LineChain { item, chain, pieces: first..lines.pieces.len() as u32 });
        }
        let boxes: Vec<PlanBox> = lines.pieces.iter().map(|piece| piece.plan).collect();
        lines.tree = BoxTree::new(&boxes);
        Ok(lines)
    }

    /// The pieces whose boxes may be wanted, in their row; `may_be` is asked of boxes around several first, and must want those that hold one that it wants.
    pub fn pieces_that(&self, mut may_be: impl FnMut(&PlanBox) -> bool) -> Vec<u32> {
        let mut found = Vec::new();
        self.tree.search(
            |small| may_be(&small.bounds()),
            |piece| {
                found.push(piece);
                true
            },
        );
        found.sort_unstable();
        found
    }

    /// The place of the chain that a piece is of.
    pub fn chain_of(&self, piece: u32) -> usize {
        self.chains.partition_point(|chain| chain.pieces.end <= piece)
    }

    /// The pieces of a chain.
    fn cut(&self, chain: &Chain) -> Vec<Piece> {
        let mut pieces = Vec::new();
        let mut open: Option<Piece> = None;
        for (k, (from, to)) in (0..).zip(segments(self.list, chain)) {
            let count = parts((from, to), self.l_max) as u64;
            let mut at = 0;
            while at < count {
                let piece = open.get_or_insert_with(|| Piece {
                    from: (k, at as u32),
                    parts: 0,
                    plan: PlanBox::around([part_start((from, to), at, count)]),
                    vertices: OnceLock::new(),
                });
                let taken = (count - at).min(PARTS_A_PIECE - u64::from(piece.parts));
                at += taken;
                piece.parts += taken as u32;
                piece.plan.include(part_start((from, to), at, count));
                if u64::from(piece.parts) == PARTS_A_PIECE {
                    pieces.extend(open.take());
                }
            }
        }
        pieces.extend(open);
        if pieces.is_empty() {
            let plan = PlanBox::around([self.list.vertices_of(chain)[0]]);
            pieces.push(Piece { from: (0, 0), parts: 0, plan, vertices: OnceLock::new() });
        }
        pieces
    }

    /// The vertices of a piece of a chain on the terrain: one more than it has parts.
    pub fn vertices(&self, chain: &LineChain, piece: u32) -> &[World] {
        let piece = &self.pieces[piece as usize];
        piece.vertices.get_or_init(|| self.matched(&chain.chain, piece))
    }

    /// Of each vertex of a piece, at which of the draw list's vertices the segments start that it ends, and that it starts or lies on. Where no segment is,
    /// no matter.
    pub fn sources(&self, chain: &LineChain, piece: u32) -> Vec<[u32; 2]> {
        let (piece, first, path) =
            (&self.pieces[piece as usize], chain.chain.first, self.list.path_of(&chain.chain));
        let (mut segment, mut part) = piece.from;
        let mut sources = Vec::with_capacity(piece.parts as usize + 1);
        let mut add = |segment: u32, part: u32| {
            // Before a closed line's first vertex comes its last segment.
            let last = chain.chain.segments().saturating_sub(1);
            let into = if part > 0 { segment } else { segment.checked_sub(1).unwrap_or(last) };
            sources.push([first + into, first + segment]);
        };
        let mut left = piece.parts;
        while left > 0 {
            let count = parts((path[segment as usize], path[segment as usize + 1]), self.l_max) as u32;
            let taken = left.min(count - part);
            (part..part + taken).for_each(|part| add(segment, part));
            left -= taken;
            (segment, part) = if part + taken == count { (segment + 1, 0) } else { (segment, part + taken) };
        }
        add(segment, part);
        sources
    }

    /// Matches all pieces.
    pub fn match_all(&self) {
        let chunks = self.chains.chunks(CHAINS_AT_A_TIME).collect::<Vec<_>>();
        parallel::map(&chunks, |chains| {
            for chain in *chains {
                chain.pieces.clone().for_each(|piece| {
                    self.vertices(chain, piece);
                });
            }
        });
    }

    /// Algorithm 3.1, and a height for each vertex.
    fn matched(&self, chain: &Chain, piece: &Piece) -> Box<[World]> {
        let mut vertices = Vec::with_capacity(piece.parts as usize + 1);
        if piece.parts == 0 {
            return [self.on_terrain(self.list.vertices_of(chain)[0])].into();
        }
        let (mut segment, mut part) = piece.from;
        let path = self.list.path_of(chain);
        let mut left = piece.parts;
        loop {
            let ends = (path[segment as usize], path[segment as usize + 1]);
            let count = parts(ends, self.l_max) as u32;
            let taken = left.min(count - part);
            // The last vertex of a segment is the first of the next one.
            let starts = (part..part + taken).map(|k| part_start(ends, k.into(), count.into()));
            vertices.extend(starts.map(|at| self.on_terrain(at)));
            left -= taken;
            if left == 0 {
                let end = part_start(ends, (part + taken).into(), count.into());
                vertices.push(self.on_terrain(end));
                return vertices.into();
            }
            (segment, part) = (segment + 1, 0);
        }
    }

    /// Line sampling (4.2.2).
    fn on_terrain(&self, at: Plan) -> World {
        World::new(at.x, at.y, self.mesh.height_at(at).unwrap_or(self.middle))
    }

    /// Bytes of the chains, the pieces and those of their vertices that have been asked for.
    pub fn bytes(&self) -> usize {
        let vertices = |piece: &Piece| piece.vertices.get().map_or(0, |v| size_of_val(&v[..]));
        size_of_val(&self.chains[..])
            + size_of_val(&self.pieces[..])
            + self.tree.bytes()
            + self.pieces.iter().map(vertices).sum::<usize>()
    }
}

/// The segments of a chain.
fn segments<'l>(list: &'l DrawList, chain: &Chain) -> impl Iterator<Item = (Plan, Plan)> + 'l {
    list.path_of(chain).windows(2).map(|ends| (ends[0], ends[1]))
}

/// Algorithm 3.1, line 5: into how many parts a segment is divided.
fn parts((from, to): (Plan, Plan), l_max: f64) -> f64 {
    let length = (to - from).length();
    if length > l_max { (length / l_max).floor() + 1.0 } else { 1.0 }
}

/// Algorithm 3.1, lines 6 to 8: where part `k` of `count` starts; the last one ends where the segment does.
fn part_start((from, to): (Plan, Plan), k: u64, count: u64) -> Plan {
    if k == count { to } else { from + (to - from) / count as f64 * k as f64 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Cap, Color, Diagonal, Feature, Join, Layer, Line, Posts, Shape, Style, Surface};
    use glam::DVec2;

    /// A plane of 20 x 20 m whose height is its x, with a hole in the north-east.
    fn slope() -> Mesh {
        let heights = (0..121).map(|k| if k == 120 { f64::NAN } else { f64::from(k % 11) * 2.0 }).collect();
        let steps = (DVec2::X * 2.0, DVec2::Y * 2.0);
        let posts = Posts::new((11, 11), Plan::default(), steps, heights).unwrap();
        Mesh::new(Surface::Grid(posts), Diagonal::SwNe).unwrap()
    }

    fn list(points: &[(f64, f64)]) -> DrawList {
        let color = Color([0.0, 0.0, 0.0, 1.0]);
        let line = Line { color, width: Width::Pixels(3.0), join: Join::Round, cap: Cap::Round };
        let part = points.iter().map(|&(x, y)| Plan::new(x, y)).collect();
        let feature = Feature { index: 0, style: 0, shape: Shape::Line(vec![part]) };
        let style = Style { line: Some(line), ..Style::default() };
        DrawList::new(&mut [Layer::uniform("line", style, vec![feature])], &PlanBox::EMPTY).unwrap()
    }

    fn all(lines: &MatchedLines) -> Vec<World> {
        let chain = &lines.chains[0];
        let mut all = Vec::new();
        for piece in chain.pieces.clone() {
            let vertices = lines.vertices(chain, piece);
            assert_eq!(vertices.len(), lines.pieces[piece as usize].parts as usize + 1);
            let plan = lines.pieces[piece as usize].plan;
            assert!(plan.contains(&PlanBox::around(vertices.iter().map(|p| p.plan()))));
            assert!(all.is_empty() || all.last() == vertices.first(), "pieces share a vertex");
            all.extend_from_slice(&vertices[usize::from(!all.is_empty())..]);
        }
        all
    }

    #[test]
    fn a_segment_that_is_too_long_is_divided_into_equal_parts_that_stand_on_the_terrain() {
        // Fig. 3.5: 10 m in parts of less than 3.4, then 3 m as they are.
        let (list, mesh) = (list(&[(1.0, 1.0), (11.0, 1.0), (11.0, 4.0)]), slope());
        let lines = MatchedLines::new(&list, &mesh, Some(3.4)).unwrap();
        let x = [1.0, 1.0 + 10.0 / 3.0, 1.0 + 20.0 / 3.0, 11.0, 11.0];
        let found = all(&lines);
        assert_eq!((lines.parts, found.len()), (4, 5));
        for (found, x) in found.iter().zip(x) {
            assert!((found.x - x).abs() < 1e-12 && (found.z - x).abs() < 1e-12, "{found:?}");
        }
        // Half the resolution; a length of twice l_max has three parts (line 5 as printed).
        assert_eq!(MatchedLines::new(&list, &mesh, None).unwrap().parts, 11 + 4);
    }

    #[test]
    fn a_vertex_without_terrain_stands_at_the_middle_of_the_heights() {
        let (list, mesh) = (list(&[(-5.0, 1.0), (3.0, 1.0), (19.9, 19.9)]), slope());
        let lines = MatchedLines::new(&list, &mesh, Some(1e9)).unwrap();
        assert_eq!(all(&lines).iter().map(|p| p.z).collect::<Vec<_>>(), [10.0, 3.0, 10.0]);
    }

    #[test]
    fn pieces_of_many_parts_are_the_line() {
        let (list, mesh) = (list(&[(0.0, 3.0), (9.0, 3.0), (9.5, 3.0), (9.5, 17.0)]), slope());
        let lines = MatchedLines::new(&list, &mesh, Some(0.01)).unwrap();
        let found = all(&lines);
        assert_eq!(
            (lines.parts as usize + 1, lines.pieces.len()),
            (found.len(), lines.parts.div_ceil(256) as usize)
        );
        let steps = found.windows(2).map(|pair| (pair[1] - pair[0]).truncate().length());
        assert!(steps.clone().all(|step| step < 0.01));
        assert!((steps.sum::<f64>() - 23.5).abs() < 1e-9);
    }
}
