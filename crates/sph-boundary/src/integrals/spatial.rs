//! γ and ∇γ of planar wall facets in closed form.

mod edge;
mod facet;
mod knot;
mod outer_moment;
mod renormalisation;
mod weight;
mod weights;
mod winding;

pub use facet::FacetIntegral;
pub use renormalisation::Renormalisation3d;
pub use weights::Weights;
pub(crate) use weights::{Circle, Foot, Patch};
