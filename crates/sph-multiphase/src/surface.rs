//! Free surfaces: where they are, and densities without memory of them.

mod cone;
mod relaxed;

pub use cone::{FREE_SURFACE, Place};
pub use relaxed::{ConeTest, SurfaceEntry};
