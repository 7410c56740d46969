//! The structure and its walks against cuts in rational arithmetic (`brute_force`), over quads of 8 x 8 cells.

#[path = "tests/brute_force.rs"]
mod brute_force;

use super::*;
use crate::terrain::lod::{Post, RightTriangle};
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

/// All triangles of a layer in a block.
fn uniform(block: Block, layer: u32) -> Mesh {
    let mut mesh = Mesh::of_squares(block.square.low, block.square.side, 1, layer);
    while let Some(coarse) = mesh.triangles.iter().find(|t| t.layer() > layer).copied() {
        mesh.split(coarse);
    }
    mesh
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn algorithm_1_draws_what_the_cut_at_the_triangles_in_use_is(
        (stride, chain) in (0..2u32).prop_flat_map(|k| (Just(1 << k), chain([SIDE << k, 2 * SIDE << k], SIDE << k))),
        splits in splits(),
    ) {
        let block = block(1, 2, stride);
        let mesh = Mesh::of_squares(block.square.low, block.square.side, 1, 2 * stride.ilog2());
        let mesh = refined(mesh, &splits);
        let found = drawn(&lods(block, std::slice::from_ref(&chain)), &mesh.vertices());
        prop_assert_eq!(found, cut(&chain, &mesh.triangles));
    }

    #[test]
    fn each_layer_has_the_cuts_at_all_its_triangles(chain in chain([0, SIDE], SIDE)) {
        let block = block(0, 1, 1);
        let lods = lods(block, std::slice::from_ref(&chain));
        for layer in 0..LAYERS {
            let quads = lods.polylines.iter().flat_map(|line| &line.quad_clippings);
            let in_layer = quads.flat_map(|quad| {
                let all = quad.triangle_clippings.iter().filter(|clipping| clipping.triangle.layer() == layer);
                all.map(|clipping| piece(quad, clipping))
            });
            prop_assert_eq!(in_layer.collect::<Vec<_>>(), cut(&chain, &uniform(block, layer).triangles));
        }
    }
}
