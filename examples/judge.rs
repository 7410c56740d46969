//! Judges a picture by another, or a frame by a bundle: `cargo run --example judge -- expected.png actual.png`
//!
//! Below is the same as a test, the way a renderer's own tests call it (`cargo test --example judge`). It needs none of this crate's
//! features: `drapery = { version = "0.1", default-features = false }` under `[dev-dependencies]`.
#![allow(clippy::print_stdout, reason = "a program may print")]

use drapery::compare::Judgement;
use drapery::{Error, Expected, Gates, Image, Judge, Limits, Result, Verdict};
use std::path::Path;
use std::process::ExitCode;

/// A picture may be off by two steps of an 8-bit code, and by more in ten pixels.
fn judge(expected: &Path, actual: &Path) -> Result<Verdict> {
    let expected = Expected::exactly(Image::read(expected)?);
    Ok(Verdict::on(&Image::read(actual)?, &expected, Limits::new(2.0 / 255.0, 10)?))
}

/// A frame, or a folder with `T.png` and buffers, may be what any right program draws from a bundle of `drapery export`.
fn judge_by_bundle(bundle: &Path, frame: &Path) -> Result<Judgement> {
    let judge = Judge::read(bundle)?;
    Ok(judge.judge(&judge.frame(frame)?, Gates::default()))
}

fn main() -> Result<ExitCode> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [expected, actual] = &arguments[..] else {
        return Err(
            Error::usage("two pictures, or a bundle and a frame, are needed").help("judge EXPECTED ACTUAL")
        );
    };
    let (expected, actual): (&Path, &Path) = (expected.as_ref(), actual.as_ref());
    let (passed, verdict) = if expected.is_dir() {
        let judgement = judge_by_bundle(expected, actual)?;
        (judgement.passed(), judgement.to_string())
    } else {
        let verdict = judge(expected, actual)?;
        (verdict.passed(), verdict.to_string())
    };
    println!("{verdict}");
    Ok(if passed { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

#[cfg(test)]
mod tests {
    use super::*;
    use drapery::buffer::{Buffer, Plane, Values};
    use drapery::output::{Batch, Npy, write_png, write_whole};

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

    #[test]
    fn my_frame_is_what_a_bundle_allows() {
        let folder = tempfile::tempdir().unwrap();
        let [bundle, mine] = ["bundle", "mine.png"].map(|name| folder.path().join(name));
        export(&bundle);
        draw(&mine, 0);
        let judgement = judge_by_bundle(&bundle, &mine).unwrap();
        assert!(judgement.passed(), "{judgement}");
        draw(&mine, 1);
        assert!(!judge_by_bundle(&bundle, &mine).unwrap().passed());
    }

    /// What `drapery export` does instead: a bundle that allows a grey picture.
    fn export(folder: &Path) {
        let mut batch = Batch::into(folder).unwrap();
        let mut files = Vec::new();
        let mut stage = |name: &str, bytes: &[u8]| {
            let hash = blake3::hash(bytes).to_hex();
            files.push(serde_json::json!({ "name": name, "bytes": bytes.len(), "blake3": hash.as_str() }));
            batch.stage(name, |file| file.write_all(bytes)).unwrap();
        };
        let (mut picture, mut table, mut runs) = (Vec::new(), Vec::new(), Vec::new());
        write_png(&Buffer::from_values(16, 16, vec![[128, 128, 128, 255]; 256]), &mut picture).unwrap();
        let empty = |width| Plane { name: "t", width, height: 0, components: 1, values: Values::U32(vec![]) };
        Npy::new(&empty(9)).unwrap().write(&mut table).unwrap();
        Npy::new(&empty(5)).unwrap().write(&mut runs).unwrap();
        let allowed = r#"{ "schema": 1, "technique": "mine", "width": 16, "height": 16, "picture": "mine.png", "stages": [],
            "features": "runs.npy", "hypotheses": [{ "name": "as-set", "says": "all is grey", "lo": "mine.png", "hi": "mine.png",
            "choices": "table.npy", "extremes": "table.npy" }] }"#;
        stage("allowed.json", allowed.as_bytes());
        stage("mine.png", &picture);
        stage("runs.npy", &runs);
        stage("table.npy", &table);
        let manifest = serde_json::json!({ "schema": 1, "kind": "bundle", "files": files }).to_string();
        batch.stage("manifest.json", |file| file.write_all(manifest.as_bytes())).unwrap();
        batch.commit().unwrap();
    }
}
