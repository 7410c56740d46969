//! Several files as one terrain.

use super::super::{Dem, DemOptions, read_together};
use super::posts;
use super::tiff_writer::{Kind, Tiff, Values};
use crate::space::Plan;
use std::path::PathBuf;

/// A surface over the whole plan.
fn height(x: f64, y: f64) -> f64 {
    3.0 * x + y * 0.5
}

/// A TIFF of a cell of 10 whose first post stands at a place.
fn tile(size: (usize, usize), (x, y): (f64, f64), raised: f64) -> Tiff {
    let mut tiff =
        Tiff::new(size, Kind::F64, |c, r| height(x + 10.0 * c as f64, y - 10.0 * r as f64) + raised);
    tiff.tags[1] = (33922, Values::Doubles(vec![0.5, 0.5, 0.0, x, y, 0.0]));
    tiff.tags.push((34735, Values::Shorts(vec![1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 32633])));
    tiff
}

fn together(tiles: &[Tiff], options: &DemOptions) -> crate::Result<Dem> {
    let folder = tempfile::tempdir().unwrap();
    let paths: Vec<PathBuf> = (0..tiles.len()).map(|i| folder.path().join(format!("{i}.tif"))).collect();
    paths.iter().zip(tiles).for_each(|(path, tiff)| std::fs::write(path, tiff.bytes()).unwrap());
    read_together(&paths, options)
}

/// Four tiles that share the posts on their seams.
fn four() -> [Tiff; 4] {
    [(0.0, 100.0), (40.0, 100.0), (0.0, 60.0), (40.0, 60.0)].map(|at| tile((5, 5), at, 0.0))
}

fn assert_is_the_surface(dem: Dem, size: (usize, usize)) {
    let posts = posts(dem);
    assert_eq!((posts.columns(), posts.rows()), size);
    for (i, j) in (0..size.0).flat_map(|i| (0..size.1).map(move |j| (i, j))) {
        let at = posts.world(i, j);
        assert_eq!(at.z, height(at.x, at.y), "post ({i}, {j})");
    }
}

#[test]
fn tiles_with_equal_seams_are_one_surface_in_any_order() {
    let [a, b, c, d] = four();
    for tiles in [[a.clone(), b.clone(), c.clone(), d.clone()], [d, b, a, c]] {
        let dem = together(&tiles, &DemOptions::default()).unwrap();
        assert_eq!(format!("{:?}", dem.crs_hint), "Some(Epsg(32633))");
        assert_eq!(dem.notes, ["4 files as one grid of 9 x 9 posts"]);
        assert_is_the_surface(dem, (9, 9));
    }
}

#[test]
fn a_window_across_the_seams_reads_that_part() {
    let options = DemOptions { window: Some([25.0, 45.0, 55.0, 75.0]), ..DemOptions::default() };
    let dem = together(&four(), &options).unwrap();
    let first = match &dem.surface {
        crate::scene::Surface::Grid(posts) => posts.first,
        crate::scene::Surface::Points(_) | crate::scene::Surface::Globe(_) => panic!("a grid was expected"),
    };
    assert_eq!(first, Plan::new(20.0, 40.0));
    assert_is_the_surface(dem, (5, 5));
}

#[test]
fn seams_that_differ_are_averaged_and_told() {
    let tiles = [tile((5, 5), (0.0, 100.0), 0.0), tile((5, 5), (40.0, 100.0), 2.0)];
    let [a, b] = [[0, 1], [1, 0]].map(|order| {
        let dem = together(&order.map(|i| tiles[i].clone()), &DemOptions::default()).unwrap();
        let told = "5 of the 5 heights where files meet differ, by up to 2 m";
        assert!(dem.notes.iter().any(|n| n.contains(told)), "{:?}", dem.notes);
        posts(dem)
    });
    let bits = |posts: &crate::scene::Posts| posts.heights().iter().map(|h| h.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&a), bits(&b));
    assert_eq!(a.world(4, 2).z, height(40.0, 80.0) + 1.0);
    assert_eq!((a.world(3, 2).z, a.world(5, 2).z), (height(30.0, 80.0), height(50.0, 80.0) + 2.0));
}

#[test]
fn a_void_on_a_seam_is_filled_by_the_neighbour_and_gaps_have_no_posts() {
    let mut left = tile((5, 5), (0.0, 100.0), 0.0);
    left.nodata = Some("-1");
    left.samples[4] = -1.0;
    let far = tile((5, 5), (100.0, 40.0), 0.0);
    let dem = together(&[left, tile((5, 5), (40.0, 100.0), 0.0), far], &DemOptions::default()).unwrap();
    let posts = posts(dem);
    assert_eq!((posts.columns(), posts.rows()), (15, 11));
    assert_eq!(posts.world(4, 10).z, height(40.0, 100.0));
    assert_eq!(posts.world(14, 0).z, height(140.0, 0.0));
    assert_eq!(posts.heights().iter().filter(|h| h.is_finite()).count(), 25 + 20 + 25);
}

#[test]
fn files_that_do_not_fit_together_are_refused_by_name() {
    let first = || tile((5, 5), (0.0, 100.0), 0.0);
    let beside = || tile((5, 5), (40.0, 100.0), 0.0);
    let other_crs = {
        let mut tiff = beside();
        tiff.tags.pop();
        tiff.tags.push((34735, Values::Shorts(vec![1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 32634])));
        tiff
    };
    let coarser = {
        let mut tiff = beside();
        tiff.tags[0] = (33550, Values::Doubles(vec![20.0, 20.0, 0.0]));
        tiff
    };
    let placeless = {
        let mut tiff = beside();
        tiff.tags.drain(..2);
        tiff
    };
    let shifted = tile((5, 5), (43.0, 100.0), 0.0);
    for (second, expected, help) in [
        (other_crs, "another CRS", "gdalwarp -t_srs CRS FILES... OUT.tif"),
        (coarser, "another grid", "gdalwarp -r bilinear -tr X Y FILES... OUT.tif"),
        (shifted, "another grid", "gdalwarp"),
        (placeless, "place", "world file"),
    ] {
        let message = together(&[first(), second], &DemOptions::default()).unwrap_err().to_string();
        let is_told = [expected, help].iter().all(|words| message.contains(words));
        assert!(message.contains("1.tif") && is_told, "{message}");
    }
    let far = tile((5, 5), (1e7, 1e7), 0.0);
    let message = together(&[first(), far], &DemOptions::default()).unwrap_err().to_string();
    assert!(message.contains("window"), "{message}");
    let bounds = DemOptions { bounds: Some([0.0, 0.0, 1.0, 1.0]), ..DemOptions::default() };
    assert!(together(&[first(), beside()], &bounds).unwrap_err().to_string().contains("`bounds`"));
}
