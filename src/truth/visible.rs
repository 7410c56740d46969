//! Which triangle each point of a pixel sees: the pixel cut into convex fragments of one triangle, and sky.
//!
//! Triangles of a terrain do not cross, so that of two which overlap on the screen one is in front all over. They are laid
//! down nearest first; each takes what is still uncovered, and where the order was not that of the overlap, what it hides.

use super::facet::{Facet, MOST_BOUNDS};
use super::form::{Form, Line, Side};
use super::polygon::{Pieces, Polygon};

/// A piece of a pixel this small, in pixels' areas, is doubtful as a whole rather than looked at.
pub(super) const SPECK: f64 = 1e-11;

/// A convex piece of a pixel that sees one triangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fragment {
    pub(super) shape: Polygon,
    /// The triangle's place in the tile's list.
    pub(super) facet: u32,
    nearness: Form,
    /// No point of it is farther.
    farthest: f64,
}

/// What a pixel sees.
#[derive(Debug, Default)]
pub(super) struct Sight {
    /// Terrain.
    pub(super) fragments: Vec<Fragment>,
    /// Sky.
    pub(super) sky: Vec<Polygon>,
    /// Area that is doubtful.
    pub(super) slop: f64,
    /// The triangles of the square in hand, nearest first.
    order: Vec<(f64, u32)>,
    /// Where the fragments and the sky of the square in hand begin.
    first_fragment: usize,
    first_sky: usize,
}

/// A triangle as it lies on the pixel.
#[derive(Debug, Clone, Copy)]
struct Offered {
    facet: u32,
    sides: [Line; MOST_BOUNDS],
    count: usize,
    nearness: Form,
    /// No point of it in the square is nearer.
    nearest: f64,
}

impl Sight {
    /// Forgets the last pixel.
    pub(super) fn clear(&mut self) {
        self.fragments.clear();
        self.sky.clear();
        self.slop = 0.0;
    }

    /// Adds what a square of a pixel sees of these facets. `pixel` is the pixel's corner in the tile, `corner` the square's in
    /// the pixel.
    pub(super) fn see(
        &mut self,
        pieces: &mut Pieces,
        facets: &[Facet],
        near: &[u32],
        (pixel, corner, side): ([f64; 2], [f64; 2], f64),
    ) {
        let at = [pixel[0] + corner[0], pixel[1] + corner[1]];
        let mut order = std::mem::take(&mut self.order);
        order.clear();
        order.extend(near.iter().map(|&k| (facets[k as usize].nearness_range(at, side).1, k)));
        order.sort_unstable_by(|a, b| {
            let id = |k: u32| facets[k as usize].id;
            b.0.total_cmp(&a.0).then(id(a.1).cmp(&id(b.1)))
        });
        (self.first_fragment, self.first_sky) = (self.fragments.len(), self.sky.len());
        let square = pieces.square(corner, side);
        self.sky.push(square);
        let mut farthest = f64::INFINITY;
        for &(nearest, k) in &order {
            if self.sky.len() == self.first_sky && nearest < farthest {
                break;
            }
            let offered = Offered::new(k, &facets[k as usize], pixel, nearest);
            if offered.nearest >= farthest {
                self.hide(pieces, &offered);
            }
            self.cover(pieces, &offered);
            farthest = self.fragments[self.first_fragment..]
                .iter()
                .fold(f64::INFINITY, |least, f| if f.farthest < least { f.farthest } else { least });
        }
        self.order = order;
    }

    /// Whether nothing that comes no nearer than this can be seen.
    pub(super) fn hides(&self, nearest: f64) -> bool {
        self.sky.is_empty() && self.fragments.iter().all(|fragment| fragment.farthest > nearest)
    }

    /// No point of what is seen of the terrain is farther.
    pub(super) fn farthest(&self) -> f64 {
        let farthest = self.fragments.iter().map(|fragment| fragment.farthest);
        farthest.fold(f64::INFINITY, |least, v| if v < least { v } else { least })
    }

    /// Gives a triangle what it hides of fragments already laid down.
    fn hide(&mut self, pieces: &mut Pieces, offered: &Offered) {
        let mut k = self.first_fragment;
        let mut end = self.fragments.len();
        while k < end {
            let fragment = self.fragments[k];
            if fragment.farthest > offered.nearest || self.is_in_front(pieces, &fragment, offered) {
                k += 1;
                continue;
            }
            let start = self.fragments.len();
            let Some(overlap) = self.split(pieces, fragment.shape, offered, Rest::Of(fragment)) else {
                self.fragments.truncate(start);
                k += 1;
                continue;
            };
            match overlap_order(pieces.of(overlap), &fragment, offered) {
                Order::Behind => {
                    self.fragments.truncate(start);
                    k += 1;
                }
                Order::Unknown => {
                    self.slop += pieces.area(overlap);
                    self.fragments.truncate(start);
                    k += 1;
                }
                Order::InFront => {
                    // What is left of the fragment lies outside the triangle: it needs no second look.
                    match self.fragments.len() > start {
                        true => {
                            self.fragments.swap_remove(k);
                            k += 1;
                        }
                        false => {
                            self.fragments.remove(k);
                            end -= 1;
                        }
                    }
                    self.push(pieces, overlap, offered);
                }
            }
        }
    }

    /// Gives a triangle what it covers of the sky.
    fn cover(&mut self, pieces: &mut Pieces, offered: &Offered) {
        let sky: Vec<Polygon> = self.sky.drain(self.first_sky..).collect();
        for open in sky {
            match self.split(pieces, open, offered, Rest::Sky) {
                Some(covered) => self.push(pieces, covered, offered),
                None => self.sky.push(open),
            }
        }
    }

    fn push(&mut self, pieces: &Pieces, shape: Polygon, offered: &Offered) {
        let least = |least, p: &[f64; 2]| {
            let v = offered.nearness.at(*p);
            if v < least { v } else { least }
        };
        let farthest = pieces.of(shape).iter().fold(f64::INFINITY, least) - offered.nearness.error;
        // A depth that is not known is behind everything: everything is then compared with it.
        let farthest = if farthest.is_nan() { f64::NEG_INFINITY } else { farthest };
        self.fragments.push(Fragment { shape, facet: offered.facet, nearness: offered.nearness, farthest });
    }

    /// Whether a fragment surely lies in front of all of another triangle's plane, or out of the triangle.
    fn is_in_front(&mut self, pieces: &Pieces, fragment: &Fragment, offered: &Offered) -> bool {
        let shape = pieces.of(fragment.shape);
        let error = fragment.nearness.error + offered.nearness.error;
        if shape.iter().all(|p| fragment.nearness.at(*p) - offered.nearness.at(*p) > error) {
            return true;
        }
        for side in &offered.sides[..offered.count] {
            let mut slop = 0.0;
            if side.side(shape, &mut slop) == Side::Out {
                self.slop += slop;
                return true;
            }
        }
        false
    }

    /// Cuts a piece by a triangle's sides: returns the part in the triangle; what is left over goes to the fragments or the sky.
    /// `None`: no part of it is in the triangle, and nothing was left over.
    fn split(
        &mut self,
        pieces: &mut Pieces,
        shape: Polygon,
        offered: &Offered,
        rest: Rest,
    ) -> Option<Polygon> {
        let (fragments, sky) = (self.fragments.len(), self.sky.len());
        let mut inner = shape;
        for side in &offered.sides[..offered.count] {
            let halves = pieces.cut(inner, side, &mut self.slop);
            let Some(halves) = halves else {
                // The side is not known: what is inside the others is doubtful as a whole.
                self.slop += pieces.area(inner);
                continue;
            };
            let Some(within) = halves.inner else {
                self.fragments.truncate(fragments);
                self.sky.truncate(sky);
                return None;
            };
            if let Some(outer) = halves.outer {
                match rest {
                    Rest::Sky => self.sky.push(outer),
                    Rest::Of(fragment) => self.fragments.push(Fragment { shape: outer, ..fragment }),
                }
            }
            inner = within;
        }
        Some(inner)
    }
}

/// Which of a fragment's triangle and another is in front where they overlap.
fn overlap_order(shape: &[[f64; 2]], fragment: &Fragment, offered: &Offered) -> Order {
    let error = fragment.nearness.error + offered.nearness.error;
    let mut widest = 0.0f64;
    for p in shape {
        let by = offered.nearness.at(*p) - fragment.nearness.at(*p);
        widest = if by.abs() > widest.abs() { by } else { widest };
    }
    // They do not cross: where they are farthest apart decides for all of it.
    match widest {
        by if by > error => Order::InFront,
        by if -by > error => Order::Behind,
        _ => Order::Unknown,
    }
}

/// Where the rest of a cut piece goes.
#[derive(Debug, Clone, Copy)]
enum Rest {
    Sky,
    Of(Fragment),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Order {
    InFront,
    Behind,
    Unknown,
}

impl Offered {
    fn new(k: u32, facet: &Facet, pixel: [f64; 2], nearest: f64) -> Self {
        let bounds = facet.bounds();
        let first = bounds[0].seen_from(pixel).line();
        let mut sides = [first; MOST_BOUNDS];
        for (line, form) in sides[1..].iter_mut().zip(&bounds[1..]) {
            *line = form.seen_from(pixel).line();
        }
        Self { facet: k, sides, count: bounds.len(), nearness: facet.nearness.seen_from(pixel), nearest }
    }
}
