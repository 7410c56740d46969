//! Tests of the terrain readers on files that they make themselves.

mod archive;
mod ascii;
mod frames;
mod geotiff;
mod hgt;
mod masks;
mod pictures;
mod png;
mod robustness;
mod tiff_writer;
mod together;
mod units;
mod vrt;
mod xyz;

use super::{Dem, DemOptions};
use crate::scene::{Posts, Surface};
use std::path::PathBuf;

/// Writes a file into a folder of its own and hands over its path.
fn with_file<T>(name: &str, bytes: &[u8], then: impl FnOnce(PathBuf) -> T) -> T {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    then(path)
}

fn read_bytes(name: &str, bytes: &[u8], options: &DemOptions) -> crate::Result<Dem> {
    with_file(name, bytes, |path| super::read(&path, options))
}

fn posts(dem: Dem) -> Posts {
    match dem.surface {
        Surface::Grid(posts) => posts,
        Surface::Points(_) | Surface::Globe(_) => panic!("a grid was expected"),
    }
}

fn window(window: [f64; 4]) -> DemOptions {
    DemOptions { window: Some(window), ..DemOptions::default() }
}

/// The message of a refusal, which must name the file.
fn refusal(name: &str, bytes: &[u8], options: &DemOptions) -> String {
    let message = read_bytes(name, bytes, options).unwrap_err().to_string();
    assert!(message.contains(name), "{message}");
    message
}
