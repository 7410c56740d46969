//! Frames: how a file's columns and rows turn east and north, and what is missing.

use super::super::frame::Frame;
use super::super::grid::{RowSink, Sheet};
use super::super::{DemOptions, read};
use super::refusal;
use crate::space::Plan;
use glam::DVec2;
use std::path::Path;

#[test]
fn mirrored_and_south_up_rasters_are_turned() {
    for (dx, dy) in [(1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        let (column, row) = (DVec2::new(dx, 0.0), DVec2::new(0.0, dy));
        let frame = Frame::new((3, 2), DVec2::new(50.0, 70.0), (column, row)).unwrap();
        let mut sheet = Sheet::new(&frame, frame.whole()).unwrap();
        for r in 0..2 {
            let line: Vec<_> =
                (0..3).map(|c| frame.at(c as f64, r as f64).dot(DVec2::new(1.0, 100.0))).collect();
            sheet.take(r, 0, &line);
        }
        let posts = sheet.finish(&mut Vec::new()).unwrap();
        assert_eq!((posts.east(), posts.north()), (DVec2::X, DVec2::Y));
        for (i, j) in [(0, 0), (2, 0), (1, 1)] {
            let at = posts.world(i, j);
            assert_eq!(at.z, at.x + 100.0 * at.y);
        }
        let [x0, y0, ..] = frame.bounds();
        assert_eq!(posts.first, Plan::new(x0, y0));
    }
}

#[test]
fn missing_files_and_directories_are_refused() {
    let options = DemOptions::default();
    let missing = read(Path::new("no/such/file.tif"), &options).unwrap_err().to_string();
    assert!(missing.contains("no/such/file.tif") && missing.contains("check the path"), "{missing}");
    let folder = tempfile::tempdir().unwrap();
    let message = read(folder.path(), &options).unwrap_err().to_string();
    assert!(message.contains("directory"), "{message}");
}

#[test]
fn wrong_beginnings_and_unknown_kinds_are_refused() {
    let options = DemOptions::default();
    for (name, bytes, expected) in [
        ("a.tif", &b"<html>oops</html>"[..], "does not begin like one"),
        ("a.tif", b"", "empty"),
        ("a.hgt", b"PK\x03\x04....", "half a download"),
        ("a.tif", b"\xfd7zXZ\0..", "xz -dk"),
        ("a.dted", b"UHL1....", "unknown"),
        ("N43E006.hgt", b"12345678", "1201"),
        ("a.hgt", &[0; 2 * 1201 * 1201], "N43E006"),
    ] {
        let message = refusal(name, bytes, &options);
        assert!(message.contains(expected), "{message}");
        assert!(message.contains("help"), "{message}");
    }
}
