//! Draws a scene that no file says, and tells how right it is: `cargo run --release --example scene_in_code`
#![allow(clippy::print_stdout, reason = "a program may print")]

use drapery::glam::DVec2;
use drapery::scene::{Camera, Cap, Color, Feature, Join, Layer, Line, Posts, Shape, Style, Surface, Width};
use drapery::space::{Plan, World};
use drapery::{Budget, Image, Limits, Result, Scene, Stage, Technique, Truth, Verdict, expected};

/// Posts a side, and metres between two.
const POSTS: usize = 65;
const CELL: f64 = 20.0;

/// A dome 150 m high around the origin.
fn terrain() -> Result<Surface> {
    let place = |k: usize| (k as f64 - (POSTS / 2) as f64) * CELL;
    let height = |k: usize| {
        let (x, y) = (place(k % POSTS), place(k / POSTS));
        150.0 / (1.0 + (x * x + y * y) / 90_000.0)
    };
    let heights = (0..POSTS * POSTS).map(height).collect();
    let steps = (DVec2::new(CELL, 0.0), DVec2::new(0.0, CELL));
    Ok(Surface::Grid(Posts::new((POSTS, POSTS), Plan::new(place(0), place(0)), steps, heights)?))
}

/// A road over it.
fn roads() -> Layer {
    let color = Color::from_rgba8([255, 127, 0, 255]);
    let line = Line { color, width: Width::Metres(15.0), join: Join::Round, cap: Cap::Butt };
    let way =
        [(-500.0, -450.0), (-100.0, -200.0), (50.0, 100.0), (450.0, 300.0)].map(|(x, y)| Plan::new(x, y));
    let road = Feature { index: 0, style: 0, shape: Shape::Line(vec![way.to_vec()]) };
    Layer::uniform("roads", Style { line: Some(line), ..Style::default() }, vec![road])
}

fn main() -> Result<()> {
    let camera = Camera::new(World::new(0.0, -1200.0, 700.0), World::new(0.0, 0.0, 50.0));
    let mut scene = Scene::new(camera, vec![roads()]);
    (scene.image.width, scene.image.height) = (300, 200);
    let stage = Stage::new(scene, terrain()?)?;
    let truth = Truth::of(&stage, &Budget::default())?;
    for technique in Technique::ALL {
        let picture = Image::from_rgba8(&technique.draw(&stage)?.image)?;
        let verdict = Verdict::on(&picture, &expected(&truth)?, Limits::new(1.0 / 255.0, 0)?);
        println!("{}: {verdict}", technique.name());
    }
    Ok(())
}
