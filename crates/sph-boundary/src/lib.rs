//! Semi-analytical (USAW) and dummy-particle walls: wall geometry, renormalisation factor, wall state.
//!
//! The geometric half, usable without any solver:
//!
//! * [`Polyline`] is how a wall is drawn, [`thin_plate`] outlines a plate;
//! * [`SegmentMesh`] is the wall cut into segments of about the particle spacing, with the fluid
//!   angle at every vertex, closure across periodic sides, [motion](Pose) and the
//!   [inside test](SegmentMesh::contains);
//! * [`SegmentGrid`] finds the segments near a point;
//! * [`Renormalisation2d`] gives γ and ∇γ in closed form for any piecewise-polynomial kernel.
//!
//! ```
//! use sph_boundary::{PeriodicBox, Polyline, Renormalisation2d, SegmentGrid, SegmentMesh};
//! use sph_kernels::PiecewisePolynomial;
//!
//! let square = Polyline::closed("tank", vec![[0.0, 0.0], [8.0, 0.0], [8.0, 8.0], [0.0, 8.0]]);
//! let mesh = SegmentMesh::build(&[square], 0.5, &PeriodicBox::none())?;
//! // Wendland C2: (1 - q/2)⁴ (1 + 2q) on 0 ≤ q < 2.
//! let wendland = PiecewisePolynomial {
//!     breaks: vec![0.0, 2.0],
//!     pieces: vec![vec![1.0, 0.0, -2.5, 2.5, -0.9375, 0.125]],
//! };
//! let renormalisation = Renormalisation2d::new(&wendland, 1.0)?;
//! let grid = SegmentGrid::build(&mesh, renormalisation.kernel_radius());
//! let at = renormalisation.at([4.0, 0.5], &mesh, &grid);
//! assert!((at.gamma() - 0.823496914).abs() < 1e-9);
//! # Ok::<(), sph_boundary::BoundaryError>(())
//! ```

mod checks;
mod contract;
mod course;
mod cover;
mod dummy;
mod error;
mod gamma;
mod grid;
mod inside;
mod lattice_layers;
mod layers;
mod mesh;
mod motion;
mod near;
mod outline;
mod periodic;
mod planar;
mod plate;
mod polyline;
mod pose;
mod shepard;
mod spatial;
mod spatial_walls;
mod surface;
mod touching;
mod usaw;
mod wall_mesh;

pub use contract::{Condition, Drawing, Wall, WallEntry, WallSetup, WallSpec};
pub use course::{Course, Stage};
pub use dummy::DummyParticles;
pub use error::{BoundaryError, WallWarning};
pub use gamma::{Contact, GammaSum, Renormalisation2d, SegmentIntegral};
pub use grid::{NearSegment, SegmentGrid};
pub use mesh::{FreeEnd, Segment, SegmentMesh, Vertex, WallEnd};
pub use motion::{Movement, RigidMotion, Rotation, Translation};
pub use periodic::PeriodicBox;
pub use planar::PlanarWalls;
pub use plate::thin_plate;
pub use polyline::Polyline;
pub use pose::Pose;
pub use spatial::{FacetIntegral, GammaSum3d, Renormalisation3d};
pub use spatial_walls::SpatialWalls;
pub use surface::{
    Closest, Face, FaceEdge, Feature, FreeEdge, NearTriangle, Node, Opening, Surface, SurfaceError,
    Triangle, TriangleGrid, TriangleMesh,
};
pub use usaw::Usaw;
pub use wall_mesh::{Hindrance, MeshElement, MeshPoint, WallMesh};
