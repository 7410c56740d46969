//! Pictures -> what they say of a machine.

use super::drawing::{Picture, Way};
use super::pictures::pictures;
use super::sheet::Sheet;
use super::table::{Finding, text};
use super::{answers, weights};
use crate::error::{Error, Result};
use std::path::Path;

/// The `[device]` table that a folder's pictures stand for, as the text of a TOML file.
///
/// # Errors
/// When there is no picture, one cannot be read or has another size, or pictures contradict themselves or one another.
pub fn read(folder: &Path) -> Result<String> {
    let mut findings = Findings::default();
    let mut count = 0;
    for picture in pictures() {
        let path = folder.join(format!("{}.png", picture.name));
        if !path.exists() {
            findings.notes.push(format!("Not seen: {}.png.", picture.name));
            continue;
        }
        count += 1;
        findings.add(&picture, &Sheet::read(&path, picture.side)?)?;
    }
    if count == 0 {
        return Err(Error::usage("there is no picture of a calibration here")
            .in_file(folder)
            .help("`drapery calibrate export -o DIR` tells which to draw"));
    }
    findings.settle()?;
    Ok(text(&findings.found, &findings.notes))
}

/// What has been found so far.
#[derive(Debug, Default)]
pub(super) struct Findings {
    found: Vec<Finding>,
    notes: Vec<String>,
    /// By edges, and by what is interpolated between them.
    bits: Option<u32>,
    interpolated: Option<answers::Corners>,
}

impl Findings {
    fn add(&mut self, picture: &Picture, sheet: &Sheet) -> Result<()> {
        match picture.way {
            Way::Flat => {
                let edges = answers::edges(sheet)?;
                self.notes.push(edges.owners);
                self.bits = edges.bits;
                match edges.bits {
                    Some(bits) => self.find("subpixel_bits", imitated(bits).to_string(), edges.seen),
                    None => self.notes.push(edges.seen),
                }
            }
            Way::Samples(count) => self.notes.push(answers::samples(sheet, count)?),
            Way::Depth | Way::DepthReversed => {
                if self.found.iter().any(|finding| finding.key == "depth") {
                    return Err(sheet.contradiction(
                        "there is a picture for each direction of depth, and a renderer has one",
                    ));
                }
                let (format, seen) = answers::depth(sheet, picture.way == Way::DepthReversed)?;
                self.find("depth", format!("{format:?}"), seen);
            }
            Way::Interpolated => self.interpolated = Some(answers::corners(sheet)?),
            Way::Filtered => {
                for (key, bands, what) in [("filter_bits", 0, "texels"), ("level_bits", 2, "levels")] {
                    let bits = weights::bits(sheet, bands)?;
                    let seen = match bits {
                        0 => format!(
                            "filter: weights of {what} have no steps that were seen (12 bits or more)."
                        ),
                        _ => format!("filter: weights of {what} are multiples of 2^-{bits}."),
                    };
                    self.find(key, bits.to_string(), seen);
                }
            }
        }
        Ok(())
    }

    /// Compares what edges say of snapping with what is interpolated.
    fn settle(&mut self) -> Result<()> {
        let (word, seen, bits) = match (self.interpolated.clone(), self.bits) {
            (None, _) => return Ok(()),
            (Some(answers::Corners::Unsnapped), bits) => (
                "unsnapped",
                "interpolation: as if corners were not moved, at all places that were tried.".to_owned(),
                bits,
            ),
            (Some(answers::Corners::Snapped(by)), Some(bits)) if by != bits => {
                return Err(Error::usage(format!(
                    "the pictures contradict one another: edges are snapped to 2^-{bits} pixels, what is interpolated to 2^-{by}"
                ))
                .help("draw both with the same device and settings"));
            }
            (Some(answers::Corners::Snapped(by)), bits) => {
                let seen = format!(
                    "interpolation: from corners that are multiples of 2^-{by} pixels, at all places that were tried."
                );
                if bits.is_none() {
                    self.find("subpixel_bits", imitated(by).to_string(), seen.clone());
                }
                ("snapped", seen, Some(by))
            }
        };
        if bits != Some(0) {
            self.find("interpolation", format!("{word:?}"), seen);
        }
        Ok(())
    }

    fn find(&mut self, key: &'static str, value: String, seen: String) {
        self.found.push(Finding { key, value, seen });
    }
}

/// The sub-pixel bits of those that are imitated which are nearest.
fn imitated(bits: u32) -> u32 {
    match bits {
        0 | 10.. => 0,
        6..=9 => 8,
        _ => 4,
    }
}
