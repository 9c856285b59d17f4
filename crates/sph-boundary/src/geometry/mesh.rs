//! The wall cut into segments.

mod build;
mod ends;
mod joints;
mod motion;
mod segment_mesh;
mod signed;

pub(crate) use joints::SAME_PLACE;
pub use segment_mesh::{NearSegment, Segment, SegmentMesh, Vertex};
pub use signed::SeenSegment;
