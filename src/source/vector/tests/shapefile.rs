//! Shapefiles that editing has left with gaps, stale records, wrong lengths and deleted rows.

use super::attributes::dbf;
use super::*;

/// A square with its lower left corner at (at, 0), as a record's content.
fn square(at: f64) -> Vec<u8> {
    shp_parts(5, &[&SQUARE.map(|(x, y)| (x + at, y))])
}

/// A .shp whose body is these pieces, and the .shx of those that are marked as records.
struct Laid {
    shp: Vec<u8>,
    shx: Vec<u8>,
}

enum Piece {
    /// A record by its number; the .shx lists it.
    Record(u32, f64),
    /// A record that the .shx does not list.
    Stale(u32, f64),
    Bytes(Vec<u8>),
}

fn laid(pieces: &[Piece]) -> Laid {
    let mut body = Vec::new();
    let mut entries = Vec::new();
    for piece in pieces {
        let (number, at) = match piece {
            Piece::Bytes(bytes) => {
                body.extend(bytes);
                continue;
            }
            Piece::Record(number, at) | Piece::Stale(number, at) => (number, at),
        };
        let content = square(*at);
        if let Piece::Record(..) = piece {
            entries.push((*number, (100 + body.len()) as u32 / 2, content.len() as u32 / 2));
        }
        body.extend(number.to_be_bytes());
        body.extend((content.len() as u32 / 2).to_be_bytes());
        body.extend(content);
    }
    entries.sort_unstable();
    let entries: Vec<[u32; 2]> = entries.into_iter().map(|(_, at, length)| [at, length]).collect();
    let mut shp = [&shp(5, &[])[..], &body].concat();
    set_length(&mut shp);
    Laid { shp, shx: shx(&entries) }
}

fn shx(entries: &[[u32; 2]]) -> Vec<u8> {
    let mut out = shp(5, &[]);
    out.extend(entries.iter().flatten().flat_map(|word| word.to_be_bytes()));
    set_length(&mut out);
    out
}

#[test]
#[ignore = "writes the seeds for fuzzing into $DRAPERY_SEEDS"]
fn seeds_for_fuzzing_shapefiles_with_gaps() {
    let pieces =
        [Piece::Record(2, 0.0), Piece::Bytes(vec![0; 52]), Piece::Stale(1, 5.0), Piece::Record(1, 9.0)];
    let Laid { shp, shx } = laid(&pieces);
    seeds::plant("vector_shapefile/gaps", [seeds::beside(&shp, &[("shx", &shx)])]);
}

fn set_length(file: &mut [u8]) {
    let words = file.len() as u32 / 2;
    state(file, words);
}

fn state(file: &mut [u8], words: u32) {
    file[24..28].copy_from_slice(&words.to_be_bytes());
}

/// The left edges of the squares that are read, and the notes but the one of the missing .prj.
fn squares(shp: &[u8], shx: Option<&[u8]>, table: Option<&[u8]>) -> (Vec<f64>, Vec<String>) {
    let (_folder, path) = file("a.shp", shp);
    shx.into_iter().for_each(|bytes| std::fs::write(path.with_extension("shx"), bytes).unwrap());
    table.into_iter().for_each(|bytes| std::fs::write(path.with_extension("dbf"), bytes).unwrap());
    let read = super::read(&path, None).unwrap();
    let edges = (0..read.features.len()).map(|at| polygon_of(&read, at)[0][0].x).collect();
    (edges, read.notes.into_iter().filter(|note| !note.contains(".prj")).collect())
}

fn table(rows: usize) -> Vec<u8> {
    dbf(0, &[("A", b'N', 1, 0)], &vec![&b"1"[..]; rows])
}

#[test]
fn a_gap_of_zeros_is_passed_over_by_the_index_and_without_one() {
    let gap = || Piece::Bytes(vec![0; 52]);
    let Laid { shp, shx } = laid(&[Piece::Record(1, 0.0), gap(), Piece::Record(2, 10.0), gap()]);
    let (edges, notes) = squares(&shp, Some(&shx), None);
    assert_eq!(edges, [0.0, 10.0]);
    assert_eq!(notes, ["104 bytes of zeros between the records of the .shp are passed over"]);
    assert_eq!(squares(&shp, None, None), (edges, notes));
}

#[test]
fn an_index_that_is_consistent_is_followed_over_stale_records() {
    let pieces =
        [Piece::Record(1, 0.0), Piece::Stale(2, 99.0), Piece::Record(3, 20.0), Piece::Record(2, 10.0)];
    let Laid { shp, shx } = laid(&pieces);
    let (edges, notes) = squares(&shp, Some(&shx), None);
    assert_eq!(edges, [0.0, 10.0, 20.0]);
    assert_eq!(notes, ["136 bytes of the .shp belong to no record by its .shx index and are passed over"]);
    let (edges, _) = squares(&shp, Some(&shx), Some(&table(3)));
    assert_eq!(edges, [0.0, 10.0, 20.0], "so the .dbf says too");
    let (edges, notes) = squares(&shp, None, None);
    assert_eq!(edges.len(), 4);
    assert!(notes[0].starts_with("from feature 3 on the records are not numbered"), "{notes:?}");
}

#[test]
fn stale_bytes_that_are_no_record_are_passed_over_by_the_index_alone() {
    let junk = || Piece::Bytes(vec![0xab; 52]);
    let Laid { shp, shx } = laid(&[Piece::Record(1, 0.0), junk(), Piece::Record(2, 10.0)]);
    assert_eq!(squares(&shp, Some(&shx), None).0, [0.0, 10.0]);
    assert!(refusal("a.shp", &shp).contains("feature 1"));
}

#[test]
fn a_feature_without_a_shape_may_have_an_entry_of_zeros() {
    let Laid { shp, .. } = laid(&[Piece::Record(1, 0.0), Piece::Record(3, 20.0)]);
    let (edges, notes) = squares(&shp, Some(&shx(&[[50, 64], [0, 0], [118, 64]])), None);
    assert_eq!((edges, notes.join("")), (vec![0.0, 20.0], "1 geometry without coordinates left out".into()));
}

#[test]
fn an_index_that_is_not_consistent_is_not_followed_and_that_is_said() {
    let Laid { shp, .. } = laid(&[Piece::Record(1, 0.0), Piece::Record(2, 10.0), Piece::Record(3, 20.0)]);
    let wrong: [&[[u32; 2]]; 4] = [
        &[[50, 64], [119, 64], [186, 64]], // into a record
        &[[50, 64], [118, 63], [186, 64]], // another length
        &[[50, 64], [50, 64], [186, 64]],  // the same twice
        &[[50, 64], [118, 64], [9999, 64]],
    ];
    for entries in wrong {
        let (edges, notes) = squares(&shp, Some(&shx(entries)), None);
        assert_eq!(edges, [0.0, 10.0, 20.0], "{entries:?}");
        assert!(notes[0].contains("is not used"), "{notes:?}");
    }
    let short = shx(&[[50, 64], [186, 64]]);
    assert_eq!(squares(&shp, Some(&short), None).0, [0.0, 20.0], "what it says is consistent");
    assert_eq!(squares(&shp, Some(&short), Some(&table(2))).0, [0.0, 20.0]);
    let (edges, notes) = squares(&shp, Some(&short), Some(&table(3)));
    assert_eq!(edges, [0.0, 10.0, 20.0], "the .dbf has a row for each");
    assert!(notes[0].contains("is not used"), "{notes:?}");
}

#[test]
fn a_header_with_a_wrong_length_loses_no_record() {
    let Laid { shp: whole, shx } = laid(&[Piece::Record(1, 0.0), Piece::Record(2, 10.0)]);
    let (bytes, rows) = (whole.len() as u32, table(2));
    // Nothing, the header alone, in a record, at the end of one, in bytes and not words; too much.
    for (words, needs_witness) in [
        (0, false),
        (50, false),
        (60, false),
        (118, false),
        (bytes, false),
        (bytes / 2 + 7, true),
        (u32::MAX / 2, true),
    ] {
        let mut shp = whole.clone();
        state(&mut shp, words);
        for (shx, table) in
            [(None, None), (Some(&shx[..]), None), (None, Some(&rows[..])), (Some(&shx), Some(&rows))]
        {
            if needs_witness && shx.is_none() && table.is_none() {
                assert!(refusal("a.shp", &shp).contains("before the end that its header states"));
                continue;
            }
            let (edges, notes) = squares(&shp, shx, table);
            assert_eq!(edges, [0.0, 10.0], "{words} {notes:?}");
            assert!(
                notes.concat().contains(&format!("the header states {} bytes", words * 2)) || words > bytes,
                "{notes:?}"
            );
            assert_eq!(notes.len(), 1, "{notes:?}");
        }
    }
}

#[test]
fn what_lies_behind_the_stated_end_is_left_alone_where_the_table_does_not_know_it() {
    let Laid { mut shp, .. } = laid(&[Piece::Record(1, 0.0), Piece::Record(2, 10.0)]);
    state(&mut shp, 118);
    let (edges, notes) = squares(&shp, None, Some(&table(1)));
    assert_eq!(edges, [0.0]);
    assert_eq!(notes, ["136 bytes after the end that the header states are not read"]);
    shp.truncate(240);
    assert_eq!(squares(&shp, None, None).0, [0.0], "half a record");
}

#[test]
fn records_that_the_table_marks_as_deleted_are_left_out_whether_or_not_a_column_is_read() {
    let Laid { shp, shx } = laid(&[Piece::Record(1, 0.0), Piece::Record(2, 10.0), Piece::Record(3, 20.0)]);
    let mut rows = table(3);
    let second = rows.len() - 4;
    rows[second] = b'*';
    let (edges, notes) = squares(&shp, Some(&shx), Some(&rows));
    assert_eq!(
        (edges, notes),
        (vec![0.0, 20.0], vec!["1 feature left out, marked as deleted in the .dbf".into()])
    );
    // dBASE 7 lays out its fields otherwise, not its rows.
    rows[0] = 4;
    assert_eq!(squares(&shp, Some(&shx), Some(&rows)).0, [0.0, 20.0]);
    let (edges, notes) = squares(&shp, Some(&shx), Some(&table(2)));
    assert_eq!(edges, [0.0, 10.0, 20.0]);
    assert!(notes[0].contains("2 rows and the .shp 3 features"), "{notes:?}");
}

#[test]
fn a_row_that_is_cut_off_is_said_where_no_column_is_read() {
    let Laid { shp, .. } = laid(&[Piece::Record(1, 0.0)]);
    let rows = table(1);
    let (edges, notes) = squares(&shp, None, Some(&rows[..rows.len() - 1]));
    assert_eq!(edges, [0.0]);
    assert!(notes[0].starts_with("which records are deleted is not known: "), "{notes:?}");
}
