//! The goldens of this project hold; and a golden that does not is found out, by name, whatever is wrong with it.
#![cfg(feature = "render")]
#![allow(clippy::unwrap_used, reason = "helpers of tests are no tests to the lint")]

use drapery::buffer::Buffer;
use drapery::golden::{Failure, Fault, Selection, bless, check};
use drapery::output::write_png;
use drapery::technique::Kind;
use std::fs;
use std::path::{Path, PathBuf};

const SCENE: &str = r##"
schema = 1
image = { width = 24, height = 20 }
camera = { eye = [0, -300, 200], target = [0, 0, 10] }
terrain.generate = { kind = "cone", posts = [9, 9], cell_m = 30.0, height_m = 60.0 }
[[layer]]
features = [{ line = [[-100, -80], [0, 0], [110, 40]] }]
line = { color = "#ff7f00", width_m = 20 }
"##;
const PICTURE: &str = "a/one.inverse-projection.png";

/// A folder of one blessed golden, `a/one`, and what is done to it then.
fn blessed(then: impl Fn(&Path)) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("a")).unwrap();
    write(folder.path(), "a/one.toml", SCENE);
    assert!(bless(folder.path(), &Selection::default(), &|_| {}).unwrap().is_change());
    then(folder.path());
    folder
}

fn write(folder: &Path, name: &str, text: &str) {
    fs::write(folder.join(name), text).unwrap();
}

/// Replaces text in a file, where it must be.
fn edit(folder: &Path, name: &str, from: &str, to: &str) {
    let text = fs::read_to_string(folder.join(name)).unwrap();
    assert!(text.contains(from), "{text}");
    write(folder, name, &text.replacen(from, to, 1));
}

fn failures(folder: &tempfile::TempDir) -> Vec<Failure> {
    check(folder.path(), &Selection::default(), &|_| {}).unwrap().failures
}

/// The only failure of inverse projection, or of no technique.
fn failure(folder: &tempfile::TempDir) -> Failure {
    let mut found = failures(folder);
    found.retain(|f| f.technique.as_deref().is_none_or(|name| name == Kind::InverseProjection.name()));
    let said: Vec<String> = found.iter().map(Failure::to_string).collect();
    assert_eq!(found.len(), 1, "{said:#?}");
    found.remove(0)
}

/// How many pictures a case has: the truth's and those of all techniques but dynamic lines, as no width is in pixels.
const PICTURES: usize = Kind::ALL.len();

/// The failures' cases and names, those that several techniques share told once.
fn names(folder: &tempfile::TempDir) -> Vec<String> {
    let mut names: Vec<String> =
        failures(folder).iter().map(|f| format!("{} {}", f.case, f.fault.name())).collect();
    names.dedup();
    names
}

/// Changes a byte of the hash that the manifest has of a buffer.
fn forge(folder: &Path, buffer: &str) {
    let manifest = fs::read_to_string(folder.join("manifest.toml")).unwrap();
    let from = manifest.find("technique = \"inverse-projection\"").unwrap();
    let start = from + manifest[from..].find(&format!("buffer = \"{buffer}\", blake3 = \"")).unwrap();
    let at = start + manifest[start..].find("blake3 = \"").unwrap() + 10;
    let other = if manifest.as_bytes()[at] == b'0' { "1" } else { "0" };
    write(folder, "manifest.toml", &format!("{}{other}{}", &manifest[..at], &manifest[at + 1..]));
}

#[test]
fn every_golden_of_this_project_holds() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("golden");
    let checked = check(&folder, &Selection::default(), &|_| {}).unwrap();
    let said: Vec<String> = checked.failures.iter().map(Failure::to_string).collect();
    assert!(said.is_empty(), "{said:#?}");
    assert!(checked.replayed >= 20, "{}", checked.replayed);
}

#[test]
fn the_goldens_of_this_project_stay_small() {
    fn bytes(folder: &Path) -> u64 {
        let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
        entries.map(|e| if e.path().is_dir() { bytes(&e.path()) } else { e.metadata().unwrap().len() }).sum()
    }
    assert!(bytes(&Path::new(env!("CARGO_MANIFEST_DIR")).join("golden")) < 8 << 20);
}

#[test]
fn what_was_blessed_holds_and_blessing_it_again_changes_nothing() {
    let folder = blessed(|_| {});
    assert_eq!(names(&folder), [""; 0]);
    let manifest = fs::read(folder.path().join("manifest.toml")).unwrap();
    let again = bless(folder.path(), &Selection::default(), &|_| {}).unwrap();
    assert_eq!((again.is_change(), again.unchanged), (false, PICTURES));
    assert_eq!(fs::read(folder.path().join("manifest.toml")).unwrap(), manifest);
}

#[test]
fn a_scene_that_draws_otherwise_is_told_with_its_first_buffer_and_the_picture() {
    let wider = blessed(|folder| edit(folder, "a/one.toml", "width_m = 20", "width_m = 24"));
    let found = failure(&wider);
    let Fault::Differs { buffer, verdict, .. } = &found.fault else { panic!("{found}") };
    assert_eq!(buffer, "class", "nothing before it depends on a line");
    assert!(verdict.as_ref().is_some_and(|verdict| !verdict.passed()));
    assert!(found.to_string().contains("pixels differ, by at most"), "{found}");

    let lower = blessed(|folder| edit(folder, "a/one.toml", "height_m = 60.0", "height_m = 59.0"));
    let found = failure(&lower);
    assert!(matches!(&found.fault, Fault::Differs { buffer, .. } if buffer == "depth"), "{found}");
}

#[test]
fn a_forged_hash_is_told_by_its_buffer() {
    for buffer in ["depth", "triangle", "plan", "quad", "class", "edges", "color", "image"] {
        let folder = blessed(|folder| forge(folder, buffer));
        let found = failure(&folder);
        assert!(matches!(&found.fault, Fault::Differs { buffer: first, .. } if first == buffer), "{found}");
        assert!(found.to_string().contains("no pixel differs"), "{found}");
    }
    let both = blessed(|folder| {
        forge(folder, "class");
        forge(folder, "triangle");
    });
    assert!(failure(&both).to_string().contains("first buffer that differs is `triangle`"));
}

#[test]
fn a_stored_picture_with_one_other_pixel_or_another_size_or_that_is_none_is_told() {
    let stored = |width, height, pixel: [u8; 4]| {
        move |folder: &Path| {
            let image = image::open(folder.join(PICTURE)).unwrap().into_rgba8();
            let mut values: Vec<[u8; 4]> = image.as_raw().as_chunks().0.to_vec();
            values.resize(width * height, [0; 4]);
            values[30] = pixel;
            let mut file = Vec::new();
            write_png(&Buffer::from_values(width, height, values), &mut file).unwrap();
            fs::write(folder.join(PICTURE), file).unwrap();
        }
    };
    let found = failure(&blessed(stored(24, 20, [1, 2, 3, 255])));
    assert!(matches!(&found.fault, Fault::OtherPicture { .. }), "{found}");
    assert!(found.to_string().contains("1 pixels differ"), "{found}");
    let found = failure(&blessed(stored(24, 21, [1, 2, 3, 255])));
    assert!(
        found.to_string().contains("other-picture") && found.to_string().contains("another size"),
        "{found}"
    );
    let found = failure(&blessed(|folder| write(folder, PICTURE, "no picture")));
    assert_eq!(found.fault.name(), "refused");
    let found = failure(&blessed(|folder| fs::remove_file(folder.join(PICTURE)).unwrap()));
    assert_eq!(found.fault.name(), "no-picture");
}

#[test]
fn another_size_is_told() {
    let folder = blessed(|folder| edit(folder, "a/one.toml", "height = 20", "height = 21"));
    let found = failure(&folder);
    assert!(matches!(found.fault, Fault::Size { expected: (24, 20), actual: (24, 21) }), "{found}");
}

#[test]
fn what_belongs_to_nothing_is_told_and_blessing_removes_it() {
    let folder = blessed(|folder| {
        write(folder, "a/two.toml", SCENE);
        write(folder, "a/gone.inverse-projection.png", "");
        write(folder, "a/imagery.png", "");
        edit(
            folder,
            "manifest.toml",
            "[[golden]]",
            "[[golden]]\ncase = \"b/lost\"\ntechnique = \"t\"\nsize = [1, 1]\nhashes = []\n\n[[golden]]",
        );
    });
    assert_eq!(names(&folder), ["b/lost no-case", "a/gone orphan-picture", "a/two no-entry"]);
    let done = bless(folder.path(), &Selection::default(), &|_| {}).unwrap();
    assert_eq!(done.added.len(), PICTURES);
    assert!(done.added.contains(&"a/two by inverse-projection".to_owned()));
    assert_eq!(done.removed, ["b/lost by t", "a/gone.inverse-projection.png"]);
    assert_eq!((done.changed.len(), done.unchanged), (0, PICTURES));
    assert_eq!(names(&folder), [""; 0]);
    assert!(folder.path().join("a/imagery.png").exists());
}

#[test]
fn an_entry_of_a_technique_that_does_not_draw_the_case_is_told() {
    let folder = blessed(|folder| {
        edit(
            folder,
            "manifest.toml",
            "[[golden]]",
            "[[golden]]\ncase = \"a/one\"\ntechnique = \"aaa\"\nsize = [1, 1]\nhashes = []\n\n[[golden]]",
        );
    });
    assert_eq!(names(&folder), ["a/one no-case"]);
    let only = Selection::new(Some("a/one"), (1, 1)).unwrap();
    assert_eq!(bless(folder.path(), &only, &|_| {}).unwrap().removed, ["a/one by aaa"]);
    assert_eq!(names(&folder), [""; 0]);
}

#[test]
fn a_scene_that_cannot_be_drawn_is_a_failure_and_is_not_blessed() {
    let folder = blessed(|folder| edit(folder, "a/one.toml", "schema = 1", "schema = 1\nnonsense = 2"));
    let found = failure(&folder);
    assert!(found.to_string().contains("refused") && found.to_string().contains("nonsense"), "{found}");
    let before = fs::read(folder.path().join("manifest.toml")).unwrap();
    assert!(bless(folder.path(), &Selection::default(), &|_| {}).is_err());
    assert_eq!(fs::read(folder.path().join("manifest.toml")).unwrap(), before);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "nothing else is left");
}

#[test]
fn a_variant_that_changes_what_it_must_not_is_told_and_not_blessed() {
    let variant = |set: &str, more: &str| {
        let text = format!("[[variant]]\nname = \"v\"\nset = [\"{set}\"]\n{more}\n");
        blessed(move |folder| write(folder, "a/one.golden.toml", &text))
    };
    let samples = "technique.inverse-projection.samples=2";
    let folder = variant(samples, "");
    assert!(
        failure(&folder)
            .to_string()
            .contains("variant-differs: `v` must change nothing, and changes `color`")
    );
    assert!(bless(folder.path(), &Selection::default(), &|_| {}).is_err());
    assert_eq!(names(&variant(samples, "buffers = [\"class\", \"edges\"]")), [""; 0]);
    assert_eq!(names(&variant(samples, "techniques = [\"another\"]")), [""; 0]);
    assert_eq!(names(&variant("technique.inverse-projection.samples=3", "")), [""; 0]);
    assert_eq!(names(&variant("image.width=-1", "")), ["a/one refused"]);
}

#[test]
fn overrides_of_a_golden_draw_it() {
    let folder = blessed(|folder| write(folder, "a/one.golden.toml", "set = [\"image.height=10\"]"));
    assert_eq!(names(&folder), ["a/one another-size"]);
    bless(folder.path(), &Selection::default(), &|_| {}).unwrap();
    assert_eq!(names(&folder), [""; 0]);
}

#[test]
fn what_is_not_selected_stays_as_it_is() {
    let folder = blessed(|folder| {
        edit(folder, "a/one.toml", "width_m = 20", "width_m = 24");
        write(folder, "a/two.toml", SCENE);
    });
    let only = Selection::new(Some("*two"), (1, 1)).unwrap();
    let done = bless(folder.path(), &only, &|_| {}).unwrap();
    assert_eq!((done.added.len(), done.changed.len(), done.removed.len()), (PICTURES, 0, 0));
    assert_eq!(names(&folder), ["a/one differs"]);
    assert_eq!(check(folder.path(), &only, &|_| {}).unwrap().failures.len(), 0);
}

#[test]
fn a_folder_without_goldens_and_settings_without_a_scene_are_refused() {
    let empty = tempfile::tempdir().unwrap();
    let said = check(empty.path(), &Selection::default(), &|_| {}).unwrap_err();
    assert!(said.what().contains("no golden is selected"), "{said}");
    assert!(check(&empty.path().join("none"), &Selection::default(), &|_| {}).is_err());
    let folder = blessed(|folder| write(folder, "a/thre.golden.toml", ""));
    let said = check(folder.path(), &Selection::default(), &|_| {}).unwrap_err();
    assert!(said.to_string().contains("thre.golden.toml: there is no scene of these settings"), "{said}");
}
