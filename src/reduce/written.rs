//! A draft as a scene file.

use super::draft::{Draft, DraftLayer};
use crate::scene::{Camera, Cap, Color, Dash, Fill, Join, Line, OutlineMode, Projection, Rule, Shape, Width};
use crate::space::Plan;
use std::fmt::Write;

impl Draft {
    /// The scene file.
    pub fn text(&self) -> String {
        // Tables come after plain values, and layers after tables: nothing that follows belongs to a table above it.
        let mut text = toml::to_string(&self.head).unwrap_or_default();
        let image = self.image;
        let [color, opacity] = color(image.background);
        let alpha = if opacity == "1.0" { String::new() } else { format!(" # opacity {opacity}") };
        let background = with_alpha(image.background).unwrap_or(color);
        let _ = writeln!(
            text,
            "\n[image]\nwidth = {}\nheight = {}\nbackground = {background}{alpha}",
            image.width, image.height
        );
        text += &camera(&self.camera);
        self.layers.iter().filter(|layer| is_painted(layer)).for_each(|layer| text += &layer_text(layer));
        text
    }
}

fn is_painted(layer: &DraftLayer) -> bool {
    !layer.features.is_empty() || layer.outside.is_some()
}

fn camera(camera: &Camera) -> String {
    let point = |p: [f64; 3]| format!("[{:?}, {:?}, {:?}]", p[0], p[1], p[2]);
    let (eye, target, up) = (camera.eye, camera.target, camera.up);
    let projection = match camera.projection {
        Projection::Perspective { fov_y_deg } => format!("fov_y_deg = {fov_y_deg:?}"),
        Projection::Orthographic { height_m } => {
            format!("projection = \"orthographic\"\nheight_m = {height_m:?}")
        }
    };
    let far = camera.far_m.map_or(String::new(), |far| format!("far_m = {far:?}\n"));
    format!(
        "\n[camera]\neye = {}\ntarget = {}\nup = {}\n{projection}\nnear_m = {:?}\n{far}",
        point([eye.x, eye.y, eye.z]),
        point([target.x, target.y, target.z]),
        point(up.to_array()),
        camera.near_m
    )
}

fn layer_text(layer: &DraftLayer) -> String {
    let mut text = format!("\n[[layer]]\nname = {}\n", toml::Value::from(layer.name.as_str()));
    if layer.opacity < 1.0 {
        let _ = writeln!(text, "opacity = {:?}", layer.opacity);
    }
    text += "features = [\n";
    for shape in &layer.features {
        let written = match shape {
            Shape::Polygon(rings) => format!("polygon = {}", paths(rings)),
            Shape::Line(lines) => format!("line = {}", paths(lines)),
            Shape::Points(points) => format!("points = {}", path(points)),
            // Members are features of their own.
            Shape::MultiPolygon(members) | Shape::Swath { members, .. } => {
                let members: Vec<String> = members.iter().map(|rings| paths(rings)).collect();
                format!("polygon = {}", members.join(" },\n  { polygon = "))
            }
        };
        let _ = writeln!(text, "  {{ {written} }},");
    }
    text += "]\n";
    let fill = |fill: &Fill, more: &str| {
        let rule = if fill.rule == Rule::EvenOdd { "" } else { ", rule = \"nonzero\"" };
        format!("fill = {{ {}{rule}{more} }}\n", paint(fill.color))
    };
    let style = &layer.style;
    text.extend(layer.outside.iter().map(|outside| fill(outside, ", invert = true")));
    text.extend(style.fill.iter().filter(|_| layer.outside.is_none()).map(|inside| fill(inside, "")));
    text.extend(style.outline.iter().map(|outline| {
        let mode = match outline.mode {
            OutlineMode::Inset => ", mode = \"inset\"",
            OutlineMode::Normal => "",
            OutlineMode::Offset => ", mode = \"offset\"",
        };
        let dash =
            style.outline_dash.map_or(String::new(), |dash| cap(&outline.line).to_owned() + &dashes(&dash));
        format!("outline = {{ {}{mode}{dash} }}\n", stroke(&outline.line))
    }));
    text.extend(style.line.iter().map(|line| {
        let dash = style.line_dash.as_ref().map_or(String::new(), dashes);
        format!("line = {{ {}{}{dash} }}\n", stroke(line), cap(line))
    }));
    text.extend(
        style
            .point
            .iter()
            .map(|line| format!("point = {{ {}, {} }}\n", paint(line.color), width(line.width))),
    );
    text
}

fn cap(line: &Line) -> &'static str {
    match line.cap {
        Cap::Butt => "",
        Cap::Square => ", cap = \"square\"",
        Cap::Round => ", cap = \"round\"",
    }
}

fn dashes(dash: &Dash) -> String {
    let offset =
        if dash.offset() == 0.0 { String::new() } else { format!(", dash_offset = {:?}", dash.offset()) };
    format!(", dash = {:?}{offset}", dash.lengths())
}

fn stroke(line: &Line) -> String {
    let join = match line.join {
        Join::Round => String::new(),
        Join::Miter { limit } => format!(", join = \"miter\", miter_limit = {limit:?}"),
        Join::Bevel => ", join = \"bevel\"".into(),
    };
    format!("{}, {}{join}", paint(line.color), width(line.width))
}

fn width(width: Width) -> String {
    match width {
        Width::Metres(metres) => format!("width_m = {metres:?}"),
        Width::Pixels(pixels) => format!("width_px = {pixels:?}"),
    }
}

fn paint(of: Color) -> String {
    let [color, opacity] = color(of);
    format!("color = {color}, opacity = {opacity}")
}

/// Red, green and blue as a colour of CSS, in quotes, and alpha as a number.
fn color(Color([r, g, b, a]): Color) -> [String; 2] {
    let code = |v: f64| (v * 255.0).round();
    let is_code = [r, g, b].iter().all(|v| (v * 255.0 - code(*v)).abs() < 1e-9);
    let color = match is_code {
        true => format!("\"#{:02x}{:02x}{:02x}\"", code(r) as u8, code(g) as u8, code(b) as u8),
        false => format!("\"rgb({:?}% {:?}% {:?}%)\"", r * 100.0, g * 100.0, b * 100.0),
    };
    [color, format!("{a:?}")]
}

/// A colour of four codes; `None`: it has others.
fn with_alpha(Color(values): Color) -> Option<String> {
    let codes = values.map(|v| (v * 255.0).round());
    let is_code = values.iter().zip(codes).all(|(v, code)| (v * 255.0 - code).abs() < 1e-9);
    let [r, g, b, a] = codes.map(|code| code as u8);
    is_code.then(|| format!("\"#{r:02x}{g:02x}{b:02x}{a:02x}\""))
}

fn path(points: &[Plan]) -> String {
    let points: Vec<String> = points.iter().map(|p| format!("[{:?}, {:?}]", p.x, p.y)).collect();
    format!("[{}]", points.join(", "))
}

/// One path, or several.
fn paths(parts: &[Vec<Plan>]) -> String {
    match parts {
        [one] => path(one),
        several => {
            let several: Vec<String> = several.iter().map(|part| path(part)).collect();
            format!("[{}]", several.join(", "))
        }
    }
}
