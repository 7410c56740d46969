//! What GDAL keeps of a raster beside it, in `FILE.aux.xml`: CRS, place, and of each band nodata, unit, scale and offset.
//!
//! What it says wins over what the file says: it was written later.

use super::geo_keys::CrsHint;
use super::site::Site;
use super::vertical::VerticalUnit;
use super::xml;
use crate::error::{Error, Result};
use roxmltree::Node;

/// The longest file that is read: it may hold a colour table or histograms.
const LONGEST: u64 = 1 << 24;

/// What is said of a raster and its band.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Sidecar {
    pub(super) crs: Option<CrsHint>,
    /// The map from columns and rows: `x = a + b c + d r`, `y = e + f c + g r`.
    pub(super) place: Option<[f64; 6]>,
    /// The value that means no data.
    pub(super) nodata: Option<f64>,
    pub(super) unit: Option<VerticalUnit>,
    /// Factor and offset from samples to heights.
    pub(super) scaling: Option<(f64, f64)>,
    /// Whether the samples are indices into a table of colours.
    pub(super) is_palette: bool,
}

impl Sidecar {
    /// What lies beside a file; nothing where nothing does.
    pub(super) fn beside(site: &Site, band: usize) -> Result<Self> {
        let Some(file) = site.with_ending(".aux.xml")? else {
            return Ok(Self::default());
        };
        let read = || {
            let text = file.text(LONGEST)?;
            let document = xml::parse(&text)?;
            Self::of(document.root_element(), "PAMRasterBand", band)
        };
        read().map_err(|error| {
            error
                .in_file(file.path())
                .help("it says what GDAL knows of the file beside it: correct or remove it")
        })
    }

    /// Refuses a picture of palette indices: they are no heights.
    pub(super) fn refuse_picture(&self) -> Result<()> {
        if !self.is_palette {
            return Ok(());
        }
        Err(Error::new("the file is a picture: its samples are indices into a palette, not heights")
            .help("name the file of heights that belongs to it"))
    }

    /// What a dataset of GDAL's XML says of itself and of a band.
    pub(super) fn of(dataset: Node<'_, '_>, band_tag: &str, band: usize) -> Result<Self> {
        let number = band.to_string();
        let mut bands = dataset.children().filter(|n| n.has_tag_name(band_tag));
        let band = bands.find(|n| n.attribute("band").unwrap_or("1") == number);
        let srs = xml::text_of(dataset, "SRS").unwrap_or_default();
        let said = Self {
            unit: VerticalUnit::of_crs_text(srs),
            crs: Some(srs).filter(|t| !t.is_empty()).map(crs),
            place: xml::text_of(dataset, "GeoTransform").map(place).transpose()?,
            ..Self::default()
        };
        let Some(band) = band else {
            return Ok(said);
        };
        let (factor, offset) = (xml::number_of(band, "Scale")?, xml::number_of(band, "Offset")?);
        let scaling = (factor.unwrap_or(1.0), offset.unwrap_or(0.0));
        Ok(Self {
            nodata: xml::text_of(band, "NoDataValue").map(nodata).transpose()?,
            unit: xml::text_of(band, "UnitType").and_then(VerticalUnit::of_word).or(said.unit),
            scaling: (factor.is_some() || offset.is_some()).then_some(scaling),
            is_palette: xml::text_of(band, "ColorInterp") == Some("Palette"),
            ..said
        })
    }
}

fn crs(text: &str) -> CrsHint {
    let code = text.strip_prefix("EPSG:").and_then(|code| code.parse().ok());
    code.map_or_else(|| CrsHint::Wkt(text.to_owned()), CrsHint::Epsg)
}

fn place(text: &str) -> Result<[f64; 6]> {
    let numbers: Option<Vec<f64>> = text.split(',').map(xml::finite).collect();
    let place: Option<[f64; 6]> = numbers.and_then(|n| n.try_into().ok());
    place.ok_or_else(|| Error::new(format!("<GeoTransform> holds `{text}`, which are not six numbers")))
}

fn nodata(text: &str) -> Result<f64> {
    text.parse().map_err(|_| Error::new(format!("<NoDataValue> holds `{text}`, which is no number")))
}
