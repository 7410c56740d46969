use super::*;
use crate::compare::{Difference, Image};
use crate::scene_file::SceneFile;
use crate::stage::Stage;
use crate::truth::{self, Budget};

const SCENE: &str = r##"
    schema = 1
    image = { width = 48, height = 32, background = "#dce9f2" }
    camera = { eye = [0, -1500, 700], target = [0, 0, 50] }
    terrain.generate = { kind = "fbm", seed = 3, posts = [33, 33], cell_m = 40.0, height_m = 200.0 }
    terrain.shade = "hillshade"
    terrain.color = "#c8b89a"
    [[layer]]
    features = [{ polygon = [[-400, -300], [300, -350], [200, 300], [-300, 200]] }]
    fill = { color = "#3388ff", opacity = 0.6 }
    outline = { color = "#003366", width_m = 30, mode = "inset" }
    [[layer]]
    features = [{ line = [[-600, -100], [0, 100], [600, -50]] }]
    line = { color = "#ff7f00", width_m = 40, join = "miter", cap = "square" }
    [[layer]]
    features = [{ line = [[-600, -300], [100, 0], [500, 250]] }]
    line = { color = "#cc00cc", width_px = 3, join = "round", cap = "round" }
"##;

fn stage() -> Stage {
    let file = SceneFile::parse(SCENE, None, &[]).unwrap();
    let (scene, surface) = crate::source::load::load(&file, &|_| {}).unwrap();
    Stage::new(scene, surface).unwrap()
}

fn sampled(stage: &Stage, n: usize) -> Sampled {
    sample(stage, &stage.view().unwrap(), n, &|_| {})
}

#[test]
fn many_samples_come_near_the_truth() {
    let stage = stage();
    let truth = truth::certify(&stage, &stage.view().unwrap(), &Budget::default(), &|_| {});
    let expected = crate::measure::expected(&truth).unwrap();
    let rmse = |n| {
        let colors = sampled(&stage, n).colors.values().as_flattened().to_vec();
        let image = Image::new(48, 32, 4, colors).unwrap();
        Difference::of(&expected, &image).unwrap().metrics(0.0).rmse
    };
    let [one, four, sixteen] = [1, 4, 16].map(rmse);
    assert!(one > 0.02 && four < 0.3 * one && sixteen < 0.2 * four, "{one} {four} {sixteen}");
    assert!(sixteen < 0.002, "{sixteen}");
}

#[test]
fn a_sample_alone_is_judged_as_one_among_many() {
    let stage = stage();
    // Blocks of one pixel hold other samples together than blocks of 256.
    let whole = sampled(&stage, 2);
    let size = PixelSize::of(&stage.view().unwrap(), &stage.mesh);
    let footprints = Footprints::new(&stage.draw_list, size, &|_| true);
    let view = stage.view().unwrap();
    let sampler = Sampler::new((&stage, &stage.mesh), &view, &footprints, 2);
    let mut nearby = Nearby::default();
    for [x, y] in [[0, 0], [20, 16], [24, 17], [30, 20], [11, 19]] {
        let seen = sampler.see(&TilePlace { corner: [x, y], size: [1, 1] });
        let mut last = sampler.backdrop.no_ground();
        let mut sum = Paint::CLEAR;
        for at in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            nearby.find_all(&footprints, seen.plan(at.0, at.1));
            sum = sum.plus(sampler.paint(&seen, at, &nearby, &mut last));
        }
        let color = sampler.backdrop.compositor.encoded(sum.divided_by(4.0));
        assert_eq!(color, *whole.colors.at(x, y), "{x} {y}");
    }
}
