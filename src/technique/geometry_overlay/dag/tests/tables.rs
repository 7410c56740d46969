//! What is told of the structure: sizes and flat tables.

use super::*;

/// A zigzag of many points within one smallest triangle, and a line across the quad.
fn example() -> (Chains, PolylineLods) {
    let zigzag: Vec<GridPoint> =
        (0..100).map(|k| [0.5 + 0.001 * f64::from(k), 0.25 + 0.001 * f64::from(k % 2)]).collect();
    let across = vec![[-1.0, 2.5], [9.0, 2.5]];
    let chains = Chains::new([(40, zigzag), (50, across)]);
    let lods = PolylineLods::new(block(0, 0, 1), Layers::All, &chains);
    (chains, lods)
}

#[test]
fn points_are_stored_once_a_layer_as_coordinates_and_once_as_projectors() {
    let (_, lods) = example();
    let zigzag =
        PolylineLods { polylines: vec![], ..PolylineLods::new(lods.block, Layers::All, &Chains::default()) };
    assert_eq!(Storage::of(&zigzag, false), Storage::default());
    let lods = PolylineLods { block: lods.block, polylines: lods.polylines.into_iter().take(1).collect() };
    let storage = Storage::of(&lods, false);
    let layers = u64::from(LAYERS);
    assert_eq!(storage.points, 100);
    assert_eq!(storage.all, Counts { clippings: layers, points: 100 * layers });
    assert_eq!(storage.two_finest, Counts { clippings: 2, points: 200 });
    assert_eq!(Storage::of(&lods, true).two_finest, storage.all);
    let coordinates = |form, layers| storage.bytes(form, layers).coordinates;
    assert_eq!(coordinates(PointForm::Cartesian, StoredLayers::All), 100 * 12 * layers);
    assert_eq!(coordinates(PointForm::Cartesian, StoredLayers::TwoFinest), 100 * 12 * 2);
    assert_eq!(coordinates(PointForm::Projectors, StoredLayers::All), 100 * 8);
    let all = storage.bytes(PointForm::Projectors, StoredLayers::All);
    assert_eq!(all.total(), 100 * 8 + layers * 32);
}

#[test]
fn crossings_are_counted_by_each_clipping_that_has_them() {
    let (_, mut lods) = example();
    lods.polylines.remove(0);
    let storage = Storage::of(&lods, false);
    // Along the middle of a row of cells: each is crossed at its sides and at its diagonal.
    assert_eq!(storage.points, 8 + 8 + 1);
    assert_eq!(
        storage.two_finest.clippings,
        16 + lods.polylines[0].quad_clippings[0]
            .triangle_clippings
            .iter()
            .filter(|c| c.triangle.layer() == 1)
            .count() as u64
    );
    assert_eq!(storage.all.points, 2 * storage.all.clippings);
    assert!(lods.bytes() > 17 * 24 + 16 * 64);
}

#[test]
fn the_arrays_lead_along_the_same_walk() {
    let (chains, lods) = example();
    let other = PolylineLods::new(block(0, 0, 2), Layers::All, &chains);
    let arrays = Arrays::new([&other, &lods], &chains).unwrap();
    assert_eq!(arrays.quads, [[0, 0, 16, 2, 0, 2], [0, 0, 8, 1, 2, 2]]);
    assert_eq!([arrays.polylines[2][..2].to_vec(), arrays.polylines[3][..2].to_vec()], [[0, 40], [1, 50]]);
    let vertices = uniform(lods.block, 3).vertices();
    let mut expected = Vec::new();
    let quad = &lods.polylines[1].quad_clippings[0];
    quad.traverse(|post| vertices.contains(&post), |clipping| expected.push(piece(quad, clipping)));
    // Algorithm 1 by rows alone.
    let [first_vertex, start, _, _, _, mut at, _] = arrays.quad_clippings[arrays.polylines[3][2] as usize];
    let rows = &arrays.triangle_clippings;
    let has = |post: &[u32]| vertices.contains(&[post[0], post[1]]);
    while !has(&rows[at as usize][..2]) {
        at = rows[at as usize][14];
    }
    let mut found = Vec::new();
    while at != u32::MAX {
        let row = &rows[at as usize];
        let crossing = |number: u32| arrays.crossings.get(number as usize).copied();
        found.push(Piece {
            triangle: RightTriangle {
                apex: [row[0], row[1]],
                left: [row[2], row[3]],
                right: [row[4], row[5]],
            },
            entrance: crossing(row[10]),
            vertices: (row[8]..row[9]).map(|k| (first_vertex + k - start) as usize).collect(),
            exit: crossing(row[11]),
        });
        at = if row[13] == u32::MAX || has(&row[6..8]) { row[12] } else { row[13] };
    }
    assert_eq!(found, expected);
    // The larger quad has the end of the second line too.
    assert_eq!(arrays.vertices.len(), 2 * 100 + 1);
    assert_eq!(arrays.crossings.len(), arrays.directions.len());
    // The finest exit descendant is left where the clipping is left, and is no one's parent.
    assert!(rows.iter().all(|row| rows[row[15] as usize][11] == row[11]));
    assert!(rows.iter().all(|row| rows.iter().all(|other| other[14] != row[15])));
}
