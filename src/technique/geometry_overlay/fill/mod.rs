//! Fills as triangles on the mesh in use: areas cut as lines are (the paper draws lines alone; 5 leaves areas to others).
//!
//! Input: the draw list in grid coordinates, the triangles of the mesh in use. Output: [`Fills`], and of a view its [`Patch`]es: convex pieces that each lie in
//! one triangle of the mesh, in draw order. Refuses: polygons whose edges cross too often to be told apart, more triangles than can be numbered.
//!
//! A fill's border, as its rule has it, is triangulated once (constrained Delaunay, among the posts); a view cuts these triangles at those of its mesh.

mod piece;

use super::dag::GridPoint;
use super::grid_map::GridMap;
use super::mesh::MeshInUse;
use crate::draw_list::{DrawList, ItemStyle, Role};
use crate::error::{Error, Result};
use crate::index::BoxTree;
use crate::overlay::triangulated;
use crate::parallel;
use crate::space::{Plan, PlanBox, World};
use crate::terrain::lod::{QuadInUse, RightTriangle};
use piece::{Corner, MOST_CORNERS, shared};

/// The fills of a scene as triangles among the posts.
#[derive(Debug, Default)]
pub(super) struct Fills {
    vertices: Vec<GridPoint>,
    triangles: Vec<FillTriangle>,
    /// Over the triangles' boxes.
    tree: BoxTree,
}

/// A triangle of a fill, counter-clockwise.
#[derive(Debug, Clone, Copy)]
pub(super) struct FillTriangle {
    /// The item that it is of.
    pub item: u32,
    /// Numbers of vertices.
    pub corners: [u32; 3],
}

/// What a triangle of a fill has in one of the mesh: a convex polygon in space.
#[derive(Debug, Clone, Copy)]
pub(super) struct Patch {
    /// The item that it is of.
    pub item: u32,
    /// The mesh's triangle.
    pub triangle: RightTriangle,
    /// Its corners.
    pub ground: [World; 3],
    count: u8,
    corners: [World; MOST_CORNERS],
}

impl Patch {
    /// Its corners, counter-clockwise as they are seen from above.
    pub(super) fn corners(&self) -> &[World] {
        &self.corners[..usize::from(self.count)]
    }

    /// Triangles that cover it.
    pub(super) fn fan(&self) -> impl Iterator<Item = [World; 3]> {
        let corners = self.corners();
        (2..corners.len()).map(|k| [corners[0], corners[k - 1], corners[k]])
    }
}

/// Whether an item is an area that can be filled: strokes are drawn by their lines, whatever they are made of.
pub(super) fn is_area(style: &ItemStyle) -> bool {
    matches!(style.role, Role::Fill | Role::Outside) && style.swath.is_none()
}

impl Fills {
    /// Those of a draw list.
    ///
    /// # Errors
    /// When an area's edges cross too often, or there are more triangles than can be numbered.
    pub(super) fn new(list: &DrawList, map: &GridMap) -> Result<Self> {
        let items: Vec<u32> = list.numbered().map(|(number, _)| number).collect();
        let areas: Vec<u32> = items.into_iter().filter(|item| is_area(list.style_of(*item))).collect();
        let made = parallel::map(&areas, |item| {
            let (of, rule) = (&list.items()[*item as usize], list.style_of(*item).rule);
            let ring = |chain| -> Vec<Plan> {
                let path = map.path(list.path_of(chain));
                path.iter().map(|[x, y]| Plan::new(*x, *y)).collect()
            };
            let rings: Vec<Vec<Plan>> = list.border(of).iter().map(ring).collect();
            triangulated(&rings, &|turns| rule.contains(turns))
        });
        let mut all = Self::default();
        for (item, made) in areas.into_iter().zip(made) {
            let made = made?;
            let first = all.vertices.len();
            if first + made.vertices.len() > u32::MAX as usize / 2 {
                return Err(Error::unsupported("geometry-overlay: the fills have too many vertices")
                    .help("leave some out by `where`, or draw polygons as outlines"));
            }
            all.vertices.extend(made.vertices.iter().map(|p| [p.x, p.y]));
            let numbered = |corners: [u32; 3]| corners.map(|k| first as u32 + k);
            let own = made.triangles.iter().map(|of| FillTriangle { item, corners: numbered(*of) });
            all.triangles.extend(own);
        }
        let around =
            |of: &FillTriangle| PlanBox::around(all.places(of).into_iter().map(|[x, y]| Plan::new(x, y)));
        let boxes: Vec<PlanBox> = all.triangles.iter().map(around).collect();
        all.tree = BoxTree::new(&boxes);
        Ok(all)
    }

    /// The vertices: columns and rows of posts.
    pub(super) fn vertices(&self) -> &[GridPoint] {
        &self.vertices
    }

    /// The triangles in draw order.
    pub(super) fn triangles(&self) -> &[FillTriangle] {
        &self.triangles
    }

    fn places(&self, of: &FillTriangle) -> [GridPoint; 3] {
        of.corners.map(|corner| self.vertices[corner as usize])
    }

    /// What the triangles of some quads in use have of fills, in draw order.
    pub(super) fn patches(&self, mesh: &MeshInUse, quads: &[QuadInUse]) -> Vec<Patch> {
        if self.triangles.is_empty() {
            return Vec::new();
        }
        let of_quad = |of: &QuadInUse| {
            let mut patches = Vec::new();
            mesh.for_each_triangle(of.quad, &mut |triangle| self.add_patches(mesh, triangle, &mut patches));
            patches
        };
        let mut all = parallel::map(quads, of_quad).concat();
        all.sort_by_key(|patch| patch.item);
        all
    }

    fn add_patches(&self, mesh: &MeshInUse, triangle: &RightTriangle, patches: &mut Vec<Patch>) {
        let corners = triangle.corners().map(|post| post.map(f64::from));
        let around = PlanBox::around(corners.map(|[x, y]| Plan::new(x, y)));
        let near = self.tree.found(&around);
        let Some(ground) = (!near.is_empty()).then(|| mesh.ground(triangle)).flatten() else { return };
        for number in near {
            let of = &self.triangles[number as usize];
            let shared = shared(self.places(of), triangle);
            if shared.len() < 3 {
                continue;
            }
            let mut corners = [World::default(); MOST_CORNERS];
            let places = shared.iter().filter_map(|corner| match corner {
                Corner::Vertex(at) => Some(ground.at(*at)),
                Corner::Post(corner) => Some(ground.corner(*corner)),
                Corner::Crossing(crossing) => ground.on_edge(crossing),
            });
            let mut count = 0;
            for (corner, place) in corners.iter_mut().zip(places) {
                *corner = place;
                count += 1;
            }
            let on = [0, 1, 2].map(|corner| ground.corner(corner));
            patches.push(Patch { item: of.item, triangle: *triangle, ground: on, count, corners });
        }
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.vertices[..]) + size_of_val(&self.triangles[..]) + self.tree.bytes()
    }
}
