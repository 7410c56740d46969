//! Features as GeoJSON (RFC 7946, but in the scene's plan coordinates), styled in the words of the simplestyle specification and
//! of the scene file.

use super::picked::value;
use crate::draw_list::{Chain, DrawList, Item, ItemStyle, NO_FEATURE, Role, Side};
use crate::parameter::Named;
use crate::scene::{Color, Column, Layer, Line, OutlineMode, StrokeForm, TechniqueSettings, Width};
use crate::space::Plan;
use crate::technique::Kind;
use glam::DVec2;
use serde_json::{Map, Value, json};
use std::io::{self, Write};

/// What features are written from.
#[derive(Debug, Clone, Copy)]
pub struct FeatureTable<'a> {
    /// The layers, for their names.
    pub layers: &'a [Layer],
    /// The features that are painted.
    pub list: &'a DrawList,
    /// The columns of attributes of each layer; a layer may have none.
    pub attributes: &'a [Vec<Column>],
    /// What the plan space is (`EPSG:32733`, or words).
    pub plan_space: &'a str,
    /// Absolute plan coordinates of the local zero point.
    pub origin: DVec2,
    /// Who draws them, and what is said of techniques' parameters: what becomes of corners and ends.
    pub drawn_by: (Kind, &'a TechniqueSettings),
}

/// Writes all features that are painted, in draw order, each in a line, in absolute plan coordinates. RFC 7946 knows longitude and latitude
/// alone: the `crs` member of its predecessor of 2008, which GIS programs read, names the plan's code, and is null where it has none.
///
/// # Errors
/// Those of the writer.
pub fn write_features(table: &FeatureTable, to: &mut dyn Write) -> io::Result<()> {
    let list = table.list;
    let (crs, plan_space) = (crs_member(table.plan_space), Value::from(table.plan_space));
    let drawn_by = table.drawn_by.0.name();
    write!(
        to,
        "{{\"type\":\"FeatureCollection\",\"crs\":{crs},\"plan_space\":{plan_space},\"widths\":\"{WIDTHS}\",\"drawn_by\":\"{drawn_by}\",\"features\":["
    )?;
    let mut separator = "\n";
    for items in list.items().chunk_by(|a, b| (a.layer, a.feature) == (b.layer, b.feature)) {
        to.write_all(separator.as_bytes())?;
        separator = ",\n";
        let properties = Value::Object(properties(table, items));
        write!(to, "{{\"type\":\"Feature\",\"properties\":{properties},\"geometry\":")?;
        write_geometry(list, items, table.origin, to)?;
        write!(to, "}}")?;
    }
    write!(to, "\n]}}\n")
}

/// What widths are, for who reads nothing else.
const WIDTHS: &str = "whole: from side to side";

/// The plan's CRS as the format's predecessor names it; null where it has no code of EPSG's.
fn crs_member(plan_space: &str) -> Value {
    let code = plan_space.strip_prefix("EPSG:").filter(|code| code.bytes().all(|b| b.is_ascii_digit()));
    code.map_or(
        Value::Null,
        |code| json!({ "type": "name", "properties": { "name": format!("urn:ogc:def:crs:EPSG::{code}") } }),
    )
}

/// The properties of a feature: its style by its items, and its attributes. One that is called as a part of the style has `attribute.` before
/// its name.
fn properties(table: &FeatureTable, items: &[Item]) -> Map<String, Value> {
    let mut all = styled(table, items);
    let numbered = items.first().filter(|item| item.number != NO_FEATURE);
    let Some(item) = numbered else { return all };
    for column in table.attributes.get(item.layer as usize).into_iter().flatten() {
        let value = value(column.value(item.number as usize));
        let is_taken = STYLE_KEYS.contains(&column.name.as_str());
        let name = if is_taken { format!("attribute.{}", column.name) } else { column.name.clone() };
        all.insert(name, value);
    }
    all
}

/// What a style may write.
const STYLE_KEYS: [&str; 22] = [
    "layer",
    "layer-number",
    "number",
    "feature",
    "layer-opacity",
    "fill",
    "fill-opacity",
    "fill-rule",
    "fill-invert",
    "stroke",
    "stroke-opacity",
    "stroke-width-m",
    "stroke-width-px",
    "join",
    "miter-limit",
    "cap",
    "drawn-join",
    "drawn-miter-limit",
    "drawn-cap",
    "outline-mode",
    "dashes",
    "attribute",
];

/// How a feature looks, by its items.
fn styled(table: &FeatureTable, items: &[Item]) -> Map<String, Value> {
    let list = table.list;
    let mut all = Map::new();
    for item in items {
        all.insert("layer".into(), table.layers[item.layer as usize].name.clone().into());
        let number = Some(item.number).filter(|number| *number != NO_FEATURE);
        all.insert("number".into(), number.into());
        all.insert("layer-number".into(), item.layer.into());
        all.insert("feature".into(), number.map(|_| item.feature).into());
        let style = &list.styles()[item.style as usize];
        if let Some(group) = style.group {
            all.insert("layer-opacity".into(), group.opacity.into());
        }
        match &style.stroke {
            Some(line) => {
                put_stroke(style, line, &mut all);
                put_drawn(table, style, line, &mut all);
                put_dashes(table, item, &mut all);
            }
            None => put_fill(style, &mut all),
        }
    }
    all
}

fn put_fill(style: &ItemStyle, all: &mut Map<String, Value>) {
    all.insert("fill".into(), hex(style.paint).into());
    all.insert("fill-opacity".into(), style.paint.0[3].into());
    all.insert("fill-rule".into(), style.rule.word().into());
    if style.role == Role::Outside {
        all.insert("fill-invert".into(), true.into());
    }
}

fn put_stroke(style: &ItemStyle, line: &Line, all: &mut Map<String, Value>) {
    let mut put = |name: &str, value: Value| all.insert(name.into(), value);
    put("stroke", hex(style.paint).into());
    put("stroke-opacity", style.paint.0[3].into());
    match line.width {
        Width::Metres(width) => put("stroke-width-m", width.into()),
        Width::Pixels(width) => put("stroke-width-px", width.into()),
    };
    let form = StrokeForm::of_style(line);
    put("join", form.join.into());
    if let Some(limit) = form.miter_limit {
        put("miter-limit", limit.into());
    }
    put("cap", form.cap.into());
    if style.role == Role::Outline {
        let mode = match style.cut {
            Some(Side::Inside) => OutlineMode::Inset,
            None => OutlineMode::Normal,
            Some(Side::Outside) => OutlineMode::Offset,
        };
        put("outline-mode", mode.word().into());
    }
}

/// What the technique makes of a stroke's corners and ends. Points are discs to all.
fn put_drawn(table: &FeatureTable, style: &ItemStyle, line: &Line, all: &mut Map<String, Value>) {
    let (kind, said) = table.drawn_by;
    let form = if style.role == Role::Point {
        StrokeForm::ROUND
    } else {
        (kind.declaration().stroke_form)(said, line)
    };
    all.insert("drawn-join".into(), form.join.into());
    if let Some(limit) = form.miter_limit {
        all.insert("drawn-miter-limit".into(), limit.into());
    }
    all.insert("drawn-cap".into(), form.cap.into());
}

/// Where a line or an outline is dashed, the polylines that are drawn in place of the feature's lines or rings.
fn put_dashes(table: &FeatureTable, item: &Item, all: &mut Map<String, Value>) {
    let list = table.list;
    if list.centre_lines(item).is_empty() {
        return;
    }
    let place = |p: &Plan| json!([table.origin.x + p.x, table.origin.y + p.y]);
    let path = |chain: &Chain| list.path_of(chain).iter().map(place).collect();
    all.insert("dashes".into(), list.strokes(item).iter().map(path).collect::<Vec<Value>>().into());
}

/// A colour without its alpha, as the web writes it.
fn hex(color: Color) -> String {
    let code = |v: f64| (v * 255.0 + 0.5) as u8;
    let [r, g, b, _] = color.0.map(code);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Lines, or rings: those of a multi-polygon by its members where these overlap, else all in one polygon.
fn write_geometry(list: &DrawList, items: &[Item], origin: DVec2, to: &mut dyn Write) -> io::Result<()> {
    let has = |role: Role| items.iter().any(|item| list.styles()[item.style as usize].role == role);
    if has(Role::Point) {
        let points =
            items.iter().flat_map(|item| list.strokes(item)).flat_map(|chain| list.vertices_of(chain));
        let places: Vec<_> = points.map(|p| [origin.x + p.x, origin.y + p.y]).collect();
        return write!(to, "{}", json!({ "type": "MultiPoint", "coordinates": places }));
    }
    let is_line = has(Role::Line);
    let is_united = !has(Role::Outside) && items.iter().any(|item| item.border != item.area);
    let kind = match (is_line, is_united) {
        (true, _) => "MultiLineString",
        (false, true) => "MultiPolygon",
        (false, false) => "Polygon",
    };
    write!(to, "{{\"type\":\"{kind}\",\"coordinates\":[")?;
    let parts = parts(list, items);
    if is_united {
        for (k, rings) in parts.chunk_by(|a, b| a.member == b.member).enumerate() {
            write!(to, "{}[", if k == 0 { "" } else { "," })?;
            write_parts(list, rings, is_line, origin, to)?;
            write!(to, "]")?;
        }
    } else {
        write_parts(list, &parts, is_line, origin, to)?;
    }
    write!(to, "]}}")
}

fn write_parts(
    list: &DrawList,
    parts: &[Chain],
    is_line: bool,
    origin: DVec2,
    to: &mut dyn Write,
) -> io::Result<()> {
    for (k, part) in parts.iter().enumerate() {
        write!(to, "{}[", if k == 0 { "" } else { "," })?;
        // Rings of a polygon are closed, even those of a single vertex.
        let path = list.path_of(part);
        let closing = path.first().filter(|_| !is_line && !part.is_closed);
        for (k, Plan { x, y, .. }) in path.iter().chain(closing).enumerate() {
            let place = json!([origin.x + x, origin.y + y]);
            write!(to, "{}{place}", if k == 0 { "" } else { "," })?;
        }
        write!(to, "]")?;
    }
    Ok(())
}

/// The lines or rings of a feature in their order: borders where it has an area; what only its outline has by the outline's stroke.
fn parts(list: &DrawList, items: &[Item]) -> Vec<Chain> {
    // What is outside of all polygons has a border of its own.
    let borders = items.iter().flat_map(|item| match list.styles()[item.style as usize].role {
        Role::Outside => list.border(item),
        _ => list.area(item),
    });
    let strokes = items.iter().flat_map(|item| match list.centre_lines(item) {
        // Of dashes, what they are parts of; a swath on a globe has no strokes.
        whole if !item.strokes.is_empty() && !whole.is_empty() => whole,
        _ => list.strokes(item),
    });
    let mut parts: Vec<Chain> = borders.chain(strokes).copied().collect();
    // Borders are before strokes: the sort keeps them there.
    parts.sort_by_key(|chain| chain.part);
    parts.dedup_by_key(|chain| chain.part);
    parts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Attribute, Cap, Feature, Fill, Join, Outline, Rule, Shape, Style};
    use crate::space::PlanBox;

    fn written(style: Style, shapes: Vec<Shape>) -> Value {
        written_with(style, shapes, (&[], "metres without a CRS"))
    }

    fn written_with(
        style: Style,
        shapes: Vec<Shape>,
        (attributes, plan_space): (&[Vec<Column>], &str),
    ) -> Value {
        let features = shapes.into_iter().enumerate();
        let features = features.map(|(index, shape)| Feature { index, style: 0, shape }).collect();
        let mut layers = [Layer::uniform("layer", style, features)];
        let list = DrawList::new(&mut layers, &PlanBox::EMPTY).unwrap();
        let mut text = Vec::new();
        let origin = DVec2::new(100.0, 0.0);
        let drawn_by = (Kind::StencilVolume, &TechniqueSettings::default());
        let table = FeatureTable { layers: &layers, list: &list, attributes, plan_space, origin, drawn_by };
        write_features(&table, &mut text).unwrap();
        serde_json::from_slice(&text).unwrap()
    }

    fn plan(points: &[(f64, f64)]) -> Vec<Plan> {
        points.iter().map(|&(x, y)| Plan::new(x, y)).collect()
    }

    fn style(mode: OutlineMode, has_fill: bool) -> Style {
        let color = Color([0.0, 0.0, 0.0, 1.0]);
        let line = Line { color, width: Width::Metres(1.0), join: Join::Round, cap: Cap::Butt };
        let fill = has_fill.then_some(Fill { color, rule: Rule::EvenOdd });
        Style { fill, outline: Some(Outline { line, mode }), ..Style::default() }
    }

    #[test]
    fn a_polygon_has_all_rings_that_its_fill_and_its_outline_have_closed_and_in_their_order() {
        let rings =
            [&[(0.0, 0.0)][..], &[(0.0, 0.0), (4.0, 0.0), (4.0, 0.0), (0.0, 4.0)], &[(1.0, 1.0), (2.0, 1.0)]];
        let polygon = || vec![Shape::Polygon(rings.map(plan).to_vec())];
        let rings = |style| written(style, polygon())["features"][0]["geometry"]["coordinates"].to_string();
        let with =
            |big: &str| format!("[[[100.0,0.0],[100.0,0.0]],{big},[[101.0,1.0],[102.0,1.0],[101.0,1.0]]]");
        let as_is = with("[[100.0,0.0],[104.0,0.0],[104.0,0.0],[100.0,4.0],[100.0,0.0]]");
        assert_eq!(rings(style(OutlineMode::Normal, true)), as_is);
        assert_eq!(rings(style(OutlineMode::Inset, false)), as_is);
        let distinct = with("[[100.0,0.0],[104.0,0.0],[100.0,4.0],[100.0,0.0]]");
        assert_eq!(rings(style(OutlineMode::Normal, false)), distinct, "nothing but the stroke is drawn");
    }

    #[test]
    fn members_that_overlap_are_a_multi_polygon_and_others_one_polygon() {
        let triangle = |x: f64| vec![plan(&[(x, 0.0), (x + 4.0, 0.0), (x, 4.0)])];
        let geometry = |x: f64| {
            let shape = Shape::MultiPolygon(vec![triangle(0.0), triangle(x)]);
            written(style(OutlineMode::Normal, true), vec![shape])["features"][0]["geometry"].clone()
        };
        let (over, beside) = (geometry(1.0), geometry(4.0));
        assert_eq!((over["type"].as_str(), beside["type"].as_str()), (Some("MultiPolygon"), Some("Polygon")));
        let second = "[[[101.0,0.0],[105.0,0.0],[101.0,4.0],[101.0,0.0]]]";
        assert_eq!(over["coordinates"][1].to_string(), second);
        assert_eq!(beside["coordinates"].as_array().map(Vec::len), Some(2));
    }

    #[test]
    fn what_is_outside_of_polygons_is_a_feature_of_no_number_with_a_frame_and_what_is_cut_out_of_it() {
        let shape = Shape::Polygon(vec![plan(&[(0.0, 0.0), (4.0, 0.0), (0.0, 4.0)])]);
        let fill = Fill { color: Color([1.0, 0.0, 0.0, 0.5]), rule: Rule::NonZero };
        let features = vec![Feature { index: 0, style: 0, shape }];
        let layer = Layer::uniform("layer", style(OutlineMode::Normal, false), features);
        let mut layers = [Layer { outside: Some(fill), ..layer }];
        let terrain = PlanBox { min: Plan::new(-5.0, -5.0), max: Plan::new(5.0, 5.0) };
        let list = DrawList::new(&mut layers, &terrain).unwrap();
        let mut text = Vec::new();
        let (attributes, plan_space, origin) = (&[][..], "", DVec2::ZERO);
        let drawn_by = (Kind::StencilVolume, &TechniqueSettings::default());
        let table = FeatureTable { layers: &layers, list: &list, attributes, plan_space, origin, drawn_by };
        write_features(&table, &mut text).unwrap();
        let written: Value = serde_json::from_slice(&text).unwrap();
        let [outside, outline] = written["features"].as_array().unwrap().as_slice() else {
            panic!("{written}")
        };
        let properties = &outside["properties"];
        assert_eq!((&properties["number"], &properties["fill-invert"]), (&Value::Null, &json!(true)));
        let frame = json!([[-15.0, -15.0], [15.0, -15.0], [15.0, 15.0], [-15.0, 15.0], [-15.0, -15.0]]);
        assert_eq!(
            (&outside["geometry"]["type"], &outside["geometry"]["coordinates"][0]),
            (&json!("Polygon"), &frame)
        );
        assert_eq!(outside["geometry"]["coordinates"].as_array().map(Vec::len), Some(2));
        assert_eq!(
            (&outline["properties"]["number"], &outline["properties"]["fill-invert"]),
            (&json!(0), &Value::Null)
        );
    }

    #[test]
    fn the_plan_is_named_as_gis_programs_read_it_and_attributes_stay_beside_the_style() {
        let polygon = || Shape::Polygon(vec![plan(&[(0.0, 0.0), (4.0, 0.0), (0.0, 4.0)])]);
        let column = |name: &str, values: Vec<Attribute>| Column { name: name.into(), values };
        let text = |text: &str| Attribute::Text(text.into());
        let attributes = [vec![
            column("NAME", vec![text("first"), text("second")]),
            column("fill", vec![Attribute::Integer(7)]),
        ]];
        let both = || vec![polygon(), polygon()];
        let all = written_with(style(OutlineMode::Normal, true), both(), (&attributes, "EPSG:32733"));
        assert_eq!(all["crs"]["properties"]["name"], "urn:ogc:def:crs:EPSG::32733");
        let [first, second] = [0, 1].map(|k| all["features"][k]["properties"].clone());
        assert_eq!((&first["NAME"], &second["NAME"]), (&"first".into(), &"second".into()));
        assert_eq!((&first["fill"], &first["attribute.fill"]), (&"#000000".into(), &7.into()));
        assert!(second["attribute.fill"].is_null());
        let local = written(style(OutlineMode::Normal, true), both());
        assert!(
            local["crs"].is_null()
                && local.get("crs").is_some()
                && local["plan_space"] == "metres without a CRS"
        );
    }

    #[test]
    fn a_stroke_says_what_its_technique_makes_of_its_corners_and_ends() {
        let color = Color([0.0, 0.0, 0.0, 1.0]);
        let line =
            Line { color, width: Width::Metres(1.0), join: Join::Miter { limit: 4.0 }, cap: Cap::Round };
        let drawn = |kind: Kind, said: &TechniqueSettings| {
            let form = (kind.declaration().stroke_form)(said, &line);
            (form.join, form.miter_limit, form.cap)
        };
        let by_default = |kind| drawn(kind, &TechniqueSettings::default());
        assert_eq!(by_default(Kind::StencilVolume), ("none", None, "butt"));
        assert_eq!(by_default(Kind::InverseProjection), ("miter", Some(10.0), "butt"));
        assert_eq!(by_default(Kind::Clipmap), ("algorithm-1", None, "butt"));
        assert_eq!(by_default(Kind::GeometryOverlay), ("none", None, "butt"));
        for kind in [Kind::StaticDecal, Kind::DynamicLine] {
            let (join, limit, cap) = by_default(kind);
            assert_eq!((join, cap), ("miter-round", "round"));
            // A miter of 40 degrees is 1 / sin(20 degrees) half widths long.
            assert!(limit.is_some_and(|limit| (limit - 2.9238).abs() < 1e-4));
        }
        let style = crate::technique::stencil_volume::Settings {
            joins: crate::technique::stencil_volume::VolumeJoins::Style,
            ..Default::default()
        };
        assert_eq!(drawn(Kind::StencilVolume, &style.into()), ("miter", Some(4.0), "round"));
    }

    #[test]
    fn what_nothing_paints_is_left_out_and_the_others_keep_their_numbers() {
        let line = || Shape::Line(vec![plan(&[(0.0, 0.0), (1.0, 0.0)])]);
        let polygon = || Shape::Polygon(vec![plan(&[(0.0, 0.0), (4.0, 0.0), (0.0, 4.0)])]);
        let all = written(style(OutlineMode::Offset, true), vec![line(), polygon()]);
        let [feature] = &all["features"].as_array().unwrap()[..] else { panic!("{all}") };
        assert_eq!(feature["properties"]["number"], 1);
        assert_eq!(feature["properties"]["outline-mode"], "offset");
    }
}
