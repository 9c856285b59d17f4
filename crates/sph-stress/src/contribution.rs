//! The laws of a scene and what goes with them, as contributions to a flow.

mod elasticity;
mod friction;
mod materials;
mod straining;
mod wall_friction;

pub use elasticity::Elasticity;
pub use friction::Friction;
pub use materials::Materials;
pub use straining::Straining;
pub use wall_friction::WallFriction;
