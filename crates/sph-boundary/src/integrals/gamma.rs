//! γ and ∇γ of straight wall segments in closed form.

mod batch;
mod primitives;
mod renormalisation;
mod ring;
mod segment;

pub use batch::SegmentBatch;
pub use renormalisation::Renormalisation2d;
pub use segment::{Contact, SegmentIntegral};
