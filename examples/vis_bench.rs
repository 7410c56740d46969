use drapery::raster::Lattice;
use drapery::scene::{Diagonal, Posts, Surface};
use drapery::space::{Plan, ViewFrame, Viewpoint, World};
use drapery::terrain::Mesh;
use drapery::visibility;
use glam::{DVec2, DVec3};
fn main() {
    let threads: usize = std::env::args().nth(1).map_or(2, |v| v.parse().unwrap());
    let tile: usize = std::env::args().nth(2).map_or(128, |v| v.parse().unwrap());
    let only: usize = std::env::args().nth(3).map_or(0, |v| v.parse().unwrap());
    for n in [40usize, 224, 1001, 2001] {
        if only != 0 && only != n {
            continue;
        }
        let bytes = std::fs::read(format!("/tmp/peers/h{n}.f32")).unwrap();
        let heights: Vec<f64> = bytes
            .chunks(4)
            .map(|b| f64::from(f32::from_le_bytes(b.try_into().unwrap())))
            .collect();
        let s = 1.0 / (n - 1) as f64;
        let posts = Posts::new((n, n), Plan::new(0.0, 0.0), (DVec2::X * s, DVec2::Y * s), heights).unwrap();
        let t = std::time::Instant::now();
        let mesh = Mesh::new(Surface::Grid(posts), Diagonal::NwSe).unwrap();
        let prep = t.elapsed();
        let view = Viewpoint {
            eye: World::new(0.5, -0.3, 0.42),
            target: World::new(0.5, 0.42, 0.05),
            up: DVec3::Z,
            near: 0.05,
            far: f64::INFINITY,
        };
        let frame = ViewFrame::perspective(&view, 50.0, (1920, 1080)).unwrap();
        let lattice = Lattice::centres(&frame, 0);
        drapery::parallel::with_threads(threads, || {
            let mut times = vec![];
            let mut visible = visibility::Visible::new(&lattice, tile);
            let mut counts = None;
            let mut covered = 0;
            let mut mean = 0.0;
            for _ in 0..9 {
                let t = std::time::Instant::now();
                visible.see(&frame, &mesh);
                times.push(t.elapsed().as_secs_f64() * 1e3);
                let (ids, keys, c) = (visible.triangles(), visible.keys(), visible.counts());
                covered = ids.iter().filter(|i| **i != u32::MAX).count();
                mean = keys
                    .iter()
                    .filter(|k| k.is_finite())
                    .map(|k| {
                        let d = 1.0 / f64::from(*k);
                        let (n, f) = (0.05, 4.0);
                        ((f + n) / (f - n) - 2.0 * f * n / (f - n) / d) * 0.5 + 0.5
                    })
                    .sum::<f64>()
                    / covered as f64;
                counts = Some(c);
            }
            times.sort_by(f64::total_cmp);
            println!(
                "{n} prep {prep:?} median {:.2} min {:.2} ms covered {:.4} meandepth {mean:.6} {counts:?}",
                times[4],
                times[0],
                covered as f64 / (1920.0 * 1080.0)
            );
        })
        .unwrap();
    }
}
