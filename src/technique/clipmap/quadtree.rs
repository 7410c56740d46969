//! Which of many boxes meet one: a quadtree whose cells are those of the texture's tiles.
//!
//! "Strongly based on the hierarchical organization of the scene graph contents adapted to the tile structure of the texture
//! cache" (4.4.1): a box lies in the smallest cell that holds all of it, so that a tile finds its own without looking at the rest.

use crate::space::{Plan, PlanBox, SmallBox};

/// A cell with no more boxes than this is not cut.
const FEW: usize = 16;

/// Cells are not cut more often than this: those of a texture of 2^20 texels are as large as a texel then.
const DEEPEST: u32 = 20;

#[derive(Debug, Clone, Copy)]
struct Cell {
    /// Its own boxes in `order`.
    own: (u32, u32),
    /// Its four children from this cell on; 0: none.
    children: u32,
}

/// Boxes in the cells of a square.
#[derive(Debug)]
pub(super) struct Quadtree {
    square: PlanBox,
    cells: Vec<Cell>,
    /// Numbers of boxes, those of a cell together.
    order: Vec<u32>,
    boxes: Vec<SmallBox>,
}

impl Quadtree {
    /// A tree over boxes; those that reach out of the square are found too.
    pub(super) fn new(boxes: &[PlanBox], square: PlanBox) -> Self {
        let root = Cell { own: (0, 0), children: 0 };
        let mut tree =
            Self { square, cells: vec![root], order: Vec::with_capacity(boxes.len()), boxes: Vec::new() };
        let all = (0..boxes.len() as u32).filter(|k| !boxes[*k as usize].is_empty()).collect();
        tree.fill(0, square, 0, all, boxes);
        tree.boxes = tree.order.iter().map(|k| SmallBox::around(&boxes[*k as usize])).collect();
        tree
    }

    fn fill(&mut self, cell: usize, square: PlanBox, depth: u32, numbers: Vec<u32>, boxes: &[PlanBox]) {
        let start = self.order.len() as u32;
        if numbers.len() <= FEW || depth == DEEPEST {
            self.order.extend(numbers);
            self.cells[cell].own = (start, self.order.len() as u32);
            return;
        }
        let quarters = quarters(&square);
        let mut parts: [Vec<u32>; 4] = Default::default();
        for k in numbers {
            match quarters.iter().position(|quarter| quarter.contains(&boxes[k as usize])) {
                Some(quarter) => parts[quarter].push(k),
                None => self.order.push(k),
            }
        }
        self.cells[cell].own = (start, self.order.len() as u32);
        if parts.iter().any(|part| !part.is_empty()) {
            let first = self.cells.len();
            self.cells[cell].children = first as u32;
            self.cells.extend([Cell { own: (0, 0), children: 0 }; 4]);
            for (k, (part, quarter)) in parts.into_iter().zip(quarters).enumerate() {
                self.fill(first + k, quarter, depth + 1, part, boxes);
            }
        }
    }

    /// Adds the numbers of all boxes that meet `wanted` to `out`, in no order.
    pub(super) fn query(&self, wanted: &PlanBox, out: &mut Vec<u32>) {
        self.visit(0, &self.square, wanted, &SmallBox::around(wanted), out);
    }

    fn visit(&self, cell: usize, square: &PlanBox, wanted: &PlanBox, small: &SmallBox, out: &mut Vec<u32>) {
        let Cell { own, children } = self.cells[cell];
        let own = own.0 as usize..own.1 as usize;
        let numbers = self.order[own.clone()].iter().zip(&self.boxes[own]);
        out.extend(numbers.filter(|(_, of)| of.meets(small)).map(|(k, _)| *k));
        if children != 0 {
            for (k, quarter) in quarters(square).iter().enumerate() {
                if quarter.meets(wanted) {
                    self.visit(children as usize + k, quarter, wanted, small, out);
                }
            }
        }
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.cells[..]) + size_of_val(&self.order[..]) + size_of_val(&self.boxes[..])
    }
}

fn quarters(square: &PlanBox) -> [PlanBox; 4] {
    let (min, max) = (square.min, square.max);
    let middle = Plan::new(0.5 * (min.x + max.x), 0.5 * (min.y + max.y));
    [
        PlanBox { min, max: middle },
        PlanBox { min: Plan::new(middle.x, min.y), max: Plan::new(max.x, middle.y) },
        PlanBox { min: Plan::new(min.x, middle.y), max: Plan::new(middle.x, max.y) },
        PlanBox { min: middle, max },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn plan_box() -> impl Strategy<Value = PlanBox> {
        (-20.0..120.0f64, -20.0..120.0f64, 0.0..8.0f64, 0.0..8.0f64)
            .prop_map(|(x, y, w, h)| PlanBox { min: Plan::new(x, y), max: Plan::new(x + w, y + h) })
    }

    proptest! {
        #[test]
        fn a_query_names_the_boxes_that_meet_it_once(
            boxes in prop::collection::vec(plan_box(), 0..400), wanted in plan_box(),
        ) {
            let square = PlanBox { min: Plan::new(0.0, 0.0), max: Plan::new(100.0, 100.0) };
            let mut found = Vec::new();
            Quadtree::new(&boxes, square).query(&wanted, &mut found);
            found.sort_unstable();
            let meets = |margin: f64| -> Vec<u32> {
                (0..boxes.len() as u32).filter(|k| boxes[*k as usize].grown(margin).meets(&wanted)).collect()
            };
            prop_assert!(meets(0.0).iter().all(|k| found.binary_search(k).is_ok()));
            let near = meets(1e-4);
            prop_assert!(found.iter().all(|k| near.contains(k)));
            prop_assert!(found.windows(2).all(|pair| pair[0] < pair[1]));
        }
    }

    #[test]
    fn a_small_query_looks_at_few_of_many_boxes() {
        let at = |k: u32| Plan::new(f64::from(k % 300) / 3.0, f64::from(k / 300) / 3.0);
        let boxes: Vec<PlanBox> =
            (0..90_000).map(|k| PlanBox { min: at(k), max: at(k) + glam::DVec2::splat(0.2) }).collect();
        let square = PlanBox { min: Plan::new(0.0, 0.0), max: Plan::new(100.0, 100.0) };
        let tree = Quadtree::new(&boxes, square);
        // What lies across the borders of the largest cells is looked at by every query.
        let looked_at: u32 = tree.cells.iter().take(5).map(|cell| cell.own.1 - cell.own.0).sum();
        assert!(looked_at < 2000, "{looked_at}");
        let mut found = Vec::new();
        tree.query(&PlanBox { min: Plan::new(50.2, 50.2), max: Plan::new(50.9, 50.9) }, &mut found);
        assert!((4..=16).contains(&found.len()), "{}", found.len());
    }
}
