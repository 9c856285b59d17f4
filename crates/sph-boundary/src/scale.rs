//! The symmetric scale s of walls: s(x) ∫ s(y) w(x − y) dy = 1 over the fluid's side.

pub(crate) mod flat;
pub(crate) mod map;
#[cfg(test)]
mod normalised;
pub(crate) mod spline;
pub(crate) mod walls;
