//! Figs. 2.11, 2.12 and 3.4: the decal grid, its trees and the quadtrees of polygons.

use super::super::drawing::{Drawing, Window};
use super::super::figure::{Figure, Panel, Paper, Scale};
use super::super::shot::{Shot, Tables};
use crate::error::{Error, Result};
use crate::space::Plan;
use crate::technique::Kind;

const NESTED: &str = include_str!("nested.toml");
const SIZE: [f64; 2] = [480.0, 360.0];
/// Cells a side of the scene's grid.
const GRID: usize = 4;
/// The cell that is looked at: the third column from the west, the third row from the south.
const CELL: usize = 2 + 2 * GRID;

pub(super) const FIGURE_2_11: Figure = Figure {
    name: "zechmeister-2.11",
    paper: Paper::Zechmeister,
    number: "Fig. 2.11",
    title: "A grid, and two trees of boxes in a cell",
    caption: "A decal grid of 4 x 4 cells over lines and polygons, and the boxes of the trees of the cell in orange: of its lines' segments and of its polygons.",
    look_for: "boxes hold only what meets the cell; a cell without lines has no tree of lines.",
    draw: figure_2_11,
};

pub(super) const FIGURE_2_12: Figure = Figure {
    name: "zechmeister-2.12",
    paper: Paper::Zechmeister,
    number: "Fig. 2.12",
    title: "A polygon's quadtree",
    caption: "Quadtrees of an exterior and an interior ring: leaves that lie in it (green), outside (yellow), and those with a part of its border (grey).",
    look_for: "only in grey leaves are edges looked at, and of those no more than a few.",
    draw: figure_2_12,
};

pub(super) const FIGURE_3_4: Figure = Figure {
    name: "zechmeister-3.4",
    paper: Paper::Zechmeister,
    number: "Fig. 3.4",
    title: "From a cell to rings",
    caption: "The cell in orange refers to the polygons that meet it, and to those of their rings with a border in it: at the quadtrees' nodes drawn in blue the search begins.",
    look_for: "holes that the cell does not meet are not among them, and the search does not begin at a quadtree's root where a smaller node holds the cell.",
    draw: figure_3_4,
};

/// The scene's structures.
struct Structures {
    shot: Shot,
    frame: Tables,
    window: Window,
    corners: [Plan; 2],
}

type Box4 = [f64; 4];

impl Structures {
    fn of(changes: &[&str]) -> Result<Self> {
        let shot = Shot::of(NESTED, changes)?;
        let buffers: Vec<String> = Kind::StaticDecal.buffer_names();
        let buffers: Vec<&str> = buffers.iter().map(String::as_str).collect();
        let frame = shot.frame(Kind::StaticDecal, &buffers)?;
        let [a, b]: [[f64; 2]; 2] =
            *frame.real::<2>("grid")?.first_chunk().ok_or_else(|| Error::internal("a figure has no grid"))?;
        let corners = [a, b].map(|[x, y]| Plan::new(x, y));
        let window = Window::around(corners, [14.0, 14.0, SIZE[0] - 28.0, SIZE[1] - 28.0]);
        Ok(Self { shot, frame, window, corners })
    }

    /// A drawing with the scene's lines and rings, and the grid.
    fn drawing(&self, title: &str) -> Drawing {
        let mut drawing = Drawing::new(title, SIZE);
        let list = &self.shot.stage.draw_list;
        for item in list.items() {
            let rings: Vec<_> =
                list.area(item).iter().map(|chain| self.window.all(list.vertices_of(chain))).collect();
            drawing.rings(&rings, "sky area faint");
            rings.iter().for_each(|ring| drawing.ring(ring, "soft edge"));
            for chain in list.strokes(item) {
                drawing.line(&self.window.all(list.path_of(chain)), "soft edge thick");
            }
        }
        for k in 0..GRID * GRID {
            self.boxed(&mut drawing, self.cell(k), "grid edge");
        }
        self.boxed(&mut drawing, self.cell(CELL), "orange area");
        drawing
    }

    /// The box of a cell.
    fn cell(&self, k: usize) -> Box4 {
        let [low, high] = self.corners;
        let side = (high - low) / GRID as f64;
        let (x, y) = (low.x + side.x * (k % GRID) as f64, low.y + side.y * (k / GRID) as f64);
        [x, y, x + side.x, y + side.y]
    }

    fn boxed(&self, drawing: &mut Drawing, [west, south, east, north]: Box4, class: &str) {
        let ring = [(west, south), (east, south), (east, north), (west, north)];
        drawing.ring(&ring.map(|(x, y)| self.window.at(Plan::new(x, y))), class);
    }

    /// Some rows of a table.
    fn rows<const N: usize>(&self, name: &str, [first, count]: [u32; 2]) -> Result<Vec<[u32; N]>> {
        let rows =
            self.frame.whole::<N>(name)?.get(first as usize..(first + count) as usize).map(<[_]>::to_vec);
        rows.ok_or_else(|| Error::internal(format!("`{name}` of a figure is cut")))
    }

    /// The row of `cells` of the cell that is looked at.
    fn cell_row(&self) -> Result<[u32; 10]> {
        self.frame
            .whole::<10>("cells")?
            .get(CELL)
            .copied()
            .ok_or_else(|| Error::internal("a figure has no cell"))
    }

    /// Draws the boxes of a tree of the cell.
    fn tree(
        &self,
        drawing: &mut Drawing,
        [nodes, boxes]: [&str; 2],
        part: [u32; 2],
        class: &str,
    ) -> Result<()> {
        let boxes = self.frame.real::<4>(boxes)?;
        for [row] in self.rows::<1>(nodes, part)? {
            if let Some(found) = boxes.get(row as usize) {
                self.boxed(drawing, *found, class);
            }
        }
        Ok(())
    }
}

fn figure_2_11(_: Scale) -> Result<Vec<Panel>> {
    let of = Structures::of(&[])?;
    let cell = of.cell_row()?;
    let mut lines = of.drawing("boxes of lines");
    of.tree(&mut lines, ["line-nodes", "line-boxes"], [cell[0], cell[1]], "pink edge")?;
    let mut polygons = of.drawing("boxes of polygons");
    of.tree(&mut polygons, ["polygon-nodes", "polygon-boxes"], [cell[4], cell[5]], "green edge")?;
    Ok(vec![
        Panel::drawing("the grid", of.drawing("a grid").svg()),
        Panel::drawing("boxes of the cell's segments", lines.svg()),
        Panel::drawing("boxes of the cell's polygons", polygons.svg()),
    ])
}

fn figure_2_12(_: Scale) -> Result<Vec<Panel>> {
    let of = Structures::of(&[])?;
    let rings = of.frame.whole::<4>("rings")?;
    let boxes = of.frame.real::<4>("quadtree-boxes")?;
    let mut panels = Vec::new();
    for (ring, caption) in [(0, "an exterior ring"), (2, "an interior ring")] {
        let [_, _, first, count] =
            *rings.get(ring).ok_or_else(|| Error::internal("a figure's rings are lost"))?;
        let mut drawing = of.drawing(caption);
        for ([kind, _], found) in
            of.rows::<2>("quadtree-nodes", [first, count])?.iter().zip(&boxes[first as usize..])
        {
            let class =
                ["", "gold area", "green area", "soft area"].get(*kind as usize).copied().unwrap_or_default();
            of.boxed(&mut drawing, *found, class_or_none(class));
            of.boxed(&mut drawing, *found, "ink edge thin");
        }
        panels.push(Panel::drawing(caption, drawing.svg()));
    }
    Ok(panels)
}

/// Inner nodes have no area: their children are drawn.
fn class_or_none(class: &str) -> &str {
    if class.is_empty() { "ink edge thin" } else { class }
}

fn figure_3_4(_: Scale) -> Result<Vec<Panel>> {
    let of = Structures::of(&[])?;
    let cell = of.cell_row()?;
    let boxes = of.frame.real::<4>("quadtree-boxes")?;
    let mut drawing = of.drawing("a cell and the rings that it refers to");
    of.tree(&mut drawing, ["polygon-nodes", "polygon-boxes"], [cell[4], cell[5]], "green edge dash")?;
    let rings = of.frame.whole::<4>("rings")?;
    let mut referred = Vec::new();
    for [item, first, count] in of.rows::<3>("areas", [cell[8], cell[9]])? {
        for [ring, node] in of.rows::<2>("ring-parts", [first, count])? {
            let row = rings.get(ring as usize).ok_or_else(|| Error::internal("a figure's rings are lost"))?;
            referred.push(format!("ring {ring} of item {item} at node {}", node - row[2]));
            if let Some(found) = boxes.get(node as usize) {
                of.boxed(&mut drawing, *found, "blue edge thick");
            }
        }
    }
    Ok(vec![Panel::drawing(format!("the cell refers to {}", referred.join(", ")), drawing.svg())])
}
