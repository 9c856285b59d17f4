//! Distance of particles from walls.

mod simplex;
mod stage;
mod tree;

pub use stage::WallDistance;
pub use tree::ElementTree;
