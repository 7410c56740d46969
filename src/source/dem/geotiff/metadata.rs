//! What GDAL's metadata tag says of a band: scale, offset and unit.
//!
//! Source: GDAL's documentation of its GeoTIFF driver.

use super::super::vertical::VerticalUnit;
use super::super::xml;
use super::tags::{Directory, Source, tag};
use crate::error::{Error, Result};
use std::io::{Read, Seek};

/// What is said of a band.
#[derive(Debug, Default)]
pub(super) struct Metadata {
    /// Factor and offset from samples to heights.
    pub(super) scaling: Option<(f64, f64)>,
    pub(super) unit: Option<VerticalUnit>,
    /// What the user should know.
    pub(super) note: Option<String>,
}

impl Metadata {
    /// What the tag says of a band, counted from 0.
    pub(super) fn read<R: Read + Seek>(
        directory: &Directory,
        source: &mut Source<R>,
        band: usize,
    ) -> Result<Self> {
        match directory.text(source, tag::GDAL_METADATA)? {
            Some(text) if !text.trim().is_empty() => Self::of(&text, band),
            _ => Ok(Self::default()),
        }
    }

    fn of(text: &str, band: usize) -> Result<Self> {
        let Ok(document) = xml::parse(text) else {
            let note = "its metadata is damaged: a scale or a unit that it may state is not followed".into();
            return Ok(Self { note: Some(note), ..Self::default() });
        };
        let band = band.to_string();
        let item = |role: &str| {
            let mut items = document.root_element().children();
            let item = items.find(|item| {
                let is_of_band = item.attribute("sample") == Some(&band);
                is_of_band && item.attribute("role").is_some_and(|r| r.eq_ignore_ascii_case(role))
            })?;
            Some(item.text().unwrap_or_default().trim())
        };
        let number = |role: &str| item(role).map(|text| finite(role, text)).transpose();
        let (factor, offset) = (number("scale")?, number("offset")?);
        let scaling = (factor.unwrap_or(1.0), offset.unwrap_or(0.0));
        Ok(Self {
            scaling: (factor.is_some() || offset.is_some()).then_some(scaling),
            unit: item("unittype").and_then(VerticalUnit::of_word),
            note: None,
        })
    }
}

fn finite(role: &str, text: &str) -> Result<f64> {
    xml::finite(text).ok_or_else(|| {
        Error::new(format!("the {role} `{text}` that the file's metadata states is no number"))
            .help("set it anew: gdal_edit.py -scale 1 -offset 0 FILE")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn items(items: &str, band: usize) -> Result<Metadata> {
        Metadata::of(&format!("<GDALMetadata>{items}</GDALMetadata>"), band)
    }

    #[test]
    fn a_band_has_its_own_scale_offset_and_unit() {
        let text = r#"<Item name="SCALE" sample="1" role="scale">0.5</Item><Item name="x">7</Item>
            <Item name="UNITTYPE" sample="0" role="unittype">ft</Item>"#;
        let (first, second) = (items(text, 0).unwrap(), items(text, 1).unwrap());
        assert_eq!((first.scaling, first.unit.map(|u| u.metres())), (None, Some(0.3048)));
        assert_eq!((second.scaling, second.unit), (Some((0.5, 0.0)), None));
    }

    #[test]
    fn a_scale_that_is_no_number_is_refused_and_damaged_xml_is_told() {
        for wrong in ["abc", "", "inf", "1,5"] {
            let text = format!(r#"<Item name="SCALE" sample="0" role="scale">{wrong}</Item>"#);
            let message = items(&text, 0).unwrap_err().to_string();
            assert!(message.contains(&format!("scale `{wrong}`")), "{message}");
        }
        assert!(Metadata::of("<GDALMetadata><Item", 0).unwrap().note.unwrap().contains("damaged"));
    }
}
