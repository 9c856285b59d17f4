//! γ and ∇γ of straight wall segments in closed form.

mod batch;
mod primitives;
mod renormalisation;

pub use batch::SegmentBatch;
pub use renormalisation::{Contact, Renormalisation2d, SegmentIntegral};
