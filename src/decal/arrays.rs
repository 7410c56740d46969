//! The structures as flat arrays whose rows refer to one another by number, as a graphics processor has them in its storage buffers (Fig. 4.2).
//!
//! What a column says, and how a shader walks it all, is told in the bundle's `README.md` (`src/technique/static_decal/client.md`). Where the thesis has one
//! buffer for each kind of offset, a cell has one row here; a quadtree's leaf keeps the winding number of its corner instead of closing edges.

use super::build::Source;
use super::bvh::Bvh;
use super::cell::{Cell, LineLeaf, Turns};
use super::contents::RingsAs;
use super::decals::Decals;
use super::quadtree::{Kind, LeafEdges, Start};
use super::settings::REACH_OF_40;
use super::settings::{Joins, Outlines};
use super::stroke::{StrokeRules, around};
use crate::draw_list::{DrawList, ItemStyle, Side};
use crate::error::{Error, Result};
use crate::parallel;
use crate::scene::{Cap, Join};
use crate::space::{Plan, PlanBox};

/// The number of no row.
const NONE: u32 = u32::MAX;

/// The structures of static decals as arrays. Coordinates are scene-local metres; boxes are west, south, east, north.
#[derive(Debug, Default)]
pub struct Arrays {
    /// The grid's south-west and north-east corners (Eqs. 4.3, 4.4 need these and how many cells there are).
    pub grid: [[f64; 2]; 2],
    /// Of each cell, column + side * row, the first row and how many there are of: `line_nodes`, `segments`, `polygon_nodes`, `polygons`, `areas`.
    pub cells: Vec<[u32; 10]>,
    /// The nodes of the cells' line trees in the order of a heap (Eqs. 4.5 to 4.7): rows of `line_boxes`, [`u32::MAX`] for an empty node.
    pub line_nodes: Vec<u32>,
    /// Boxes of nodes that are not empty.
    pub line_boxes: Vec<[f64; 4]>,
    /// The leaves of line trees: item; vertices at the start and the end, before the start and after the end; which side counts.
    pub segments: Vec<[u32; 6]>,
    /// As `line_nodes`, of the polygon trees.
    pub polygon_nodes: Vec<u32>,
    /// Boxes of nodes that are not empty.
    pub polygon_boxes: Vec<[f64; 4]>,
    /// The leaves of polygon trees: item, row of `areas`.
    pub polygons: Vec<[u32; 2]>,
    /// The areas of cells: the item that owns it, its first ring part, how many it has.
    pub areas: Vec<[u32; 3]>,
    /// What lies of rings in cells: ring, row of `quadtree_nodes` where it is entered.
    pub ring_parts: Vec<[u32; 2]>,
    /// Rings: the item that owns its area, which of that area's members it belongs to, its first node and how many it has.
    pub rings: Vec<[u32; 4]>,
    /// The rectangles of quadtrees' nodes.
    pub quadtree_boxes: Vec<[f64; 4]>,
    /// Types of nodes (0 internal, 1 out, 2 in, 3 partial), and the first child, 0, the winding number or the row of `quadtree_leaves`.
    pub quadtree_nodes: Vec<[u32; 2]>,
    /// Leaves that are partly in: first edge, edges, winding number of the south-east corner.
    pub quadtree_leaves: Vec<[u32; 3]>,
    /// Edges of leaves: vertices at the start and the end.
    pub quadtree_edges: Vec<[u32; 2]>,
    /// The vertices of lines and rings, and behind them those that only leaf polygons have.
    pub vertices: Vec<[f64; 2]>,
    /// Items in draw order: layer, feature, style.
    pub items: Vec<[u32; 3]>,
    /// Styles: role, rule, cut, join, cap, group.
    pub styles: Vec<[u32; 6]>,
    /// Styles: red, green, blue, alpha, half the width, miter limit, opacity of the group.
    pub style_values: Vec<[f64; 7]>,
}

impl Decals<'_> {
    /// Builds all cells as the thesis has them, each ring by its quadtree, and tells them as arrays; `progress` is told the share that is built.
    /// (The cells that points are looked up in have something quicker instead of most quadtrees.)
    ///
    /// # Errors
    /// When an array has more rows than can be numbered.
    pub fn arrays(&self, progress: &(dyn Fn(f64) + Sync)) -> Result<Arrays> {
        let side = self.grid.side();
        let of_row = |row: usize| -> Vec<Option<Cell>> {
            let numbers = (0..side).map(|column| column + side * row as u32);
            numbers.map(|number| self.cell_around(&self.grid.box_of(number), RingsAs::Trees)).collect()
        };
        let cells = parallel::map_telling(side as usize, progress, of_row);
        let (list, bounds) = (self.list(), self.grid.bounds());
        let mut all = Arrays {
            grid: [point(bounds.min), point(bounds.max)],
            vertices: list.vertices().iter().map(|at| point(*at)).collect(),
            items: list.items().iter().map(|item| [item.layer, item.feature, item.style]).collect(),
            ..Arrays::default()
        };
        for (style, rules) in list.styles().iter().zip(&self.source.rules) {
            all.add_style(style, rules.as_ref());
        }
        // Trees of rings that no cell has a part of are not told: whether they are there depends on what was looked up.
        let mut is_used = vec![false; self.source.rings().len()];
        for cell in cells.iter().flatten().flatten() {
            trees_of(cell).for_each(|(ring, _)| is_used[ring as usize] = true);
        }
        for (ring, is_used) in (0..).zip(is_used) {
            all.add_ring(&self.source, ring, is_used);
        }
        for cell in cells.iter().flatten() {
            match cell {
                Some(cell) => all.add_cell(cell, self),
                None => all.cells.push([0; 10]),
            }
        }
        all.checked()
    }

    /// Which side of a segment counts where only one does (4.4.1): 1 the left, 2 the right; 0 both, or what the polygon says.
    fn side_that_counts(&self, leaf: LineLeaf) -> u32 {
        match self.list().style_of(leaf.item).cut {
            Some(side) if self.settings.outlines == Outlines::Side => {
                let is_left_inside = self.sides.is_left_inside(&self.source, leaf.item, leaf.chain);
                if is_left_inside == (side == Side::Inside) { 1 } else { 2 }
            }
            _ => 0,
        }
    }
}

impl Arrays {
    fn add_style(&mut self, style: &ItemStyle, rules: Option<&StrokeRules>) {
        let [role, rule, cut] = style.codes();
        let (join, limit) = rules.map_or((0, 0.0), |rules| match (rules.join, rules.joins) {
            (Join::Round, _) => (0, 0.0),
            (Join::Bevel, _) => (1, 0.0),
            (Join::Miter { limit }, Joins::Style) => (2, limit),
            (Join::Miter { .. }, Joins::Thesis) => (3, REACH_OF_40),
        });
        let cap = rules.map_or(0, |rules| match rules.cap {
            Cap::Butt => 0,
            Cap::Square => 1,
            Cap::Round => 2,
        });
        self.styles.push([role, rule, cut, join, cap, style.group.map_or(NONE, |group| group.layer)]);
        let [r, g, b, a] = style.paint.0;
        let half = rules.map_or(0.0, |rules| rules.half);
        self.style_values.push([r, g, b, a, half, limit, style.group.map_or(1.0, |group| group.opacity)]);
    }

    /// The next ring, with its quadtree where that is used.
    fn add_ring(&mut self, source: &Source, ring: u32, is_used: bool) {
        let (chain, owner) = (source.chain_of(ring), source.rings()[ring as usize].owner);
        let first = self.quadtree_nodes.len() as u32;
        if !is_used {
            self.rings.push([owner, chain.member, first, 0]);
            return;
        }
        let quadtree = source.quadtree(ring);
        let nodes = quadtree.nodes();
        self.rings.push([owner, chain.member, first, nodes.len() as u32]);
        let edges = quadtree.leaf_edges();
        let (first_edge, first_vertex) = (self.quadtree_edges.len(), self.vertices.len() as u32);
        for (plan, kind) in nodes {
            self.quadtree_boxes.push(corners(&plan));
            self.quadtree_nodes.push(match kind {
                Kind::Internal(children) => [0, first + children],
                Kind::Full(0) => [1, 0],
                Kind::Full(turns) => [2, turns as u32],
                Kind::Partial(leaf) => {
                    let (range, turns) = quadtree.leaf(leaf).unwrap_or((0..chain.count as usize, 0));
                    // Nothing of a polygon that is clipped and closed winds around its leaf's corner.
                    let turns = if matches!(edges, Some(LeafEdges::Segments(..))) { 0 } else { turns };
                    let edges = [(first_edge + range.start) as u32, range.len() as u32];
                    self.quadtree_leaves.push([edges[0], edges[1], turns as u32]);
                    [3, self.quadtree_leaves.len() as u32 - 1]
                }
            });
        }
        match edges {
            Some(LeafEdges::Numbers(numbers)) => {
                self.quadtree_edges.extend(numbers.iter().map(|k| [*k, k + 1]))
            }
            Some(LeafEdges::Segments(vertices, segments)) => {
                self.vertices.extend(vertices.iter().map(|at| point(*at)));
                self.quadtree_edges.extend(segments.iter().map(|ends| ends.map(|k| first_vertex + k)));
            }
            None => self.quadtree_edges.extend((chain.first..chain.first + chain.count).map(|k| [k, k + 1])),
        }
    }

    fn add_cell(&mut self, cell: &Cell, decals: &Decals) {
        let first = self.ends();
        add_tree(&cell.lines, &mut self.line_nodes, &mut self.line_boxes);
        let segment = |leaf: &LineLeaf| segment(decals.list(), *leaf, decals.side_that_counts(*leaf));
        self.segments.extend(cell.segments.iter().map(segment));
        add_tree(&cell.polygons, &mut self.polygon_nodes, &mut self.polygon_boxes);
        let area_of_all = |area: u32| if area == NONE { NONE } else { first[4] as u32 + area };
        self.polygons.extend(cell.fills.iter().map(|fill| [fill.item, area_of_all(fill.area)]));
        let first_part = self.ring_parts.len();
        for (area, part) in (0..).zip(&cell.areas) {
            let count = cell.rings_of(area).len() as u32;
            self.areas.push([part.owner, first_part as u32 + part.first, count]);
        }
        let entered = |ring: u32, node: u32| [ring, self.rings[ring as usize][2] + node];
        self.ring_parts.extend(trees_of(cell).map(|(ring, start)| entered(ring, start.node())));
        let ends = self.ends();
        let mut row = [0; 10];
        for k in 0..ends.len() {
            (row[2 * k], row[2 * k + 1]) = (first[k] as u32, (ends[k] - first[k]) as u32);
        }
        self.cells.push(row);
    }

    /// Where the next cell's parts start.
    fn ends(&self) -> [usize; 5] {
        [
            self.line_nodes.len(),
            self.segments.len(),
            self.polygon_nodes.len(),
            self.polygons.len(),
            self.areas.len(),
        ]
    }

    /// Itself, if all its rows have a number.
    fn checked(self) -> Result<Self> {
        let parts = [
            self.ring_parts.len(),
            self.quadtree_nodes.len(),
            self.quadtree_edges.len(),
            self.vertices.len(),
        ];
        let most = self.ends().into_iter().chain(parts).max().unwrap_or(0);
        if most < NONE as usize {
            return Ok(self);
        }
        let what = format!(
            "the structures of static decals have {most} rows in one array, more than can be numbered"
        );
        Err(Error::unsupported(what)
            .help("choose a smaller technique.static-decal.grid, or ask for no structures"))
    }
}

/// The rings of a cell whose rings are kept as trees, and where these are entered.
fn trees_of(cell: &Cell) -> impl Iterator<Item = (u32, Start)> {
    cell.rings.iter().filter_map(|part| match part.turns {
        Turns::Tree { ring, start } => Some((ring, start)),
        Turns::Throughout(_) | Turns::Own { .. } => None,
    })
}

/// Adds a cell's tree: all nodes, level by level, those that are empty last in their level.
fn add_tree(tree: &Bvh, nodes: &mut Vec<u32>, boxes: &mut Vec<[f64; 4]>) {
    let (own, counts) = tree.nodes();
    let (mut first, mut places) = (boxes.len() as u32, 1);
    for count in counts {
        nodes.extend(first..first + count);
        nodes.extend((count as usize..places).map(|_| NONE));
        first += count;
        places *= tree.children();
    }
    boxes.extend(own.iter().map(|of| corners(&of.bounds())));
}

fn segment(list: &DrawList, leaf: LineLeaf, side: u32) -> [u32; 6] {
    let chain = &list.strokes(&list.items()[leaf.item as usize])[leaf.chain as usize];
    let [before, to, after] = around(list.path_of(chain).len(), chain.is_closed, leaf.vertex as usize);
    let vertex = |place: Option<usize>| place.map_or(NONE, |place| chain.first + place as u32);
    let from = chain.first + leaf.vertex;
    // A dot ends where it starts.
    [
        leaf.item,
        from,
        to.map_or(from, |place| chain.first + place as u32),
        vertex(before),
        vertex(after),
        side,
    ]
}

fn point(at: Plan) -> [f64; 2] {
    [at.x, at.y]
}

fn corners(of: &PlanBox) -> [f64; 4] {
    [of.min.x, of.min.y, of.max.x, of.max.y]
}
