//! GDAL's virtual rasters (`.vrt`): plain files put side by side.
//!
//! Source: GDAL's documentation of its VRT driver. Simple and complex sources whose rectangles are whole pixels of one size, with
//! nodata, scale and offset; later sources lie on those before. All else is refused by name: resampling, warping, derived bands,
//! alpha bands, masks that are not the files' own. What a file itself holds no data for, and what no file covers, are no posts; a
//! source lets those before it show through there if it says what its nodata is, or that its mask counts.

use super::frame::{Frame, PostRange};
use super::grid::Header;
use super::mosaic::{Mosaic, Opener, Piece};
use super::nodata::{Nodata, Precision};
use super::options::DemOptions;
use super::sidecar::Sidecar;
use super::site::Site;
use super::virtual_band::{Agreement, Number, Storage};
use super::xml;
use crate::error::{Error, Result};
use roxmltree::Node;
use std::path::{Path, PathBuf};

/// The longest file that is read.
const LONGEST: u64 = 1 << 26;

/// Reads a virtual raster; `open` opens its files without converting their samples.
pub(super) fn open(site: &Site, options: &DemOptions, beside: &Sidecar, open: Opener) -> Result<Mosaic> {
    let text = site.text(LONGEST)?;
    let document = xml::parse(&text).map_err(|e| e.help("fetch it again, or make it anew: gdalbuildvrt"))?;
    let root = document.root_element();
    if !root.has_tag_name("VRTDataset") {
        return Err(Error::new(format!("<{}> is no virtual raster", root.tag_name().name())));
    }
    let wanted = options.band.unwrap_or(1);
    let said = Sidecar::of(root, "VRTRasterBand", wanted)?;
    said.refuse_picture()?;
    let size = (whole_attribute(root, "rasterXSize")?, whole_attribute(root, "rasterYSize")?);
    let place = said.place.or(beside.place);
    let frame = match (place, options.bounds) {
        (Some(place), _) => Frame::of_geo_transform(size, place)?,
        (None, Some(bounds)) => Frame::within(size, bounds)?,
        (None, None) => Frame::local(size)?,
    };
    let band = band_of(root, wanted)?;
    let folder = site.path().parent().unwrap_or(Path::new("")).to_path_buf();
    let pieces: Vec<Piece> = sources_of(band)
        .map(|node| piece(node, &folder, (size, options.band.is_some())))
        .filter_map(Result::transpose)
        .collect::<Result<_>>()?;
    refuse_foreign_masks(root, &pieces, &folder, size)?;
    let Some(leader) = pieces.first() else {
        return Err(Error::new("the virtual raster names no file that holds heights")
            .help("make it anew: gdalbuildvrt OUT.vrt FILES..."));
    };
    let first = open(leader).map_err(|error| error.in_file(&leader.path))?.header().clone();
    let number = number_of(band)?;
    let precision = match number {
        Number::Single => Precision::Single,
        Number::Double => Precision::Double,
        Number::Whole(..) => Precision::Whole,
    };
    // What lies beside wins over the files', too.
    let (unit, scaling) = (said.unit.or(beside.unit.clone()), said.scaling.or(beside.scaling));
    let own_scaling = leader.own_scaling(&first);
    let agreement = Agreement {
        first: leader.path.clone(),
        unit: unit.is_none().then(|| first.unit.clone()),
        scaling: scaling.is_none().then_some(own_scaling),
    };
    let placed = place.is_some();
    let note = (!placed).then(|| "the virtual raster does not say its place".to_owned());
    let header = Header {
        format: "virtual raster",
        sample: first.sample.clone(),
        compression: first.compression.clone(),
        layout: format!("{} pieces", pieces.len()),
        nodata: said.nodata.map(|v| v.to_string()).or(first.nodata),
        frame,
        is_placed: placed,
        crs_hint: said.crs.or(first.crs_hint),
        unit: unit.or(first.unit),
        scaling: scaling.or(Some(own_scaling)),
        notes: note.into_iter().collect(),
    };
    let nodata = Nodata::new([said.nodata, beside.nodata, options.nodata], precision);
    Ok(Mosaic::layered(header, pieces, (Storage { nodata, number }, agreement), open))
}

fn sources_of<'a, 'i>(band: Node<'a, 'i>) -> impl Iterator<Item = Node<'a, 'i>> {
    band.children().filter(|n| n.tag_name().name().ends_with("Source"))
}

/// The kind of number that a band is stored as; bytes where nothing is said, as GDAL has it.
fn number_of(band: Node<'_, '_>) -> Result<Number> {
    Ok(match band.attribute("dataType").unwrap_or("Byte") {
        "Byte" | "UInt8" => Number::Whole(0.0, 255.0),
        "Int8" => Number::Whole(-128.0, 127.0),
        "UInt16" => Number::Whole(0.0, 65_535.0),
        "Int16" => Number::Whole(-32_768.0, 32_767.0),
        "UInt32" => Number::Whole(0.0, 4_294_967_295.0),
        "Int32" => Number::Whole(-2_147_483_648.0, 2_147_483_647.0),
        "Float32" => Number::Single,
        "Float64" => Number::Double,
        other => return Err(not_plain(&format!("its samples are {other}"))),
    })
}

/// Refuses masks and alpha bands, but for one mask: that of the very files, which is read with each of them.
fn refuse_foreign_masks(
    root: Node<'_, '_>,
    pieces: &[Piece],
    folder: &Path,
    size: (usize, usize),
) -> Result<()> {
    let mut bands = root.children().filter(|n| n.has_tag_name("VRTRasterBand"));
    if bands.any(|band| xml::text_of(band, "ColorInterp") == Some("Alpha")) {
        return Err(not_plain("one of its bands is an alpha band"));
    }
    // A mask may be kept for all bands, or for one.
    for mask in root.descendants().filter(|n| n.has_tag_name("MaskBand")) {
        let sources = mask.children().filter(|n| n.has_tag_name("VRTRasterBand")).flat_map(sources_of);
        let masks: Vec<Placed> = sources
            .map(|source| match xml::text_of(source, "SourceBand") {
                Some(band) if band.starts_with("mask") => placing(source, folder, size),
                _ => Err(not_plain("it has a mask of its own (MaskBand)")),
            })
            .filter_map(Result::transpose)
            .collect::<Result<_>>()?;
        let of_pieces = pieces.iter().map(|piece| (&piece.path, piece.source, piece.at));
        if !masks.iter().map(|(path, source, at)| (path, *source, *at)).eq(of_pieces) {
            return Err(not_plain("it has a mask of other files than its heights (MaskBand)"));
        }
    }
    Ok(())
}

/// The band's element; refuses what computes instead of placing.
fn band_of<'a, 'i>(root: Node<'a, 'i>, wanted: usize) -> Result<Node<'a, 'i>> {
    if let Some(class) = root.attribute("subClass") {
        return Err(not_plain(class));
    }
    let number = wanted.to_string();
    let mut bands = root.children().filter(|n| n.has_tag_name("VRTRasterBand"));
    let band = bands.find(|n| n.attribute("band").unwrap_or("1") == number).ok_or_else(|| {
        Error::new(format!("`band` = {wanted}, but the virtual raster has no such band"))
            .help("`drapery info FILE` tells of the first")
    })?;
    match band.attribute("subClass") {
        None | Some("VRTSourcedRasterBand") => Ok(band),
        Some(class) => Err(not_plain(class)),
    }
}

fn not_plain(what: &str) -> Error {
    Error::unsupported(format!("the virtual raster is more than files put side by side: {what}"))
        .help("make a plain file of it: gdal_translate -co COMPRESS=DEFLATE FILE.vrt OUT.tif")
}

/// The files that a source takes pixels of; `None` where it takes none.
fn piece(
    source: Node<'_, '_>,
    folder: &Path,
    (size, band_asked): ((usize, usize), bool),
) -> Result<Option<Piece>> {
    let kind = source.tag_name().name();
    if !matches!(kind, "SimpleSource" | "ComplexSource") {
        return Err(not_plain(kind));
    }
    let foreign = ["LUT", "Exponent", "ColorTableComponent", "Kernel"];
    if let Some(what) = foreign.into_iter().find(|name| xml::child(source, name).is_some()) {
        return Err(not_plain(what));
    }
    let number = xml::text_of(source, "SourceBand").unwrap_or("1");
    let number: usize = number.parse().map_err(|_| not_plain(&format!("band `{number}` of a file")))?;
    let Some((path, source_part, at)) = placing(source, folder, size)? else {
        return Ok(None);
    };
    let (ratio, offset) = (xml::number_of(source, "ScaleRatio")?, xml::number_of(source, "ScaleOffset")?);
    let is_scaled = ratio.is_some() || offset.is_some();
    let is_complex = kind == "ComplexSource";
    let nodata = xml::text_of(source, "NODATA").filter(|_| is_complex).map(nodata_of).transpose()?;
    let uses_mask =
        is_complex && xml::text_of(source, "UseMaskBand").is_some_and(|t| t.eq_ignore_ascii_case("true"));
    Ok(Some(Piece {
        path,
        band: (number != 1 || band_asked).then_some(number),
        source: source_part,
        at,
        scaling: (is_complex && is_scaled).then_some((ratio.unwrap_or(1.0), offset.unwrap_or(0.0))),
        lets_through: nodata.is_some() || uses_mask,
        nodata,
    }))
}

/// What a source does not lay over others: the value that it states, as it is or in single precision.
fn nodata_of(text: &str) -> Result<Nodata> {
    let value: f64 = text.parse().map_err(|_| {
        Error::new(format!("a source's <NODATA> is `{text}`, which is no number"))
            .help("make it anew: gdalbuildvrt OUT.vrt FILES...")
    })?;
    Ok(Nodata::new([Some(value), Some(f64::from(value as f32)), None], Precision::Double))
}

/// A file, the posts that are taken of it, and where the first of them goes.
type Placed = (PathBuf, PostRange, (usize, usize));

/// The file of a source, and which of its posts go where; `None` where none do.
fn placing(source: Node<'_, '_>, folder: &Path, size: (usize, usize)) -> Result<Option<Placed>> {
    let Some(file) = xml::child(source, "SourceFilename") else {
        return Err(Error::new(format!("a <{}> names no file", source.tag_name().name())));
    };
    let path = path_of(file, folder)?;
    let (from, to) = (rectangle(source, "SrcRect")?, rectangle(source, "DstRect")?);
    let whole = [0.0, 0.0, size.0 as f64, size.1 as f64];
    let (from, to) = match (from, to) {
        (Some(from), Some(to)) => (from, to),
        (None, None) => (whole, whole),
        _ => return Err(not_plain("a source with one of its two rectangles")),
    };
    let scaled = |a: f64, b: f64| (a - b).abs() > 1e-3;
    if scaled(from[2], to[2]) || scaled(from[3], to[3]) {
        let what =
            format!("{} x {} pixels of a file are resampled to {} x {}", from[2], from[3], to[2], to[3]);
        return Err(not_plain(&what));
    }
    Ok(placed(from, to, size)?.map(|(part, at)| (path, part, at)))
}

/// The whole pixels of a source, and where they go: cut at the raster's edges. `None` where nothing is left.
fn placed(from: [f64; 4], to: [f64; 4], size: (usize, usize)) -> Result<Option<(PostRange, (usize, usize))>> {
    /// Pixels beyond any raster.
    const MOST: f64 = 2_147_483_648.0;
    let whole = |v: f64| {
        let nearest = v.round();
        let is_whole = (v - nearest).abs() <= 1e-3 && nearest.abs() <= MOST;
        is_whole.then_some(nearest as i64).ok_or_else(|| not_plain(&format!("a rectangle at pixel {v}")))
    };
    let axis = |from: f64, to: f64, count: f64, size: usize| {
        let (from, to, count) = (whole(from)?, whole(to)?, whole(count)?);
        let low = 0.max(-to).max(-from);
        let high = count.min(size as i64 - to);
        Ok::<_, Error>(
            (low < high).then(|| ((from + low) as usize, (high - low) as usize, (to + low) as usize)),
        )
    };
    let columns = axis(from[0], to[0], from[2], size.0)?;
    let rows = axis(from[1], to[1], from[3], size.1)?;
    Ok(columns.zip(rows).map(|((column, columns, left), (row, rows, top))| {
        (PostRange { column, row, columns, rows }, (left, top))
    }))
}

fn path_of(file: Node<'_, '_>, folder: &Path) -> Result<PathBuf> {
    let name = file.text().unwrap_or_default().trim();
    if name.is_empty() {
        return Err(Error::new("a source names no file"));
    }
    if name.starts_with("/vsi") || name.contains("://") {
        return Err(Error::unsupported(format!(
            "the virtual raster names `{name}`, which is no file on disk"
        ))
        .help("fetch or unpack the files, and make it anew: gdalbuildvrt OUT.vrt FILES..."));
    }
    if name.to_ascii_lowercase().ends_with(".vrt") {
        return Err(not_plain(&format!("it names another, {name}")));
    }
    let is_relative = file.attribute("relativeToVRT") == Some("1");
    Ok(if is_relative { folder.join(name) } else { name.into() })
}

/// A source's rectangle: x, y, width and height.
fn rectangle(source: Node<'_, '_>, name: &str) -> Result<Option<[f64; 4]>> {
    let Some(node) = xml::child(source, name) else {
        return Ok(None);
    };
    let mut rectangle = [0.0; 4];
    for (slot, name) in rectangle.iter_mut().zip(["xOff", "yOff", "xSize", "ySize"]) {
        let text = node.attribute(name).unwrap_or_default();
        *slot = xml::finite(text)
            .ok_or_else(|| Error::new(format!("a source's `{name}` is `{text}`, which is no number")))?;
    }
    Ok(Some(rectangle))
}

fn whole_attribute(node: Node<'_, '_>, name: &str) -> Result<usize> {
    let text = node.attribute(name).unwrap_or_default();
    text.parse().map_err(|_| {
        Error::new(format!("the virtual raster's `{name}` is `{text}`, which is no count of pixels"))
            .help("make it anew: gdalbuildvrt OUT.vrt FILES...")
    })
}
