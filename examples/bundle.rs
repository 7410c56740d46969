//! Makes a bundle for a program on a GPU: `cargo run --release --example bundle -- scene.toml folder`
//!
//! The folder's `README.md` tells what is where: mesh, features, matrices, the picture of stencil volumes with all buffers, and what each
//! pixel may be.
#![allow(clippy::print_stdout, reason = "a program may print")]

use drapery::{Bundle, Error, Result, Technique};

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [scene, folder] = &arguments[..] else {
        return Err(Error::usage("a scene and a folder are needed").help("bundle SCENE FOLDER"));
    };
    let scene = drapery::open(scene)?;
    let hash = &scene.text.file.hash;
    Bundle { hash, ..Bundle::of(&scene.stage, Technique::StencilVolume) }.write_to(folder)?;
    println!("what is where: {folder}/README.md");
    Ok(())
}
