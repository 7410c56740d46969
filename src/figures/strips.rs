//! Tessellated lines as the clipmap technique has them.

use super::shot::Shot;
use crate::error::{Error, Result};
use crate::space::Plan;
use crate::technique::Kind;

/// A vertex sequence: left, right, left, right, ...
pub(super) type Strip = Vec<Plan>;

/// The strips of all lines of a scene, and those lines.
pub(super) struct Tessellated {
    pub(super) strips: Vec<Strip>,
    pub(super) paths: Vec<Vec<Plan>>,
}

impl Tessellated {
    /// Those of a scene.
    pub(super) fn of(shot: &Shot) -> Result<Self> {
        let frame = shot.frame(Kind::Clipmap, &["vertices", "strips"])?;
        let vertices = frame.real::<2>("vertices")?;
        let strip = |[_, _, _, first, count]: &[u32; 5]| {
            let range = *first as usize..(first + count) as usize;
            let vertices = vertices.get(range).ok_or_else(|| Error::internal("a figure's strips are cut"))?;
            Ok(vertices.iter().map(|[x, y]| Plan::new(*x, *y)).collect())
        };
        let strips = frame.whole::<5>("strips")?.iter().map(strip).collect::<Result<_>>()?;
        let list = &shot.stage.draw_list;
        let chains = list.items().iter().flat_map(|item| list.strokes(item));
        Ok(Self { strips, paths: chains.map(|chain| list.path_of(chain).to_vec()).collect() })
    }

    /// All points.
    pub(super) fn points(&self) -> impl Iterator<Item = Plan> + '_ {
        self.strips.iter().chain(&self.paths).flatten().copied()
    }
}

/// How a strip is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Primitive {
    /// A triangle of each three vertices in a row.
    Triangles,
    /// A quadrilateral of each two pairs in a row.
    Quads,
}

impl Primitive {
    /// The areas that are drawn of a strip.
    pub(super) fn areas(self, strip: &Strip) -> Vec<Vec<Plan>> {
        match self {
            Self::Triangles => strip.windows(3).map(<[Plan]>::to_vec).collect(),
            Self::Quads => {
                let pairs = strip.as_chunks::<2>().0;
                pairs.windows(2).map(|two| vec![two[0][0], two[0][1], two[1][1], two[1][0]]).collect()
            }
        }
    }
}
