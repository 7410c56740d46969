//! The structure and its walks against cuts in rational arithmetic (`brute_force`), over quads of 8 x 8 cells.

mod borrowing;
mod brute_force;
mod points;
mod tables;

use super::crossing::Crossing;
use super::grid::{Block, GridPoint, Square};
use super::*;
use crate::terrain::lod::{Post, Quad, RightTriangle};
use brute_force::{Mesh, Piece, cut};
use proptest::prelude::*;
use std::collections::BTreeSet;

/// Cells a side of the tests' quads, and their layers.
const SIDE: u32 = 8;
const LAYERS: u32 = 7;

fn block(x: u32, y: u32, stride: u32) -> Block {
    let side = SIDE * stride;
    Block { square: Square { side, low: [x * side, y * side] }, stride }
}

/// Points in and around a square of so many posts: on posts, edges and diagonals, and elsewhere.
fn chain(low: Post, side: u32) -> impl Strategy<Value = Vec<GridPoint>> {
    let side = f64::from(side);
    let on_lattice = move |step: f64| {
        let count = (side * 1.5 / step) as i32;
        (0..=count, 0..=count).prop_map(move |(x, y)| [x, y].map(|n| f64::from(n) * step - side / 4.0))
    };
    let anywhere = (-0.3..1.3, -0.3..1.3).prop_map(move |(x, y)| [x * side, y * side]);
    let point = prop_oneof![on_lattice(1.0), on_lattice(2.0), on_lattice(0.5), anywhere];
    let points = prop::collection::vec((point, 0..4u8), 1..9);
    (points, any::<bool>()).prop_map(move |(points, is_closed)| {
        // One in four comes twice.
        let again = |(point, times): (GridPoint, u8)| vec![point; 1 + usize::from(times == 0)];
        let mut points: Vec<GridPoint> = points.into_iter().flat_map(again).collect();
        if is_closed {
            points.push(points[0]);
        }
        points.into_iter().map(|[x, y]| [x + f64::from(low[0]), y + f64::from(low[1])]).collect()
    })
}

/// A mesh whose triangles were split where these numbers say.
fn refined(mut mesh: Mesh, splits: &[usize]) -> Mesh {
    for pick in splits {
        let count = mesh.triangles.len();
        let triangle = *mesh.triangles.iter().nth(pick % count).unwrap();
        mesh.split(triangle);
    }
    mesh
}

fn splits() -> impl Strategy<Value = Vec<usize>> {
    prop::collection::vec(any::<usize>(), 0..40)
}

fn lods(block: Block, chains: &[Vec<GridPoint>]) -> PolylineLods {
    let lines = (0..).zip(chains.iter().map(|chain| chain.iter().copied()));
    PolylineLods::new(block, Layers::All, &Chains::new(lines))
}

/// A clipping as the brute force tells it.
fn piece(quad: &QuadClipping, clipping: &TriangleClipping) -> Piece {
    let [entrance, exit] = clipping.crossings().map(|k| Some(quad.crossings[k? as usize].at));
    let vertices = clipping.vertices().map(|k| quad.first_vertex as usize + k).collect();
    Piece { triangle: clipping.triangle, entrance, vertices, exit }
}

/// What Algorithm 1 draws of the only chain, over a mesh with these vertices.
fn drawn(lods: &PolylineLods, vertices: &BTreeSet<Post>) -> Vec<Piece> {
    let mut pieces = Vec::new();
    for quad in lods.polylines.iter().flat_map(|line| &line.quad_clippings) {
        quad.traverse(|post| vertices.contains(&post), |clipping| pieces.push(piece(quad, clipping)));
    }
    pieces
}

/// Pieces in an order of no meaning, to compare those that come from different walks.
fn sorted(mut pieces: Vec<Piece>) -> Vec<Piece> {
    pieces.sort_by_cached_key(|piece| format!("{piece:?}"));
    pieces
}

/// All triangles of a layer in a block.
fn uniform(block: Block, layer: u32) -> Mesh {
    let mut mesh = Mesh::of_squares(block.square.low, block.square.side, 1, layer);
    while let Some(coarse) = mesh.triangles.iter().find(|t| t.layer() > layer).copied() {
        mesh.split(coarse);
    }
    mesh
}

/// The links of 3.1, said of triangles and of the smallest clippings that a clipping is made of.
fn assert_linked(quad: &QuadClipping) {
    let all = &quad.triangle_clippings[..];
    let finest = &all[..quad.finest_count() as usize];
    let starts_at = |clipping: &TriangleClipping| {
        let end = clipping.finest_exit_descendant as usize;
        // Backwards while the triangle holds them.
        let holds = |part: &&TriangleClipping| within(&part.triangle, clipping.triangle);
        end + 1 - finest[..=end].iter().rev().take_while(holds).count()
    };
    for (k, clipping) in all.iter().enumerate() {
        if let Some(parent) = clipping.parent() {
            let parent = &all[parent as usize];
            assert_eq!(parent.triangle, clipping.triangle.whole());
            assert!(starts_at(parent) <= starts_at(clipping));
            assert!(parent.finest_exit_descendant >= clipping.finest_exit_descendant);
        }
        let after = clipping.finest_exit_descendant as usize + 1;
        let next = clipping.next().map(|next| next.map(|number| &all[number as usize]));
        for next in next.into_iter().flatten() {
            assert_eq!(starts_at(next), after, "{k}");
            assert!(next.triangle.layer().abs_diff(clipping.triangle.layer()) <= 1);
        }
        assert_eq!(next[0].is_some(), after < finest.len(), "{k} has a next one where the line goes on");
        if let [Some(finer), Some(coarser)] = next {
            assert_eq!(finer.triangle.whole(), coarser.triangle);
            assert_eq!(Some(clipping.decision_vertex), coarser.triangle.middle());
        }
    }
}

/// Whether a triangle is a part of another, or that one.
fn within(part: &RightTriangle, whole: RightTriangle) -> bool {
    let mut part = *part;
    while part.layer() < whole.layer() {
        part = part.whole();
    }
    part == whole
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn algorithm_1_draws_what_the_cut_at_the_triangles_in_use_is(
        (stride, chain) in (0..2u32).prop_flat_map(|k| (Just(1 << k), chain([SIDE << k, (2 * SIDE) << k], SIDE << k))),
        splits in splits(),
    ) {
        let block = block(1, 2, stride);
        let mesh = Mesh::of_squares(block.square.low, block.square.side, 1, 2 * stride.ilog2());
        let mesh = refined(mesh, &splits);
        let found = drawn(&lods(block, std::slice::from_ref(&chain)), &mesh.vertices());
        prop_assert_eq!(found, cut(&chain, &mesh.triangles));
    }

    #[test]
    fn each_layer_has_the_cuts_at_all_its_triangles_with_their_links(chain in chain([0, SIDE], SIDE)) {
        let block = block(0, 1, 1);
        let lods = lods(block, std::slice::from_ref(&chain));
        lods.polylines.iter().flat_map(|line| &line.quad_clippings).for_each(assert_linked);
        for layer in 0..LAYERS {
            let quads = lods.polylines.iter().flat_map(|line| &line.quad_clippings);
            let in_layer = quads.flat_map(|quad| {
                let all = quad.triangle_clippings.iter().filter(|clipping| clipping.triangle.layer() == layer);
                all.map(|clipping| piece(quad, clipping))
            });
            prop_assert_eq!(in_layer.collect::<Vec<_>>(), cut(&chain, &uniform(block, layer).triangles));
        }
    }

    #[test]
    fn cells_that_are_split_in_any_way_have_their_smallest_triangles(
        chain in chain([0, 0], SIDE),
        rising in prop::collection::vec(any::<bool>(), (SIDE * SIDE) as usize),
    ) {
        let splits = |[x, y]: [u32; 2]| rising[(y * SIDE + x) as usize];
        let halves = |cell: [u32; 2]| {
            let [sw, ne] = [cell, cell.map(|at| at + 1)];
            let (se, nw) = ([ne[0], sw[1]], [sw[0], ne[1]]);
            let corners = if splits(cell) { [[se, ne, sw], [nw, sw, ne]] } else { [[sw, se, nw], [ne, nw, se]] };
            corners.map(|[apex, left, right]| RightTriangle { apex, left, right })
        };
        let triangles: BTreeSet<_> = (0..SIDE * SIDE).flat_map(|k| halves([k % SIDE, k / SIDE])).collect();
        let chains = Chains::new([(7, chain.iter().copied())]);
        let lods = PolylineLods::new(block(0, 0, 1), Layers::Smallest(&splits), &chains);
        let every_post = (0..(SIDE + 1).pow(2)).map(|k| [k % (SIDE + 1), k / (SIDE + 1)]).collect();
        prop_assert_eq!(drawn(&lods, &every_post), cut(&chain, &triangles));
    }
}

#[test]
fn chains_without_length_and_along_edges_and_over_corners_have_their_pieces() {
    let chains: [&[GridPoint]; 8] = [
        &[],
        &[[3.0, 3.0]],
        &[[3.5, 3.5], [3.5, 3.5], [3.5, 3.5]],
        // Along a border from corner to corner, there and back; along a diagonal of the whole quad.
        &[[0.0, 0.0], [8.0, 0.0], [0.0, 0.0]],
        &[[0.0, 8.0], [8.0, 8.0]],
        &[[0.0, 0.0], [8.0, 8.0]],
        // Over the corners alone.
        &[[-1.0, 1.0], [1.0, -1.0], [9.0, 7.0], [7.0, 9.0]],
        // Back and forth in one triangle, then out and in again.
        &[[0.5, 0.25], [0.75, 0.25], [0.5, 0.25], [0.75, 0.25], [-1.0, 0.25], [0.75, 0.25]],
    ];
    for chain in chains {
        for layer in 0..LAYERS {
            let mesh = uniform(block(0, 0, 1), layer);
            let found = drawn(&lods(block(0, 0, 1), &[chain.to_vec()]), &mesh.vertices());
            assert_eq!(found, cut(chain, &mesh.triangles), "{chain:?}, layer {layer}");
        }
    }
}

#[test]
fn a_point_over_a_quad_of_129_posts_a_side_is_covered_by_15_triangles() {
    let quad = Quad { level: 1, x: 1, y: 0 };
    let lods = lods(quad.into(), &[vec![[300.7, 100.1]]]);
    let clippings = &lods.polylines[0].quad_clippings[0].triangle_clippings;
    let layers: Vec<u32> = clippings.iter().map(|clipping| clipping.triangle.layer()).collect();
    assert_eq!(layers, (2..17).collect::<Vec<_>>());
    assert!(quad.roots().contains(&clippings[14].triangle));
    assert!(clippings.iter().all(|clipping| clipping.vertices() == (0..1)));
}

#[test]
fn a_long_chain_is_the_same_line_however_few_of_its_parts_are_near() {
    // In and out of the quad, by steps of many lengths.
    let at = |k: u32| [k * k % 61, k * k * k % 67].map(|n| f64::from(n) * 0.31 - 6.0);
    let chain: Vec<GridPoint> = (0..150).map(|k| at(k / 3 * 2 + k % 3)).collect();
    // Of its parts of 32 segments the third lies far away, with the last point of the second and the first of the fourth, whose neighbours
    // lie in the quad.
    let far = |k: usize| if (64..97).contains(&k) { 100.0 } else { 0.0 };
    let mut chain: Vec<GridPoint> = chain.iter().enumerate().map(|(k, [x, y])| [x + far(k), *y]).collect();
    (chain[63], chain[97]) = ([3.3, 4.4], [5.5, 2.2]);
    let mesh = uniform(block(0, 0, 1), 2);
    let found = drawn(&lods(block(0, 0, 1), std::slice::from_ref(&chain)), &mesh.vertices());
    assert_eq!(found, cut(&chain, &mesh.triangles));
}
