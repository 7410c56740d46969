//! Strokes of static lines and outlines, segment by segment (Zechmeister 2020, sections 3.6, 4.2.1 *Line Segments*, 4.4.1 *Static Lines*).
//!
//! Input: a chain's path and how it is stroked ([`StrokeRules`]: half a width in metres, join, cap, and whether corners are the thesis's
//! or the style's). Output: a [`Segment`], ready for many point-in-line tests, whose answers are exact: plain doubles with a proven bound
//! decide, and where they do not, exact arithmetic does; and a [`SingleSegment`], which tests as a graphics processor in single precision.
//! Refuses: widths in pixels.
//!
//! A stroke is the union of its segments, and a segment that of
//! - its rectangle, with its square caps;
//! - the join at its start: between the ends of two rectangles, on the outer side of the turn, the miter's kite or the bevel's triangle;
//! - discs: its round caps, and where the join is round one at each end that is joined (the thesis tests the distance from the centre line).
//!
//! All are closed: a point on a border is held. Exactness holds for coordinates and half widths up to 2^80 whose last bit is 2^-88 or more
//! (a micrometre's has 2^-72): the twelfth powers that the bevel's test comes down to are sums of doubles then.

mod exact;
mod extent;
mod kind;
mod rules;
mod segment;
mod single;

pub use rules::StrokeRules;
pub(super) use rules::around;
pub use segment::Segment;
pub use single::SingleSegment;

#[cfg(test)]
mod tests;
