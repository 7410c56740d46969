//! The primitives near a pixel's pieces, brought to the pixel: those that consecutive items have alike are brought, and asked, once.

use super::kept::KeptShapes;
use super::shape::{PixelGround, PixelPrimitive, Verdict};
use crate::footprint::{BorderPart, Primitive};

/// A pixel's primitives.
#[derive(Debug, Default)]
pub(super) struct Shapes {
    all: Vec<PixelPrimitive>,
    /// Of each: whether several items have it, and then what a piece was told.
    answers: Vec<Option<Answer>>,
    /// The primitives of this item so far, of the one before and of that before it (a feature has up to two: fill and outline), with
    /// what a fragment was told of them.
    now: Vec<(Primitive, Told)>,
    before: [Vec<(Primitive, Told)>; 2],
    /// The piece that asks.
    piece: u64,
    kept: KeptShapes,
}

#[derive(Debug, Clone, Copy)]
struct Answer {
    piece: u64,
    verdict: Verdict,
}

/// What a fragment is told of a primitive at first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Told {
    /// All of it is in the stroke's part.
    In,
    /// None of it is, or the edge does not cross it.
    Out,
    /// It cannot be told yet: the shape's index.
    Open(u32),
}

impl Shapes {
    /// Forgets all.
    pub(super) fn clear(&mut self) {
        self.all.clear();
        self.answers.clear();
    }

    /// Another fragment looks at what is near it.
    pub(super) fn begin_fragment(&mut self) {
        self.now.clear();
        self.before.iter_mut().for_each(Vec::clear);
    }

    /// The next of its items follows.
    pub(super) fn begin_item(&mut self) {
        let [last, second_last] = &mut self.before;
        std::mem::swap(last, second_last);
        std::mem::swap(last, &mut self.now);
        self.now.clear();
    }

    /// Another piece asks.
    pub(super) fn begin_piece(&mut self) {
        self.piece += 1;
    }

    /// What a fragment is told of an item's next primitive: of that number among a part's. `asks`: it is one of a crowd, and what the fragment
    /// surely is in or out of is not kept.
    pub(super) fn tell(
        &mut self,
        (primitive, of): (&Primitive, (BorderPart, usize)),
        asks: bool,
        (ground, points): (&PixelGround, &[[f64; 2]]),
        slop: &mut f64,
    ) -> Told {
        let place = self.now.len();
        let mut twins = self.before.iter().filter_map(|item| item.get(place));
        let told = match twins.find(|(before, _)| before == primitive).map(|(_, told)| *told) {
            Some(told) => {
                if let Told::Open(index) = told {
                    self.share(index);
                }
                told
            }
            None => {
                if asks {
                    let shape = ground.shape(&ground.on_facet(primitive));
                    match shape.verdict(ground, points, slop) {
                        Verdict::In => Told::In,
                        Verdict::Out => Told::Out,
                        _ => self.add(shape),
                    }
                } else {
                    let shape = ground.shape(self.kept.of(ground, of, primitive));
                    self.add(shape)
                }
            }
        };
        self.now.push((*primitive, told));
        told
    }

    fn add(&mut self, shape: PixelPrimitive) -> Told {
        let index = self.all.len() as u32;
        self.all.push(shape);
        self.answers.push(None);
        Told::Open(index)
    }

    /// From now on answers are kept.
    fn share(&mut self, index: u32) {
        self.answers[index as usize].get_or_insert(Answer { piece: 0, verdict: Verdict::Stuck });
    }

    /// Whether a shape is an edge of a polygon.
    pub(super) fn is_edge(&self, index: u32) -> bool {
        matches!(self.all[index as usize], PixelPrimitive::Edge { .. })
    }

    /// Where the piece that asks lies of a shape. `slop` grows by what is doubtful, once for all items that have the shape.
    pub(super) fn verdict(
        &mut self,
        index: u32,
        (ground, points): (&PixelGround, &[[f64; 2]]),
        slop: &mut f64,
    ) -> Verdict {
        let shape = &self.all[index as usize];
        match &mut self.answers[index as usize] {
            None => shape.verdict(ground, points, slop),
            Some(answer) if answer.piece == self.piece => answer.verdict,
            Some(answer) => {
                *answer = Answer { piece: self.piece, verdict: shape.verdict(ground, points, slop) };
                answer.verdict
            }
        }
    }
}
