//! Clip space: homogeneous coordinates between the view and the screen, as a graphics processor keeps them.

/// A point of clip space, in numbers of the machine's precision. What is seen has |x| <= w, |y| <= w and 0 <= z <= w: x to the right,
/// y up, z by the machine's convention of depth. Divided by w, x and y are shares of half the picture from its middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clip<T> {
    /// To the right.
    pub x: T,
    /// Up.
    pub y: T,
    /// The depth's numerator.
    pub z: T,
    /// What the others are divided by: the view depth of a central lens, 1 of a parallel one.
    pub w: T,
}

impl<T: Copy> Clip<T> {
    /// The point of a column of four numbers.
    #[inline(always)]
    pub const fn from_array([x, y, z, w]: [T; 4]) -> Self {
        Self { x, y, z, w }
    }

    /// The column of its numbers.
    #[inline(always)]
    pub const fn to_array(self) -> [T; 4] {
        [self.x, self.y, self.z, self.w]
    }
}
