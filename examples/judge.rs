//! Judges a picture by another: `cargo run --example judge -- expected.png actual.png`
//!
//! Below is the same as a test, the way a renderer's own tests call it (`cargo test --example judge`). It needs none of this crate's
//! features: `drapery = { version = "0.1", default-features = false }` under `[dev-dependencies]`.
#![allow(clippy::print_stdout, reason = "a program may print")]

use drapery::{Error, Expected, Image, Limits, Result, Verdict};
use std::path::Path;
use std::process::ExitCode;

/// A picture may be off by two steps of an 8-bit code, and by more in ten pixels.
fn judge(expected: &Path, actual: &Path) -> Result<Verdict> {
    let expected = Expected::exactly(Image::read(expected)?);
    Ok(Verdict::on(&Image::read(actual)?, &expected, Limits::new(2.0 / 255.0, 10)?))
}

fn main() -> Result<ExitCode> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [expected, actual] = &arguments[..] else {
        return Err(Error::usage("two pictures are needed").help("judge EXPECTED ACTUAL"));
    };
    let verdict = judge(expected.as_ref(), actual.as_ref())?;
    println!("{verdict}");
    Ok(if verdict.passed() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

#[cfg(test)]
mod tests {
    use super::*;
    use drapery::buffer::Buffer;
    use drapery::output::{write_png, write_whole};

    /// What your renderer does instead: a grey picture with so many white pixels.
    fn draw(path: &Path, white: usize) {
        let pixel = |k| if k < white { [255; 4] } else { [128, 128, 128, 255] };
        let picture = Buffer::from_values(16, 16, (0..256).map(pixel).collect());
        write_whole(path, |file| write_png(&picture, file)).unwrap();
    }

    #[test]
    fn my_renderer_draws_what_is_expected() {
        let folder = tempfile::tempdir().unwrap();
        let [golden, mine] = ["golden.png", "mine.png"].map(|name| folder.path().join(name));
        draw(&golden, 0);
        draw(&mine, 10);
        let verdict = judge(&golden, &mine).unwrap();
        assert!(verdict.passed(), "{verdict}");
        draw(&mine, 11);
        assert!(!judge(&golden, &mine).unwrap().passed());
    }
}
