//! Geometry overlay (Wartell et al. 2003): lines on the mesh in use, drawn as lines of the screen before a mesh that is moved back; fills as triangles on it.
//!
//! Input: a view, a guess. Output: the picture and its stages. The points on the mesh are the technique's own, which a bundle hands out; what they cover is decided here.
//! Refuses: imagery on the ground (a machine may read it at places that are moved with the mesh), stipples of anti-aliased lines, anti-aliased fills.

mod depth;
mod diamond;
mod face;
mod frame;
mod moved;
mod screen_line;
mod share;
mod stipple;

pub(super) use frame::picture;
