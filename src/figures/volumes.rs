//! Stencil volumes as their technique has them.

use super::shot::Tables;
use crate::error::{Error, Result};
use crate::space::{Plan, World};

/// The buffers that volumes are read from.
pub(super) const VOLUMES: [&str; 4] = ["volumes", "volume-levels", "volume-rings", "volume-corners"];

/// A volume: rings of the plan between two heights.
pub(super) struct Volume {
    pub(super) rings: Vec<Vec<Plan>>,
    pub(super) bottom: f64,
    pub(super) top: f64,
}

impl Volume {
    /// The rings at a height.
    pub(super) fn cap(&self, height: f64) -> Vec<Vec<World>> {
        let lifted = |ring: &Vec<Plan>| ring.iter().map(|p| World::new(p.x, p.y, height)).collect();
        self.rings.iter().map(lifted).collect()
    }

    /// The bottom cap, the top cap, then a wall for each edge, in corners.
    pub(super) fn faces(&self) -> Vec<Vec<World>> {
        let mut faces = [self.cap(self.bottom), self.cap(self.top)].concat();
        for ring in &self.rings {
            for (k, a) in ring.iter().enumerate() {
                let b = ring[(k + 1) % ring.len()];
                let corner = |p: Plan, height: f64| World::new(p.x, p.y, height);
                faces.push(vec![
                    corner(*a, self.bottom),
                    corner(b, self.bottom),
                    corner(b, self.top),
                    corner(*a, self.top),
                ]);
            }
        }
        faces
    }
}

/// All volumes of a frame that was asked for [`VOLUMES`].
pub(super) fn volumes(tables: &Tables) -> Result<Vec<Volume>> {
    let rows = tables.whole::<6>("volumes")?;
    let levels = tables.real::<2>("volume-levels")?;
    let rings = tables.whole::<2>("volume-rings")?;
    let corners = tables.real::<2>("volume-corners")?;
    let part = |[first, count]: [u32; 2]| first as usize..(first + count) as usize;
    let lost = || Error::internal("a figure's volumes are cut");
    let ring = |row: &[u32; 2]| -> Result<Vec<Plan>> {
        let corners = corners.get(part(*row)).ok_or_else(lost)?;
        Ok(corners.iter().map(|[x, y]| Plan::new(*x, *y)).collect())
    };
    let volume = |(row, level): (&[u32; 6], &[f64; 2])| -> Result<Volume> {
        let rings = rings.get(part([row[0], row[1]])).ok_or_else(lost)?;
        let rings = rings.iter().map(ring).collect::<Result<_>>()?;
        Ok(Volume { rings, bottom: level[0], top: level[1] })
    };
    rows.iter().zip(&levels).map(volume).collect()
}
