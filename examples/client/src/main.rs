//! Draws a bundle of `drapery export` on a GPU, as its README says.

// The crate's rules for equal bits on all machines do not hold here.
#![allow(clippy::disallowed_methods, clippy::disallowed_types)]

mod bundle;
mod clipmap;
mod decal;
mod dynamic;
mod frame;
mod geometry;
mod gl;
mod inverse;
mod overlay;
mod statics;
mod stencil;
mod tables;
mod write;

use std::path::Path;

fn run() -> Result<(), String> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [bundle, out, more @ ..] = &words[..] else {
        return Err("usage: drapery-client BUNDLE FRAMES [--bug NAME] [--float]".into());
    };
    let bug = more.iter().skip_while(|word| *word != "--bug").nth(1).map_or("", String::as_str);
    let float = more.iter().any(|word| word == "--float");
    eprintln!("{}", gl::open()?);
    let bundle = bundle::Bundle::open(Path::new(bundle))?;
    std::fs::create_dir_all(out).map_err(|error| format!("{out}: {error}"))?;
    let samples = bundle.number(&["settings", "samples"]).unwrap_or(1.0) as usize;
    match bundle.technique() {
        "stencil-volume" => {
            let frame = frame::Frame::new(&bundle, bug, samples, 0, float)?;
            frame.terrain()?;
            stencil::draw(&frame)?;
            frame.save(Path::new(out))
        }
        "inverse-projection" => {
            let frame = frame::Frame::new(&bundle, bug, 1, 1, float)?;
            frame.terrain()?;
            inverse::draw(&frame)?;
            frame.save(Path::new(out))
        }
        "static-decal" => {
            let mut frame = frame::Frame::new(&bundle, bug, 1, 0, float)?;
            decal::draw(&mut frame)?;
            frame.save(Path::new(out))
        }
        "dynamic-line" => {
            let mut frame = frame::Frame::new(&bundle, bug, 1, 0, float)?;
            dynamic::draw(&mut frame)?;
            frame.save(Path::new(out))
        }
        "clipmap" => {
            let mut frame = frame::Frame::new(&bundle, bug, 1, 0, float)?;
            clipmap::draw(&mut frame)?;
            frame.save(Path::new(out))
        }
        "geometry-overlay" => {
            let frame = frame::Frame::new(&bundle, bug, 1, 0, float)?;
            overlay::draw(&frame)?;
            frame.save(Path::new(out))
        }
        other => Err(format!("this client does not draw {other}")),
    }
}

fn main() {
    if let Err(error) = run() {
        eprintln!("drapery-client: {error}");
        std::process::exit(1);
    }
}
