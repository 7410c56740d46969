//! The lines and rings of items, scene-local, and heights of the mesh under them.

use serde_json::Value;

use crate::bundle::Bundle;

pub type Point = [f64; 2];

/// An item of `items.npy` with what is drawn of its feature.
pub struct Item {
    /// 0 a fill, 1 what is outside, 2 an outline, 3 a line, 4 a point.
    pub kind: u32,
    pub rule: u32,
    /// Of an outline: 0 all of it, 1 its polygon's inside, 2 its outside.
    pub side: u32,
    pub style: Value,
    /// What is drawn as a stroke: lines, rings, dashes, points.
    pub chains: Vec<Chain>,
    /// The rings of each member.
    pub members: Vec<Vec<Vec<Point>>>,
}

/// Vertices, no two that follow one another alike; a closed chain's first one stands once.
pub struct Chain {
    pub points: Vec<Point>,
    pub closed: bool,
}

impl Chain {
    fn new(mut points: Vec<Point>, closed: bool) -> Self {
        points.dedup();
        if closed && points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        Self { closed: closed && points.len() > 1, points }
    }
}

impl Item {
    pub fn width_px(&self) -> Option<f64> {
        self.style["stroke-width-px"].as_f64().filter(|_| self.kind >= 2)
    }

    pub fn width_m(&self) -> Option<f64> {
        self.style["stroke-width-m"].as_f64().filter(|_| self.kind >= 2)
    }
}

fn points(of: &Value, origin: &[f64]) -> Vec<Point> {
    let number = |p: &Value, axis: usize| p[axis].as_f64().unwrap_or(0.0) - origin[axis];
    of.as_array().into_iter().flatten().map(|p| [number(p, 0), number(p, 1)]).collect()
}

fn lists(of: &Value) -> impl Iterator<Item = &Value> {
    of.as_array().into_iter().flatten()
}

/// All items, in draw order.
pub fn items(bundle: &Bundle) -> Result<Vec<Item>, String> {
    let origin = bundle.numbers(&["origin"]);
    let mut found = Vec::new();
    for row in bundle.table("items.npy")?.0.chunks_exact(6) {
        let feature = bundle.feature(row[0] as u64, row[1] as u64)?;
        let (geometry, style) = (&feature["geometry"], &feature["properties"]);
        let coordinates = &geometry["coordinates"];
        let rings = |of: &Value| lists(of).map(|ring| points(ring, &origin)).collect::<Vec<_>>();
        let members: Vec<Vec<Vec<Point>>> = match geometry["type"].as_str() {
            Some("Polygon") => vec![rings(coordinates)],
            Some("MultiPolygon") => lists(coordinates).map(rings).collect(),
            _ => Vec::new(),
        };
        let kind = row[2] as u32;
        let open = |line: &Value| Chain::new(points(line, &origin), false);
        let chains = match geometry["type"].as_str() {
            _ if kind < 2 => Vec::new(),
            _ if !style["dashes"].is_null() => lists(&style["dashes"]).map(open).collect(),
            Some("Point") => {
                vec![Chain::new(points(&Value::Array(vec![coordinates.clone()]), &origin), false)]
            }
            Some("MultiPoint") => {
                points(coordinates, &origin).into_iter().map(|p| Chain::new(vec![p], false)).collect()
            }
            Some("LineString") => vec![open(coordinates)],
            Some("MultiLineString") => lists(coordinates).map(open).collect(),
            _ => members.iter().flatten().map(|ring| Chain::new(ring.clone(), true)).collect(),
        };
        found.push(Item {
            kind,
            rule: row[3] as u32,
            side: row[4] as u32,
            style: style.clone(),
            chains,
            members,
        });
    }
    Ok(found)
}

/// The winding number of rings around a point.
pub fn winding(rings: &[Vec<Point>], p: Point) -> i32 {
    let mut sum = 0;
    for ring in rings {
        for (k, a) in ring.iter().enumerate() {
            let b = ring[(k + 1) % ring.len()];
            let turn = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
            if (a[1] > p[1]) != (b[1] > p[1]) && (turn > 0.0) == (b[1] > a[1]) {
                sum += if b[1] > a[1] { 1 } else { -1 };
            }
        }
    }
    sum
}

/// Whether any member holds a point, by the item's rule.
pub fn holds(item: &Item, p: Point) -> bool {
    item.members.iter().any(|rings| match (item.rule, winding(rings, p)) {
        (0, sum) => sum % 2 != 0,
        (_, sum) => sum != 0,
    })
}

/// Triangles over the plan, found by a grid of cells.
pub struct Heights {
    vertices: Vec<f64>,
    triangles: Vec<[usize; 3]>,
    low: Point,
    cell: f64,
    columns: usize,
    cells: Vec<Vec<u32>>,
    /// The lowest and the highest vertex.
    pub range: [f64; 2],
    pub resolution: f64,
}

impl Heights {
    pub fn new(bundle: &Bundle) -> Result<Self, String> {
        let vertices = bundle.table("mesh.vertices.npy")?.0;
        let rows = bundle.table("mesh.triangles.npy")?.0;
        let is_there = |t: &&[f64]| t[0] != f64::from(u32::MAX);
        let triangles: Vec<[usize; 3]> = rows
            .chunks_exact(3)
            .filter(is_there)
            .map(|t| [t[0] as usize, t[1] as usize, t[2] as usize])
            .collect();
        let of = |axis: usize| vertices.iter().skip(axis).step_by(3).copied();
        let least = |axis| of(axis).fold(f64::INFINITY, f64::min);
        let most = |axis| of(axis).fold(f64::NEG_INFINITY, f64::max);
        let low = [least(0), least(1)];
        let size = [most(0) - low[0], most(1) - low[1]];
        let cell = (size[0] * size[1] / triangles.len().max(1) as f64).sqrt().max(1e-9);
        let columns = (size[0] / cell) as usize + 1;
        let mut cells = vec![Vec::new(); columns * ((size[1] / cell) as usize + 1)];
        let at = |k: usize| [vertices[3 * k], vertices[3 * k + 1]];
        for (number, triangle) in triangles.iter().enumerate() {
            let corners = triangle.map(at);
            let place = |axis: usize, up: bool| {
                let all = corners.iter().map(|c| c[axis]);
                let end = if up {
                    all.fold(f64::NEG_INFINITY, f64::max)
                } else {
                    all.fold(f64::INFINITY, f64::min)
                };
                ((end - low[axis]) / cell) as usize
            };
            for row in place(1, false)..=place(1, true) {
                for column in place(0, false)..=place(0, true) {
                    cells[row * columns + column].push(number as u32);
                }
            }
        }
        let resolution = bundle
            .number(&["terrain_resolution"])
            .ok_or("the bundle does not say how far apart posts are")?;
        let range = [least(2), most(2)];
        Ok(Self { triangles, low, cell, columns, cells, range, resolution, vertices })
    }

    /// The height over a point; beside the mesh the middle of all.
    pub fn over(&self, p: Point) -> f64 {
        let middle = (self.range[0] + self.range[1]) / 2.0;
        let at = [0, 1].map(|axis| (p[axis] - self.low[axis]) / self.cell);
        if at[0] < 0.0 || at[1] < 0.0 || at[0] as usize >= self.columns {
            return middle;
        }
        let Some(near) = self.cells.get(at[1] as usize * self.columns + at[0] as usize) else {
            return middle;
        };
        for triangle in near {
            let [a, b, c] = self.triangles[*triangle as usize].map(|k| &self.vertices[3 * k..3 * k + 3]);
            let cross = |p: &[f64], q: &[f64], r: &[f64]| {
                (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
            };
            let weights = [cross(b, c, &p), cross(c, a, &p), cross(a, b, &p)];
            if weights.iter().all(|w| *w >= 0.0) {
                let all: f64 = weights.iter().sum();
                return (weights[0] * a[2] + weights[1] * b[2] + weights[2] * c[2]) / all;
            }
        }
        middle
    }
}
