//! γ and ∇γ of straight wall segments in closed form.

mod primitives;
mod renormalisation;

pub use renormalisation::{Contact, Renormalisation2d, SegmentBatch, SegmentIntegral};
