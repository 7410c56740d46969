//! Lines against the specification's definitions in rational arithmetic, and against what is known by hand.

mod aliased;
mod drawing;
mod machine;
mod smooth;
mod specification;
mod stipple;
