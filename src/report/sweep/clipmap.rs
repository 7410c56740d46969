//! Taibo et al. 2014.

use super::{Axis, MACHINES, Sweep};

pub(super) const SWEEP: Sweep = Sweep { crossed: &[ANISOTROPY], alone: &[MACHINES] };

const ANISOTROPY: Axis = &[&["technique.clipmap.anisotropy=1"]];
