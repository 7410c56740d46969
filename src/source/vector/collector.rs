//! Gathers the features of a file under the rules that all formats share.

use super::VectorFile;
use super::attributes::{Attributes, Wanted};
use crate::crs::Crs;
use crate::error::{Error, Result};
use crate::scene::{Feature, Shape};
use crate::space::Plan;

/// Features so far, and counts of what was left out.
#[derive(Debug, Default)]
pub(super) struct Collector {
    pub(super) features: Vec<Feature>,
    pub(super) crs: Option<Crs>,
    /// What is wrong with the CRS that the file states.
    pub(super) crs_not_read: Option<String>,
    pub(super) notes: Vec<String>,
    pub(super) attributes: Attributes,
    /// Features seen in the file, with those left out.
    pub(super) seen: usize,
    /// Coordinates of polygons, lines and points stored in the file, closing vertices counted.
    pub(super) stored_vertices: usize,
    empty: usize,
    deleted: usize,
    /// Parts of lines that are a single vertex.
    dots: usize,
    /// Rings that enclose nothing.
    thin_rings: usize,
}

impl Collector {
    pub(super) fn new(wanted: Wanted) -> Self {
        Self { attributes: Attributes::new(wanted), ..Self::default() }
    }

    /// Takes what was read of the CRS that the file states, and where it does.
    pub(super) fn state_crs(&mut self, read: Result<Crs>, at: &str) {
        match read {
            Ok(crs) => self.crs = Some(crs),
            Err(e) => self.crs_not_read = Some(format!("the CRS {at} cannot be used: {}", e.what())),
        }
    }

    /// The number in the file of the feature that is being read.
    pub(super) fn current(&self) -> usize {
        self.seen
    }

    /// Ends the current feature.
    pub(super) fn next_feature(&mut self) {
        self.seen += 1;
    }

    /// Adds a (multi-)point of the current feature.
    pub(super) fn add_points(&mut self, points: Vec<Plan>) -> Result<()> {
        let mut parts = vec![points];
        self.admit(&mut parts)?;
        self.push((!parts.is_empty()).then(|| Shape::Points(parts.concat())));
        Ok(())
    }

    /// Counts a geometry without coordinates.
    pub(super) fn leave_out_empty(&mut self) {
        self.empty += 1;
    }

    /// Counts a feature that the file marks as deleted.
    pub(super) fn leave_out_deleted(&mut self) {
        self.deleted += 1;
    }

    /// Adds a polygon of the current feature; closing vertices are taken off.
    pub(super) fn add_polygon(&mut self, rings: Vec<Vec<Plan>>) -> Result<()> {
        self.add_polygons(vec![rings])
    }

    /// Adds a multi-polygon of the current feature, by its members.
    pub(super) fn add_polygons(&mut self, mut members: Vec<Vec<Vec<Plan>>>) -> Result<()> {
        for rings in &mut members {
            self.admit(rings)?;
            for ring in rings.iter_mut() {
                if ring.len() > 1 && ring.first() == ring.last() {
                    ring.pop();
                }
            }
            self.thin_rings += rings.iter().filter(|ring| ring.len() < 3).count();
        }
        members.retain(|rings| !rings.is_empty());
        let shape = match members.len() {
            0 => None,
            1 => members.pop().map(Shape::Polygon),
            _ => Some(Shape::MultiPolygon(members)),
        };
        self.push(shape);
        Ok(())
    }

    /// Adds a (multi-)line of the current feature.
    pub(super) fn add_line(&mut self, mut parts: Vec<Vec<Plan>>) -> Result<()> {
        self.admit(&mut parts)?;
        let (all, had_vertices) = (parts.len(), !parts.is_empty());
        parts.retain(|part| part.len() > 1);
        self.dots += all - parts.len();
        if !(parts.is_empty() && had_vertices) {
            self.push((!parts.is_empty()).then_some(Shape::Line(parts)));
        }
        Ok(())
    }

    /// Refuse what is not finite, drop empty parts, and count.
    fn admit(&mut self, parts: &mut Vec<Vec<Plan>>) -> Result<()> {
        if let Some(p) = parts.iter().flatten().find(|p| !p.is_finite()) {
            return Err(Error::new(format!("the vertex ({}, {}) is not finite", p.x, p.y))
                .help("repair or delete the feature")
                .in_feature(self.current()));
        }
        parts.retain(|part| !part.is_empty());
        self.stored_vertices += parts.iter().map(Vec::len).sum::<usize>();
        Ok(())
    }

    /// Adds a shape to the current feature: to what it has of the kind, polygons to polygons and lines to lines.
    fn push(&mut self, shape: Option<Shape>) {
        let Some(shape) = shape else {
            return self.leave_out_empty();
        };
        let index = self.current();
        let mut own = self.features.iter_mut().rev().take_while(|feature| feature.index == index);
        let kind = |shape: &Shape| (shape.is_area(), matches!(shape, Shape::Points(_)));
        match own.find(|feature| kind(&feature.shape) == kind(&shape)) {
            Some(feature) => join(&mut feature.shape, shape),
            None => self.features.push(Feature { index, style: 0, shape }),
        }
    }

    /// Says what was left out and what looks wrong.
    pub(super) fn finish(&mut self) {
        self.note_count(self.empty, "geometry", "without coordinates left out");
        self.note_count(self.deleted, "feature", "left out, marked as deleted in the .dbf");
        self.note_count(self.dots, "line", "of a single vertex left out");
        let thin = match self.thin_rings {
            1 => "of fewer than 3 vertices: nothing lies in it",
            _ => "of fewer than 3 vertices: nothing lies in them",
        };
        self.note_count(self.thin_rings, "ring", thin);
    }

    fn note_count(&mut self, count: usize, what: &str, fate: &str) {
        let plural = match (count, what) {
            (1, what) => what.to_owned(),
            (_, "geometry") => "geometries".to_owned(),
            (_, what) => format!("{what}s"),
        };
        if count > 0 {
            self.notes.push(format!("{count} {plural} {fate}"));
        }
    }

    pub(super) fn into_file(self) -> VectorFile {
        let (column_names, columns) = self.attributes.into_columns();
        VectorFile {
            features: self.features,
            columns,
            column_names,
            crs: self.crs,
            crs_not_read: self.crs_not_read,
            notes: self.notes,
        }
    }
}

/// Adds a shape to one of the same kind: the members of polygons stay apart.
fn join(shape: &mut Shape, more: Shape) {
    *shape = match (std::mem::replace(shape, Shape::Line(Vec::new())), more) {
        (Shape::Line(mut parts), Shape::Line(mut more)) => {
            parts.append(&mut more);
            Shape::Line(parts)
        }
        (Shape::Points(mut points), Shape::Points(mut more)) => {
            points.append(&mut more);
            Shape::Points(points)
        }
        (own, more) => {
            let mut members = members_of(own);
            members.append(&mut members_of(more));
            Shape::MultiPolygon(members)
        }
    };
}

fn members_of(shape: Shape) -> Vec<Vec<Vec<Plan>>> {
    match shape {
        Shape::MultiPolygon(members) | Shape::Swath { members, .. } => members,
        Shape::Polygon(rings) | Shape::Line(rings) => vec![rings],
        Shape::Points(points) => vec![vec![points]],
    }
}

/// Whether a part has enough points to cover anything: 3 of a ring, 2 of a line, 1 of points.
pub(in crate::source) fn is_drawable(shape: &Shape, part: &[Plan]) -> bool {
    let least = match shape {
        Shape::Polygon(_) | Shape::MultiPolygon(_) | Shape::Swath { .. } => 3,
        Shape::Line(_) => 2,
        Shape::Points(_) => 1,
    };
    part.len() >= least
}
