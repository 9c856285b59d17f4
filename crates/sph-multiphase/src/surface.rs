//! Free surfaces: where they are, and densities without memory of them.

mod cone;
mod moments;
mod relaxed;
mod renormalised;

pub use cone::{FREE_SURFACE, Place};
pub use moments::MOMENT_EXCESS;
pub use relaxed::{ConeTest, SurfaceEntry};
pub use renormalised::Renormalised;
