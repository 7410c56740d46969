//! Fig. 5: a concave polygon as a fan of triangles.

use super::super::drawing::{Drawing, Window};
use super::super::figure::{Figure, Panel, Paper, Scale};
use super::super::pictures::magnified;
use super::super::shot::{Shot, Tables};
use super::super::volumes::{VOLUMES, Volume, volumes};
use crate::buffer::Look;
use crate::error::{Error, Result};
use crate::output::{Npy, look};
use crate::space::Plan;
use crate::technique::Kind;

const CONCAVE: &str = include_str!("concave.toml");
const SIZE: [f64; 2] = [480.0, 360.0];

pub(super) const FIGURE_5: Figure = Figure {
    name: "schneider-klein-5",
    paper: Paper::SchneiderKlein,
    number: "Fig. 5",
    title: "A concave polygon as a fan",
    caption: "The caps of a volume over a concave polygon with a hole: a fan of triangles from one corner, of which some face up and some down; how many faces of each \
              kind cover each pixel, and the count that is left.",
    look_for: "what the fan covers outside of the polygon and in its hole is covered by as many faces of one kind as of the other.",
    draw: figure_5,
};

fn figure_5(_: Scale) -> Result<Vec<Panel>> {
    let shot = Shot::of(CONCAVE, &[])?;
    let planes = ["stencil-front", "stencil-back", "stencil"];
    let frame = shot.frame(Kind::StencilVolume, &[&VOLUMES[..], &planes].concat())?;
    let all = volumes(&frame)?;
    let volume = all.first().ok_or_else(|| Error::internal("a figure's volume is lost"))?;
    let [up, down] = [true, false].map(|is_up| fan(volume, is_up));
    Ok(vec![
        Panel::drawing("triangles of the fan that face up", up),
        Panel::drawing("triangles that face down", down),
        counted(&frame, "stencil-front", "faces that face the eye")?,
        counted(&frame, "stencil-back", "faces that face away")?,
        counted(&frame, "stencil", "the count: one in the polygon, nought elsewhere")?,
        Panel::picture("the mask applied", magnified(frame.image(), 3)),
    ])
}

/// A buffer of counts, in colours.
fn counted(frame: &Tables, name: &str, caption: &str) -> Result<Panel> {
    let picture = look(Npy::new(frame.plane(name)?)?, Look::Count);
    let picture = picture.ok_or_else(|| Error::internal("a figure's counts cannot be seen"))?;
    Ok(Panel::picture(caption, magnified(&picture, 3)))
}

/// The triangles of a cap's fan that face up, or down, with the rings.
fn fan(volume: &Volume, is_up: bool) -> String {
    let window =
        Window::around(volume.rings.iter().flatten().copied(), [20.0, 20.0, SIZE[0] - 40.0, SIZE[1] - 40.0]);
    let mut drawing = Drawing::new("a fan", SIZE);
    let first = volume.rings.first().and_then(|ring| ring.first()).copied().unwrap_or_default();
    for ring in &volume.rings {
        for (k, a) in ring.iter().enumerate() {
            let triangle: [Plan; 3] = [first, *a, ring[(k + 1) % ring.len()]];
            let turn = (triangle[1] - first).perp_dot(triangle[2] - first);
            if turn != 0.0 && (turn > 0.0) == is_up {
                let color = if is_up { "blue" } else { "orange" };
                drawing.ring(&window.all(&triangle), &format!("{color} area"));
                drawing.ring(&window.all(&triangle), &format!("{color} edge thin"));
            }
        }
    }
    volume.rings.iter().for_each(|ring| drawing.ring(&window.all(ring), "ink edge"));
    drawing.dot(window.at(first), 4.0, "ink dot");
    drawing.svg()
}
