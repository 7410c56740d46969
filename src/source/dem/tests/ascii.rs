//! Esri ASCII grids and what is wrong with them.

use super::super::{CrsHint, DemOptions, describe, read};
use super::{posts, read_bytes, window, with_file};
use crate::space::Plan;
use crate::{Error, Position};
use glam::DVec2;

const GRID: &str =
    "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 2\nNODATA_value -1\n1 2 3\n4 -1 6\n";

fn error(text: &str) -> Error {
    read_bytes("a.asc", text.as_bytes(), &DemOptions::default()).unwrap_err()
}

fn place(error: &Error) -> Option<(usize, usize)> {
    error.position().map(|Position { line, column, .. }| (line, column))
}

#[test]
fn corners_and_centres_may_be_mixed() {
    for (text, first) in [
        (GRID.to_owned(), Plan::new(11.0, 21.0)),
        (GRID.replace("xllcorner", "XLLCENTER"), Plan::new(10.0, 21.0)),
        (GRID.replace("corner", "center"), Plan::new(10.0, 20.0)),
        (GRID.replace("cellsize 2", "dx 2 dy 4"), Plan::new(11.0, 22.0)),
    ] {
        let posts = posts(read_bytes("a.asc", text.as_bytes(), &DemOptions::default()).unwrap());
        assert_eq!(posts.first, first, "{text}");
        assert_eq!(posts.east(), DVec2::new(2.0, 0.0));
        assert_eq!(posts.heights()[..1], [4.0]);
        assert_eq!(posts.heights()[2..], [6.0, 1.0, 2.0, 3.0]);
        assert!(posts.heights()[1].is_nan());
    }
}

#[test]
fn any_white_space_will_do() {
    let text = GRID.replace('\n', "\r\n\t ").replace("1 2 3", "1\n2\n\n3");
    assert!(read_bytes("a.asc", text.as_bytes(), &DemOptions::default()).is_ok());
}

#[test]
fn nodata_is_minus_9999_unless_said_otherwise() {
    let text = GRID.replace("NODATA_value -1\n", "").replace("-1", "-9999");
    let summary = with_file("a.asc", text.as_bytes(), |p| describe(&p, &DemOptions::default())).unwrap();
    assert_eq!((summary.nodata_count, summary.heights), (1, Some([1.0, 6.0])));
}

#[test]
fn a_window_cuts_the_grid() {
    let posts = posts(read_bytes("a.asc", GRID.as_bytes(), &window([11.0, 21.0, 12.5, 23.0])).unwrap());
    assert_eq!((posts.columns(), posts.rows()), (2, 2));
}

#[test]
fn the_prj_file_beside_it_gives_the_crs() {
    let wkt = "PROJCS[\"Lambert\"]";
    let dem = with_file("a.asc", GRID.as_bytes(), |path| {
        std::fs::write(path.with_extension("prj"), wkt).unwrap();
        read(&path, &DemOptions::default()).unwrap()
    });
    assert_eq!(dem.crs_hint, Some(CrsHint::Wkt(wkt.into())));
}

#[test]
fn errors_name_line_and_column() {
    for (from, to, at, expected) in [
        ("4 -1 6", "4 x1 6", (8, 3), "`x1` is not a height"),
        ("4 -1 6", "4 1,5 6", (8, 3), "decimals with a point"),
        ("4 -1 6", "4 1e999 6", (8, 3), "not a height"),
        ("4 -1 6", "4 5", (9, 1), "after 5 of the 6 heights"),
        ("4 -1 6", "4 5 6 77", (8, 7), "`77` comes after the 6 heights"),
        ("cellsize", "celsize", (5, 1), "did you mean `cellsize`?"),
        ("cellsize 2", "cellsize two", (5, 10), "`two`, which is no number"),
        ("ncols 3", "ncols 3\nncols 3", (2, 1), "twice"),
        ("ncols 3", "ncols 2.5", (1, 1), "not a count"),
    ] {
        let error = error(&GRID.replace(from, to));
        assert_eq!(place(&error), Some(at), "{error}");
        assert!(error.to_string().contains(expected), "{error}");
    }
}

#[test]
fn headers_without_sense_are_refused() {
    for (from, to, expected) in [
        ("cellsize 2", "cellsize 0", "not above 0"),
        ("cellsize 2", "cellsize -2", "not above 0"),
        ("cellsize 2", "cellsize nan", "not above 0"),
        ("cellsize 2", "cellsize inf", "not a finite number"),
        ("cellsize 2\n", "", "lacks `dx` or `cellsize`"),
        ("xllcorner 10\n", "", "lacks `xllcorner` or `xllcenter`"),
        ("ncols 3", "ncols 1000000000", "can hold"),
        ("ncols 3", "ncols 4000000000", "absurdly many"),
        ("ncols 3", "ncols 1", "2 x 2"),
        ("1 2 3\n4 -1 6\n", "", "before the first height"),
    ] {
        let error = error(&GRID.replace(from, to)).to_string();
        assert!(error.contains(expected) && error.contains("a.asc"), "{error}");
    }
}

#[test]
fn a_word_may_stand_for_no_data() {
    for (word, there) in
        [("*", "*"), ("NA", "na"), ("null", "NULL"), ("nan", "NaN"), ("-1.#IND", "-1.#ind"), ("--", "--")]
    {
        for heights in [format!("1 2 3\n4 {there} 6\n"), format!("{there} 2 3\n4 5 6\n")] {
            let text = GRID.replace("-1\n1 2 3\n4 -1 6\n", &format!("{word}\n{heights}"));
            let summary = with_file("a.asc", text.as_bytes(), |p| describe(&p, &DemOptions::default()));
            let summary = summary.unwrap_or_else(|error| panic!("{word}: {error}"));
            assert_eq!(summary.nodata_count, 1, "{text}");
            assert_eq!(summary.nodata.as_deref().map(str::to_lowercase), Some(word.to_lowercase()));
        }
    }
    // Not a key, a number misspelled, or a word that nobody declares.
    let wrong = |nodata: &str, height: &str| {
        error(
            &GRID
                .replace("NODATA_value -1", &format!("NODATA_value {nodata}"))
                .replace("4 -1", &format!("4 {height}")),
        )
    };
    assert!(wrong("ncols", "5").what().contains("`nodata_value` is followed by `ncols`"));
    assert!(wrong("-9999,0", "5").what().contains("which is no number"));
    assert!(wrong("*", "NA").what().contains("`NA` is not a height"));
    assert!(wrong("-1", "*").what().contains("`*` is not a height"));
}
