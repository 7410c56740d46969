//! What the files of a bundle hold and how a client draws the same, for people: `common.md` and `judge.md`, which all bundles have, the part that
//! its technique has written beside its code (`client.md`), and what is so in this bundle: the device, the settings, the buffers.

use crate::buffer::{Plane, Values};
use crate::parameter::{Settings, TableShape, Value};
use crate::scene::Device;
use crate::stage::Stage;
use crate::technique::Kind;
use std::fmt::Write;

/// What is where, and how colours are composed.
const COMMON: &str = include_str!("common.md");

/// How a client's picture is judged.
const JUDGE: &str = include_str!("judge.md");

/// The `README.md` of a bundle of a technique, whose frame has these buffers; `is_elsewhere`: which of them are written in another way.
pub(super) fn readme(
    stage: &Stage,
    kind: Kind,
    planes: &[Plane],
    is_elsewhere: &dyn Fn(&str) -> bool,
) -> String {
    let declaration = kind.declaration();
    let mut text =
        format!("# {}: a scene for a GPU client, and the pictures that are right\n\n", declaration.title);
    let _ = write!(text, "Technique T of this bundle: `{}`. {}\n\n", kind.name(), declaration.paper);
    add_device(&mut text, &stage.scene.device);
    text += COMMON;
    text.push('\n');
    text += declaration.client;
    add_buffers(&mut text, kind, planes.iter().filter(|plane| !is_elsewhere(plane.name)));
    for parameters in std::iter::once(&declaration.parameters).chain(declaration.further) {
        let _ = write!(text, "\n## Settings: `technique.{}`\n\n", parameters.name);
        add_values(&mut text, parameters.table, &(parameters.values)(&stage.scene.technique));
    }
    text.push('\n');
    text + JUDGE
}

/// Whom the pictures are of, which a client has to know before all else.
fn add_device(text: &mut String, device: &Device) {
    text.push_str("## The device that this bundle is for\n\n");
    text.push_str(if device.is_exact() {
        "No device is imitated: visibility is decided by **exact mathematics**. The frame of a right client differs from these pictures at samples \
         that lie nearer to an edge than its device moves them (with 8 sub-pixel bits a few of a thousand). For pictures of the device at hand \
         export with `--device`.\n\n"
    } else {
        "The technique's pictures and buffers here (not the truth's) are those of **the device below**, imitated. On another device a right client \
         differs from them at samples that lie near an edge: export with another `--device`.\n\n"
    });
    add_values(text, Device::TABLE, &device.values());
    add_others(text, Device::TABLE, &device.values());
    text.push_str(
        "\nWhat an imitated device does: vertices go to clip space by `clip_from_world`, composed in double precision and rounded to `precision`; sums are from left to \
         right, without fused operations. Screen positions are snapped to 2^-`subpixel_bits` pixels, to nearest, ties to even. Depth is clamped and interpolated linearly on the screen. \
         With all defaults none of this is done.\n\n",
    );
}

/// A row for each key of a table: what it is here, and what that means.
fn add_values(text: &mut String, table: &TableShape, values: &[(&'static str, Value)]) {
    text.push_str("| setting | here | what it is | where |\n| --- | --- | --- | --- |\n");
    for key in table.keys {
        let Some((_, value)) = values.iter().find(|(name, _)| *name == key.name) else { continue };
        let meaning = match value {
            Value::Word(word) => key.shape.meaning(word),
            _ => None,
        };
        let meaning = meaning.map(|meaning| format!(" Here: {meaning}")).unwrap_or_default();
        let section = key.section.unwrap_or("");
        let _ = writeln!(text, "| `{}` | `{value}` | {}{meaning} | {section} |", key.name, key.doc);
    }
}

/// Of keys with words, those that do not stand here.
fn add_others(text: &mut String, table: &TableShape, values: &[(&'static str, Value)]) {
    text.push_str("\nWhat else they may say:\n\n");
    for key in table.keys {
        let Some((_, Value::Word(own))) = values.iter().find(|(name, _)| *name == key.name) else { continue };
        for word in key.shape.choices().into_iter().filter(|word| word != own) {
            let meaning = key.shape.meaning(word).unwrap_or("");
            let _ = writeln!(text, "- `{} = \"{word}\"`: {meaning}", key.name);
        }
    }
}

/// What there is of each buffer in this bundle.
fn add_buffers<'p>(text: &mut String, kind: Kind, planes: impl Iterator<Item = &'p Plane>) {
    text.push_str(
        "\nIn this bundle:\n\n| file | numbers | rows x columns (x components) |\n| --- | --- | --- |\n",
    );
    for Plane { name, width, height, components, values } in planes {
        let numbers = match values {
            Values::F64(_) => "f64",
            Values::F32(_) => "f32",
            Values::U32(_) => "u32",
            Values::U16(_) => "u16",
            Values::U8(_) => "u8",
        };
        let more = if *components > 1 { format!(" x {components}") } else { String::new() };
        let _ = writeln!(text, "| `{}.{name}.npy` | {numbers} | {height} x {width}{more} |", kind.name());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Precision;

    fn stage() -> Stage {
        crate::Opened::parse(crate::tutorial::SMALL_SCENE).unwrap().stage
    }

    fn written(kind: Kind, change: impl FnOnce(&mut Stage)) -> String {
        let mut stage = stage();
        change(&mut stage);
        readme(&stage, kind, &[], &|_| false)
    }

    #[test]
    fn every_setting_stands_there_with_its_value_and_what_that_value_means() {
        for kind in Kind::ALL {
            let text = written(kind, |_| {});
            for (name, value) in kind.parameters(&stage().scene.technique) {
                assert!(text.contains(&format!("| `{name}` | `{value}` |")), "{}: {name}", kind.name());
            }
        }
        let text = written(Kind::StencilVolume, |_| {});
        assert!(text.contains("| `joins` | `\"none\"` | How the segments of a line meet; \"style\": as `join` and `cap` say. Here: Each segment is a box of its own and nothing more (4.1). | Schneider & Klein 4.1 |"), "{text}");
    }

    #[test]
    fn what_there_is_of_a_buffer_stands_there_with_its_type_and_its_shape() {
        let values = Values::U16(vec![0; 6 * 4]);
        let plane = Plane { name: "stencil", width: 6, height: 4, components: 1, values };
        let left_out = Plane { name: "tiles", ..plane.clone() };
        let text = readme(&stage(), Kind::StencilVolume, &[plane, left_out], &|name| name == "tiles");
        assert!(text.contains("| `stencil-volume.stencil.npy` | u16 | 4 x 6 |"), "{text}");
        assert!(!text.contains("stencil-volume.tiles.npy"));
    }

    #[test]
    fn lines_in_pixels_stand_there_with_the_settings_of_the_decals_that_they_are_composed_with() {
        assert!(written(Kind::DynamicLine, |_| {}).contains("## Settings: `technique.static-decal`"));
    }

    #[test]
    fn every_buffer_of_a_technique_has_a_row_in_its_part() {
        for kind in Kind::ALL {
            let (_, rows) = kind.declaration().client.split_once("\n## Buffers\n").unwrap();
            let first_cells: Vec<&str> =
                rows.lines().filter_map(|line| line.strip_prefix("| ")?.split(" | ").next()).collect();
            for plane in kind.declaration().planes {
                let name = format!("`{}`", plane.name);
                let has_row = first_cells.iter().any(|cell| cell.split(", ").any(|word| word == name));
                assert!(has_row, "{}: {name}", kind.name());
            }
        }
    }

    #[test]
    fn the_device_comes_before_all_else_and_says_whether_it_is_one() {
        let exact = written(Kind::Clipmap, |_| {});
        let single = written(Kind::Clipmap, |stage| stage.scene.device.precision = Precision::F32);
        for text in [&exact, &single] {
            assert_eq!(
                text.lines().find(|line| line.starts_with("## ")),
                Some("## The device that this bundle is for")
            );
        }
        assert!(exact.contains("exact mathematics") && exact.contains("| `precision` | `\"f64\"` |"));
        assert!(exact.contains("\n- `depth = \"unorm24\"`: 24-bit fixed point"), "{exact}");
        assert!(!exact.contains("\n- `precision = \"f64\"`"), "what stands in the table is no other value");
        assert!(single.contains("**the device below**") && single.contains("| `precision` | `\"f32\"` |"));
    }
}
