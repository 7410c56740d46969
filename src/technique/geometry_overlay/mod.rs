//! Geometry overlay: Z. Wartell et al. (2003), "Rendering vector data over global, multi-resolution 3D terrain".

pub mod dag;
