//! Remarks on walls.

/// A remark that does not stop the run.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
#[non_exhaustive]
pub enum WallWarning {
    /// An edge shorter than a quarter of the spacing: it becomes one short segment.
    #[error(
        "edge {edge} of wall `{wall}` is {length} m long, far shorter than the spacing {spacing} m"
    )]
    ShortEdge {
        wall: String,
        edge: usize,
        length: f64,
        spacing: f64,
    },
    /// A surface drawn with most of its triangles far smaller than the spacing: they stay so.
    #[error(
        "{fine} of the {all} triangles of wall `{wall}` are far smaller than the spacing {spacing} m: draw it coarser"
    )]
    FineSurface {
        wall: String,
        fine: usize,
        all: usize,
        spacing: f64,
    },
    /// Faces that end on the back of another wall: no fluid is before them, and they are left out.
    #[error(
        "{faces} faces of wall `{wall}` end on the back of another wall: they bound no fluid and are left out"
    )]
    Unseen { wall: String, faces: usize },
}
