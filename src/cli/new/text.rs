//! The text of a starter scene.

use super::files::{Files, Layer, Terrain};
use super::framing::{Framing, WIDTH};
use super::place::Place;
use super::style::{self, Measures, Widths};
use super::theme::{Looks, Theme};
use crate::cli::columns::offers;
use crate::cli::info::encoding_name;
use crate::cli::written::{harmless, quoted_text};
use drapery::Result;
use drapery::crs::Crs;
use drapery::scene::{Feature, Scene};
use drapery::space::{Plan, PlanBox};
use glam::DVec3;
use std::path::Path;

/// A scene to be written.
pub(super) struct Starter<'a> {
    pub(super) files: &'a Files<'a>,
    /// Where paths start.
    pub(super) place: &'a Place,
    /// What loading said of it; without it, the text is one to load.
    pub(super) told: Option<Told<'a>>,
}

/// What is known of a scene that has been loaded once.
#[derive(Clone, Copy)]
pub(super) struct Told<'a> {
    pub(super) scene: &'a Scene,
    pub(super) framing: &'a Framing,
    pub(super) notes: &'a [String],
}

/// A terrain that spans more degrees, one way or the other, is rather a globe.
const GLOBAL: f64 = 60.0;

const NO_LAYER: &str = r##"
# [[layer]]
# name = "roads"
# source = "roads.shp"                 # .geojson .json .shp .fgb .gpkg
# line = { color = "#ff7f00", width_px = 3.0, join = "round", cap = "round" }
"##;

impl Starter<'_> {
    /// The whole scene file.
    pub(super) fn text(&self) -> Result<String> {
        let mut text = self.head()?;
        let mut looks = Looks::default();
        let mut drawn = 0;
        for layer in &self.files.layers {
            match self.left_out(layer) {
                None => {
                    text += &self.layer(layer, drawn, &mut looks)?;
                    drawn += 1;
                }
                Some(why) => text += &self.commented(layer, &why, &mut looks)?,
            }
        }
        if drawn == 0 {
            text += NO_LAYER;
        }
        Ok(text)
    }

    /// Why a layer is left out, where it is.
    fn left_out(&self, layer: &Layer<'_>) -> Option<String> {
        if !layer.is_drawn() {
            return Some("it holds nothing that is drawn, and is left out".into());
        }
        let words = layer.summary.crs_not_read.as_ref().filter(|_| self.knows_crs())?;
        Some(format!(
            "{words}: it is left out; say as its `crs` in the scene what its coordinates are in (it stands there as a comment), or \
             reproject it: ogr2ogr -t_srs EPSG:4326 OUT.gpkg FILE"
        ))
    }

    /// What to say of layers that are left out.
    pub(super) fn notes_of_left_out(&self) -> impl Iterator<Item = String> {
        let told = |layer: &Layer<'_>| Some(format!("layer `{}`: {}", layer.name, self.left_out(layer)?));
        self.files.layers.iter().filter_map(told)
    }

    /// All but the layers.
    fn head(&self) -> Result<String> {
        let terrain = &self.files.terrain;
        Ok(format!(
            r##"# A scene for drapery. `drapery schema` describes every key; paths are relative to this file.
schema = 1
name = {name}
{plan}
[image]
width = {WIDTH}
height = {height}
background = "#dce9f2"

{camera}
[terrain]
source = {source}
{crs}{encoding}# window = [x0, y0, x1, y1]            # read only this part, in the file's own coordinates
{scale}color = "#efe6d2"
shade = "hillshade"
{notes}"##,
            name = quoted_text(&terrain.name()),
            plan = self.plan(),
            height = self.told.map_or(800, |told| told.framing.height),
            camera = self.camera(),
            source = self.source(&terrain.paths)?,
            crs = self.crs()?,
            encoding = encoding(terrain),
            scale = self.scale(),
            notes = self.notes("terrain: "),
        ))
    }

    /// The terrain's file, or all of them.
    fn source(&self, paths: &[&Path]) -> Result<String> {
        let quoted: Vec<String> = paths.iter().map(|path| self.place.quoted(path)).collect::<Result<_>>()?;
        Ok(if let [only] = &quoted[..] { only.clone() } else { format!("[{}]", quoted.join(", ")) })
    }

    /// What the plan is.
    fn plan(&self) -> String {
        let words = self.told.map(|told| format!("# The plan: {}.\n", harmless(&told.scene.plan_space)));
        let globe = self.files.terrain.degrees().filter(|degrees| *degrees > GLOBAL).map(|degrees| {
            format!(
                "# plan = \"globe\"                     # the terrain spans {degrees:.0} degrees, too many for a plane; widths are then \
                 metres (width_m), places of the camera eye_geo and target_geo, or none\n"
            )
        });
        words.unwrap_or_default() + &globe.unwrap_or_default()
    }

    /// What to say of a terrain that is rather a globe.
    pub(super) fn note_of_globe(&self) -> Option<String> {
        let degrees = self.files.terrain.degrees().filter(|degrees| *degrees > GLOBAL)?;
        Some(format!(
            "terrain: it spans {degrees:.0} degrees, and no plane shows that as it is: plan = \"globe\" stands in the scene as a comment"
        ))
    }

    fn camera(&self) -> String {
        let at = |at: DVec3, decimals: usize| {
            format!("[{:.decimals$}, {:.decimals$}, {:.decimals$}]", at.x, at.y, at.z)
        };
        let Some(Told { framing, .. }) = self.told else { return String::new() };
        let (eye, target) = (at(framing.eye, framing.decimals()), at(framing.target, framing.decimals()));
        let near = framing.near_m.map_or_else(String::new, |near| format!("near_m = {near}\n"));
        format!(
            "# From the south. Without eye and target the program frames the layers.\n[camera]\n\
             eye = {eye}   # plan x, plan y, height in metres; or eye_geo = [longitude, latitude, height]\n\
             target = {target}\n\
             fov_y_deg = {:.2}\n{near}",
            framing.fov_y_deg
        )
    }

    fn scale(&self) -> String {
        let by = self.told.map_or(1.0, |told| told.framing.exaggeration);
        let why = match by > 1.0 {
            true => "heights are low beside the extent: drawn so many times as high; 1.0 is as they are",
            false => {
                "the cells' size in metres is not known: heights beyond the extent are lowered; 1.0 is as they are"
            }
        };
        match by == 1.0 {
            true => "vertical_scale = 1.0\n".into(),
            false => format!("{:<38} # {why}\n", format!("vertical_scale = {by:?}")),
        }
    }

    /// The code of a layer's CRS that the terrain has too, by where the layer lies, and the layer's file. Nothing where the terrain
    /// states another.
    fn guessed_crs(&self) -> Option<(&Path, u32)> {
        if self.files.terrain.summary.crs_hint.is_some() {
            return None;
        }
        let ground = self.files.terrain.bounds;
        self.files.layers.iter().find_map(|layer| {
            let crs = layer.summary.crs.as_ref()?;
            let code = crs.epsg()?;
            let lies_on_it = layer.summary.bounds.meets(&ground) && can_hold(crs, &ground);
            lies_on_it.then_some((layer.path, code))
        })
    }

    /// Whether the scene has a CRS: without one nobody knows how long a cell is.
    pub(super) fn knows_crs(&self) -> bool {
        self.files.terrain.plan().is_some() || self.guessed_crs().is_some()
    }

    /// The terrain's CRS, where its file does not state one and a layer on it does.
    fn crs(&self) -> Result<String> {
        if self.files.terrain.plan().is_some() {
            return Ok(String::new());
        }
        Ok(match self.guessed_crs() {
            Some((path, code)) => format!(
                "crs = \"EPSG:{code}\"                    # the file does not say it: taken from {}, which lies on it\n",
                self.place.quoted(path)?
            ),
            None => {
                let why = match self.files.terrain.crs_not_read() {
                    Some(words) => {
                        format!("what the file says cannot be used: {}; say it if you know", harmless(&words))
                    }
                    None => "the file does not say it: say it if you know".into(),
                };
                format!("# crs = \"EPSG:...\"                    # {why}\n")
            }
        })
    }

    /// The table of a layer, the `number`-th of those that are drawn.
    fn layer(&self, layer: &Layer<'_>, number: usize, looks: &mut Looks) -> Result<String> {
        let drawn = self.told.and_then(|told| told.scene.layers.get(number));
        let features = drawn.map_or(&[][..], |layer| &layer.features);
        let text = self.source_of(layer)? + &self.style(layer, features, looks);
        Ok(text + &offers(&layer.summary) + &self.notes(&format!("layer `{}`: ", layer.name)))
    }

    /// A layer that is left out: why, and where it has something to draw its table, as comments.
    fn commented(&self, layer: &Layer<'_>, why: &str, looks: &mut Looks) -> Result<String> {
        let source = self.place.quoted(layer.path)?;
        let mut text = format!("\n# {}, {source}: {}\n", harmless(&layer.name), harmless(why));
        if layer.is_drawn() {
            let table = self.source_of(layer)? + "crs = \"EPSG:...\"\n" + &self.style(layer, &[], looks);
            table.lines().filter(|line| !line.is_empty()).for_each(|line| text += &format!("# {line}\n"));
        }
        Ok(text)
    }

    /// The head of a layer's table.
    fn source_of(&self, layer: &Layer<'_>) -> Result<String> {
        let source = self.place.quoted(layer.path)?;
        let text = format!("\n[[layer]]\nname = {}\nsource = {source}\n", quoted_text(&layer.name));
        let of_a_package =
            layer.summary.layer.as_ref().map(|layer| format!("layer = {}\n", quoted_text(layer)));
        Ok(text + &of_a_package.unwrap_or_default())
    }

    /// How a layer looks.
    fn style(&self, layer: &Layer<'_>, features: &[Feature], looks: &mut Looks) -> String {
        let look = looks.of(Theme::of(&layer.name));
        let widths = self
            .told
            .map(|told| Widths::of(&look, &Measures::of(features, &told.framing.plan), told.framing));
        style::lines(layer, &look, widths.unwrap_or(Widths { line: 1.0, outline: 1.0, point: 1.0 }))
    }

    /// What loading said of a part of the scene, as comments.
    fn notes(&self, about: &str) -> String {
        let notes = self.told.map_or(&[][..], |told| told.notes);
        let notes = notes.iter().filter_map(|note| note.strip_prefix(about));
        notes.map(|note| format!("# Note: {}\n", harmless(note))).collect()
    }
}

/// Whether a rectangle can be in a CRS: one in degrees ends at the poles. (A GeoJSON of metres still counts as degrees.)
fn can_hold(crs: &Crs, bounds: &PlanBox) -> bool {
    let on_globe = |p: Plan| p.x.abs() <= 360.0 && p.y.abs() <= 90.0;
    !crs.is_geographic() || (on_globe(bounds.min) && on_globe(bounds.max))
}

/// What a PNG does not say itself.
fn encoding(terrain: &Terrain<'_>) -> String {
    let Some(encoding) = terrain.encoding else {
        return String::new();
    };
    let [low, high] = terrain.summary.heights.unwrap_or_default();
    format!(
        "encoding = \"{}\"{:<18}# its heights are then {low:.1} to {high:.1}; the other encoding gives none on Earth\n\
         # bounds = [x0, y0, x1, y1]            # the rectangle that the PNG covers, in the terrain's crs\n",
        encoding_name(encoding),
        ""
    )
}
