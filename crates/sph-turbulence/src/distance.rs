//! Distance of particles from walls.

mod simplex;
mod stage;
mod tree;

pub(crate) use stage::wall_distance;
pub use tree::ElementTree;
pub(crate) use tree::KeptTree;
