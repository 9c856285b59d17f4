//! The laws of a scene and what goes with them, as contributions to a flow.

mod elasticity;
mod friction;
mod materials;

pub(crate) use materials::Materials;
