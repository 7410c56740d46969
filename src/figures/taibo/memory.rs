//! Fig. 10: what each solution keeps.

use super::super::bars::{Group, percentages};
use super::super::figure::{Figure, Panel, Paper, Scale};
use super::super::shot::Shot;
use crate::error::Result;
use crate::technique::Kind;

const JOINT: &str = include_str!("joint.toml");

pub(super) const FIGURE_10: Figure = Figure {
    name: "taibo-10",
    paper: Paper::Taibo,
    number: "Fig. 10",
    title: "Memory of the solutions",
    caption: "Bytes that each solution keeps of lines, relative to the best, for plots, roads and paths in the likeness of the paper's three data sets, a hundredth \
              as many.",
    look_for: "the paper has lines alone at 100 %, 4a close to it, and 3a and 4b the worst. `drapery report --tables=taibo` has the whole data sets, \
               and times (Figs. 11 and 12).",
    draw: figure_10,
};

/// The data sets: closed plots, open rivers, long paths.
const DATA: [(&str, &str); 3] = [
    ("cadastre", "layer.line.generate={ kind = \"parcels\", seed = 1, count = 1500 }"),
    ("rivers", "layer.line.generate={ kind = \"roads\", seed = 2, count = 12200, segment_m = 0.5 }"),
    ("paths", "layer.line.generate={ kind = \"paths\", seed = 3, count = 12200, segment_m = 0.5 }"),
];
const SOLUTIONS: [&str; 6] =
    ["1-lines", "2-polygons", "3a-both", "3b-wireframe", "4a-adjacency", "4b-offsets"];

fn figure_10(_: Scale) -> Result<Vec<Panel>> {
    let group = |(name, data): &(&str, &str)| {
        let outline = "layer.line.outline={ color = \"#1f3f8f\", width_m = 0.2 }";
        let width = "layer.line.line.width_m=0.2";
        let bytes = |solution: &&str| -> Result<(String, f64)> {
            let solution = format!("technique.clipmap.solution=\"{solution}\"");
            let shot = Shot::of(JOINT, &["layer.line.features=", data, outline, width, &solution])?;
            let bytes = shot.frame(Kind::Clipmap, &[])?.count("geometry_bytes");
            Ok((solution, bytes as f64))
        };
        let bytes: Vec<(String, f64)> = SOLUTIONS.iter().map(bytes).collect::<Result<_>>()?;
        let best = bytes.iter().map(|(_, bytes)| *bytes).fold(f64::INFINITY, crate::math::min);
        let bar = |(name, (_, bytes)): (&&str, &(String, f64))| ((*name).to_owned(), 100.0 * bytes / best);
        Ok(Group { name: (*name).to_owned(), bars: SOLUTIONS.iter().zip(&bytes).map(bar).collect() })
    };
    let groups: Vec<Group> = DATA.iter().map(group).collect::<Result<_>>()?;
    Ok(vec![Panel::drawing("bytes, the best is 100 %", percentages("memory of the solutions", &groups))])
}
