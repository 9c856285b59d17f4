//! γ and ∇γ of planar wall facets in closed form.

mod edge;
mod knot;
mod renormalisation;
mod weight;
mod weights;

pub use renormalisation::{FacetIntegral, Renormalisation3d};
pub use weights::Weights;
pub(crate) use weights::{Circle, Foot, Patch};
