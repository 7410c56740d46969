//! Vector files of kinds that are not read: what each is, and the command that makes a file of it which is.

use crate::error::Error;
use std::path::Path;

/// A kind of file that is not read.
pub(super) struct Foreign {
    name: &'static str,
    /// In small letters.
    extensions: &'static [&'static str],
    /// What stands near the beginning of every such file; empty: nothing that tells.
    mark: &'static [u8],
    way: Way,
}

/// How it becomes a file that is read.
enum Way {
    /// It has one layer.
    Layer,
    /// It may have several.
    Layers,
    /// One layer, with more options of ogr2ogr and a word on them.
    With(&'static str, &'static str),
    /// Something else is to be done.
    Words(&'static str),
}

const fn kind(
    name: &'static str,
    extensions: &'static [&'static str],
    mark: &'static [u8],
    way: Way,
) -> Foreign {
    Foreign { name, extensions, mark, way }
}

static KINDS: [Foreign; 20] = [
    kind("KML", &["kml", "kmz"], b"<kml", Way::Layers),
    kind("GML", &["gml"], b"opengis.net/gml", Way::Layers),
    kind("GPX", &["gpx"], b"<gpx", Way::Layers),
    kind("OpenStreetMap XML", &["osm"], b"<osm ", Way::Layers),
    kind("TopoJSON", &["topojson"], b"{\"type\":\"Topology\"", Way::Layers),
    kind("Esri JSON", &[], b"\"esriGeometry", Way::Layer),
    kind("Esri JSON", &[], b"{\"displayFieldName\"", Way::Layer),
    kind("Esri JSON", &[], b"{\"objectIdFieldName\"", Way::Layer),
    kind(
        "a table (CSV)",
        &["csv", "tsv"],
        b"",
        Way::With(
            "-oo GEOM_POSSIBLE_NAMES=WKT,wkt,geom,geometry -oo KEEP_GEOM_COLUMNS=NO -a_srs EPSG:4326",
            "for a column of WKT, in the CRS that is named; points x, y, height are a terrain when the file is named .xyz",
        ),
    ),
    kind("MapInfo", &["tab", "mif"], b"", Way::Layer),
    kind("DXF", &["dxf"], b"", Way::With("-a_srs EPSG:CODE", "with the code of the drawing's CRS")),
    kind(
        "DWG",
        &["dwg"],
        b"",
        Way::Words("save it as DXF first, then: ogr2ogr OUT.fgb IN.dxf -a_srs EPSG:CODE"),
    ),
    kind("a file geodatabase", &["gdb"], b"", Way::Layers),
    kind("Parquet", &["parquet", "geoparquet"], b"PAR1", Way::Layer),
    kind("Arrow", &["arrow", "feather"], b"ARROW1", Way::Layer),
    kind("a set of vector tiles", &["mvt", "pmtiles"], b"PMTiles", Way::Layers),
    kind("an ArcInfo export", &["e00"], b"", Way::Layers),
    kind("DGN", &["dgn"], b"", Way::Layers),
    kind("an S-57 chart", &["000"], b"", Way::Layers),
    kind(
        "a part of a shapefile, without the shapes",
        &["shx", "dbf", "prj", "cpg", "sbn", "sbx", "qix", "qpj"],
        b"",
        Way::Words("name the .shp beside it"),
    ),
];

/// The kind that a name promises.
pub(super) fn by_name(path: &Path) -> Option<&'static Foreign> {
    let extension = path.extension()?.to_str()?.to_ascii_lowercase();
    KINDS.iter().find(|kind| kind.extensions.contains(&extension.as_str()))
}

/// The kind that the beginning of a file shows; a mark in braces is the very first.
pub(super) fn by_content(start: &[u8]) -> Option<&'static Foreign> {
    let compact: Vec<u8> = start.iter().copied().filter(|byte| !byte.is_ascii_whitespace()).collect();
    let has = |mark: &[u8]| match mark.first() {
        None => false,
        Some(b'{') => compact.starts_with(mark),
        Some(_) => start.windows(mark.len()).any(|window| window == mark),
    };
    KINDS.iter().find(|kind| has(kind.mark))
}

impl Foreign {
    /// Whether such a file is one of features, and not a part of one.
    pub(super) fn stands_alone(&self) -> bool {
        !matches!(self.way, Way::Words(_))
    }

    /// The refusal of a file of this kind.
    pub(super) fn refuse(&self, path: &Path) -> Error {
        let error = Error::unsupported(format!("this is {}, which is not read", self.name));
        error.help(match self.way {
            Way::Layer => command(path, "fgb", ""),
            Way::Layers => command(path, "gpkg", ""),
            Way::With(options, word) => format!("{} ({word})", command(path, "fgb", options)),
            Way::Words(words) => words.to_owned(),
        })
    }
}

fn command(path: &Path, extension: &str, options: &str) -> String {
    let space = if options.is_empty() { "" } else { " " };
    format!("convert it: ogr2ogr {} {}{space}{options}", word(&path.with_extension(extension)), word(path))
}

/// A path as a word of a shell.
fn word(path: &Path) -> String {
    let text = path.display().to_string();
    let is_plain = |c: char| c.is_alphanumeric() || "/._-+:@".contains(c);
    match text.chars().all(is_plain) && !text.starts_with('-') {
        true => text,
        false => format!("'{}'", text.replace('\'', "'\\''")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_names_the_file_as_a_shell_wants_it() {
        let help = |path: &str| {
            by_name(Path::new(path)).unwrap().refuse(Path::new(path)).help_text().unwrap().to_owned()
        };
        assert_eq!(help("a/b.KML"), "convert it: ogr2ogr a/b.gpkg a/b.KML");
        assert_eq!(help("it's.tab"), "convert it: ogr2ogr 'it'\\''s.fgb' 'it'\\''s.tab'");
        assert!(help("a.csv").starts_with("convert it: ogr2ogr a.fgb a.csv -oo GEOM"), "{}", help("a.csv"));
        assert!(help("a.dbf").contains(".shp"));
        assert!(by_name(Path::new("a.tif")).is_none() && by_content(b"II*\0").is_none());
        assert!(by_content(b"{ \"type\": \"Topology\",").is_some());
    }
}
