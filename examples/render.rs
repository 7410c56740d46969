//! Renders a scene file: `cargo run --release --example render -- scene.toml picture.png`
#![allow(clippy::print_stderr, reason = "a program may print")]

use drapery::output::{write_png, write_whole};
use drapery::{Error, Result, Technique};
use std::path::Path;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [scene, picture] = &arguments[..] else {
        return Err(Error::usage("two files are needed").help("render SCENE PICTURE"));
    };
    let scene = drapery::open(scene)?;
    for note in scene.notes() {
        eprintln!("note: {note}");
    }
    let frame = Technique::InverseProjection.draw(&scene.stage)?;
    write_whole(Path::new(picture), |file| write_png(&frame.image, file))
}
