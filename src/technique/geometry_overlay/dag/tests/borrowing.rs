//! Quads of which some are drawn by the data of larger ones: all that is drawn is the cut at the triangles in use, whoever draws it.

use super::brute_force::{Mesh, cut};
use super::*;

/// A root of this side and stride, quarters and sixteenths of it.
const ROOT: Block = Block { square: Square { side: 4 * SIDE, low: [0, 0] }, stride: 4 };

/// Quads in use and whose data each is drawn by.
#[derive(Debug, Clone)]
struct Quads(Vec<(Square, Block)>);

/// Each quarter is drawn by its own data, by the root's, or divided into quarters that are drawn by their own, by their parent's or by the root's.
fn quads() -> impl Strategy<Value = Quads> {
    let sixteenths = prop::array::uniform4(0..3u8);
    prop::array::uniform4((0..4u8, sixteenths)).prop_map(|choices| {
        let mut all = Vec::new();
        for (quarter, (choice, sixteenths)) in (0..4).zip(choices) {
            let own = block(quarter % 2, quarter / 2, 2);
            match choice {
                0 => all.push((own.square, own)),
                1 => all.push((own.square, ROOT)),
                _ => all.extend((0..4).zip(sixteenths).map(|(k, whose)| {
                    let part = block(2 * (quarter % 2) + k % 2, 2 * (quarter / 2) + k / 2, 1);
                    (part.square, [part, own, ROOT][usize::from(whose)])
                })),
            }
        }
        Quads(all)
    })
}

impl Quads {
    /// Whether each quad's data have the vertices that a mesh has in it and on its border.
    fn have(&self, mesh: &Mesh) -> bool {
        let has = |post: &Post| {
            self.0.iter().all(|(square, data)| {
                let [low, high] = square.corners();
                let is_in = (0..2).all(|k| low[k] <= post[k] && post[k] <= high[k]);
                !is_in || post.iter().all(|at| at.is_multiple_of(data.stride))
            })
        };
        mesh.vertices().iter().all(has)
    }

    /// A mesh whose triangles lie in one quad each, split where these numbers say as far as the data go.
    fn mesh(&self, splits: &[usize]) -> Mesh {
        let mut mesh = Mesh::of_squares([0, 0], ROOT.square.side, 1, 0);
        let has_own = |triangle: &RightTriangle| {
            self.0.iter().any(|(square, _)| {
                let [low, high] = square.corners();
                let is_in = |post: Post| (0..2).all(|k| low[k] <= post[k] && post[k] <= high[k]);
                triangle.corners().into_iter().all(is_in)
            })
        };
        while let Some(large) = mesh.triangles.iter().find(|triangle| !has_own(triangle)).copied() {
            mesh.split(large);
        }
        for pick in splits {
            let triangle = *mesh.triangles.iter().nth(pick % mesh.triangles.len()).unwrap();
            let mut finer = mesh.clone();
            finer.split(triangle);
            if self.have(&finer) {
                mesh = finer;
            }
        }
        mesh
    }

    /// The different data.
    fn data(&self) -> Vec<Block> {
        let mut data: Vec<Block> = self.0.iter().map(|(_, data)| *data).collect();
        data.sort_by_key(|data| data.square);
        data.dedup();
        data
    }

    /// The squares that borrow data.
    fn borrowers(&self, data: Block) -> Borrowed {
        let is_borrower = |(square, of): &&(Square, Block)| *of == data && *square != data.square;
        Borrowed::new(self.0.iter().filter(is_borrower).map(|(square, _)| *square))
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn all_quads_together_draw_the_cut_at_the_triangles_in_use(
        chain in chain([0, 0], 4 * SIDE),
        quads in quads(),
        splits in splits(),
        other_splits in splits(),
    ) {
        let [mesh, other] = [splits, other_splits].map(|splits| quads.mesh(&splits));
        let [vertices, other_vertices] = [&mesh, &other].map(Mesh::vertices);
        let (mut all, mut all_of_other) = (Vec::new(), Vec::new());
        for data in quads.data() {
            let lods = lods(data, std::slice::from_ref(&chain));
            if quads.0.contains(&(data.square, data)) {
                all.extend(drawn(&lods, &vertices));
                all_of_other.extend(drawn(&lods, &other_vertices));
            }
            let borrowed = quads.borrowers(data);
            let mut pieces = vec![Vec::new(); borrowed.squares().len()];
            let (subs, cost) = lods.traverse_borrowed(&borrowed, |post| vertices.contains(&post), |number, _, quad, clipping| {
                pieces[number].push(piece(quad, clipping));
            });
            let mut cached_cost = Cost::default();
            for (sub, pieces) in subs.iter().zip(&pieces) {
                let mut cached = Vec::new();
                cached_cost += lods.traverse_cached(sub, |post| vertices.contains(&post), |_, quad, clipping| {
                    cached.push(piece(quad, clipping));
                });
                prop_assert_eq!(&cached, pieces);
                // What was kept stays valid for another mesh.
                lods.traverse_cached(sub, |post| other_vertices.contains(&post), |_, quad, clipping| {
                    all_of_other.push(piece(quad, clipping));
                });
            }
            prop_assert_eq!(cached_cost.drawn, cached_cost.visited);
            prop_assert_eq!(cached_cost.drawn, cost.drawn);
            prop_assert_eq!(cached_cost.tested, cost.tested);
            prop_assert!(cost.visited >= cost.drawn);
            all.extend(pieces.into_iter().flatten());
        }
        prop_assert_eq!(sorted(all), sorted(cut(&chain, &mesh.triangles)));
        prop_assert_eq!(sorted(all_of_other), sorted(cut(&chain, &other.triangles)));
    }
}

#[test]
fn a_walk_that_knows_no_start_goes_to_all_smallest_triangles_between_what_borrows_and_tests_at_most_all_that_cover_a_point()
 {
    // Over the whole root from west to east; the north-eastern quarter's row of sixteenths borrows every other one.
    let lods = lods(ROOT, &[vec![[-1.0, 17.5], [33.0, 17.5]]]);
    let squares = [1, 3].map(|x| Square { side: SIDE, low: [x * SIDE, 2 * SIDE] });
    let mesh = Mesh::of_squares([0, 0], SIDE, 4, 0);
    let mut corners = Vec::new();
    let borrowed = Borrowed::new(squares);
    let vertices = mesh.vertices();
    let (subs, cost) = lods.traverse_borrowed(
        &borrowed,
        |post| vertices.contains(&post),
        |_, _, _, clipping| {
            corners.push(clipping.triangle);
        },
    );
    // Two halves of each square; outside two cells of two halves in each of two others.
    assert_eq!(corners.len(), 4);
    assert_eq!(cost, Cost { visited: 4 + 8, tested: 2 * 3, drawn: 4 });
    let starts = subs.iter().flat_map(|sub| &sub.polylines[0].sub_quad_clippings).map(|sub| sub.start);
    assert_eq!(starts.collect::<Vec<_>>(), [4, 12]);
}
