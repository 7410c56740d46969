//! What a tree holds: nodes of four bytes, leaves of eight.

/// What a node is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Divided: the number of the first of its four children (south-west, south-east, north-west, north-east).
    Internal(u32),
    /// A leaf that no edge meets, with the winding number of all its points: 0 is fully out, others are fully in.
    Full(i32),
    /// A leaf that edges meet, with its number among these.
    Partial(u32),
}

/// A node: its type in two bits, the numbers that the thesis gives the types (0 internal, 1 out, 2 in, 3 partial: section 4.2.1), and the
/// number that it refers to, or its winding number, in the others. Where it lies is not stored: it follows from the way to it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node(u32);

impl Node {
    /// Nodes, leaves and turns are below this number: a tree of as many nodes would have 4 GiB of them alone.
    pub(super) const MOST: usize = 1 << 29;

    pub(super) const fn new(kind: Kind) -> Self {
        match kind {
            Kind::Internal(children) => Self(children << 2),
            Kind::Full(0) => Self(1),
            Kind::Full(turns) => Self((turns as u32) << 2 | 2),
            Kind::Partial(leaf) => Self(leaf << 2 | 3),
        }
    }

    #[inline]
    pub(super) const fn kind(self) -> Kind {
        match self.0 & 3 {
            0 => Kind::Internal(self.0 >> 2),
            1 => Kind::Full(0),
            2 => Kind::Full(self.0 as i32 >> 2),
            _ => Kind::Partial(self.0 >> 2),
        }
    }
}

/// A leaf that edges meet.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leaf {
    /// Behind its last edge; the first one stands behind those of the leaf before.
    pub(super) end: u32,
    /// The winding number of its south-east corner.
    pub(super) corner: i32,
}
