//! Vertices and segments of walls, and what may be asked of them.

use crate::error::WallWarning;
use crate::geometry::periodic::PeriodicBox;
use crate::geometry::sides::Sides;
use crate::geometry::wall_end::FreeEnd;
use crate::rigid::motion::RigidMotion;
use crate::rigid::pose::Pose;

/// A node of the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Present position, m.
    pub position: [f64; 2],
    /// θ_v, the angle of the fluid at the vertex over 2π: 1/2 on a straight wall, 1/4 in a right
    /// angle seen from the fluid, 3/4 at a re-entrant one, 1 at the end of a plate of zero
    /// thickness. 1/2 at a free end, as if the wall went straight on.
    pub theta: f64,
    /// Index of the wall.
    pub wall: usize,
    /// Segment that ends here.
    pub previous: Option<usize>,
    /// Segment that starts here.
    pub next: Option<usize>,
}

/// A straight element of the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// First and second vertex.
    pub vertices: [usize; 2],
    /// Whole periods to add to the second vertex's position.
    pub end_image: [i32; 2],
    /// Index of the wall.
    pub wall: usize,
    /// Index of the polyline's edge it is cut from.
    pub edge: usize,
    /// Length, m.
    pub length: f64,
    /// Midpoint, m.
    pub centre: [f64; 2],
    /// Inward unit normal (−t_y, t_x), into the fluid.
    pub normal: [f64; 2],
    /// Part of θ_v of both vertices that this segment answers for: half where two segments meet,
    /// the whole at a free end.
    pub theta_shares: [f64; 2],
}

impl Segment {
    /// Unit vector along the direction of travel.
    pub fn tangent(&self) -> [f64; 2] {
        [self.normal[1], -self.normal[0]]
    }
}

/// A segment and the whole periods to add to its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NearSegment {
    /// Index of the segment.
    pub segment: usize,
    /// Whole periods.
    pub image: [i32; 2],
}

/// All walls of a scene, cut into segments of about the particle spacing.
///
/// Every edge of a polyline is cut into equal segments. Ends of open polylines that coincide, also
/// across a periodic side, are joined into one vertex; other vertices are never merged. A plate of
/// zero thickness therefore has two coincident vertices along it, one per side, each with the fluid
/// angle of its own side. Walls may touch (a block on a floor, a vertex on an edge) but not cross.
///
/// Segments and vertices are numbered along the walls in the order given.
#[derive(Clone, Debug, PartialEq)]
pub struct SegmentMesh {
    pub(super) walls: Vec<String>,
    pub(super) vertices: Vec<Vertex>,
    pub(super) segments: Vec<Segment>,
    pub(super) free_ends: Vec<FreeEnd>,
    pub(super) warnings: Vec<WallWarning>,
    pub(super) domain: PeriodicBox,
    /// Positions of the vertices before any motion, m.
    pub(super) reference: Vec<[f64; 2]>,
    pub(super) poses: Vec<Pose>,
    /// How each wall moves.
    pub(super) motions: Vec<RigidMotion<2>>,
    pub(crate) sides: Sides,
}

impl SegmentMesh {
    /// Names of the walls, in the order given.
    pub fn walls(&self) -> &[String] {
        &self.walls
    }

    /// All vertices.
    pub fn vertices(&self) -> &[Vertex] {
        &self.vertices
    }

    /// All segments.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Ends that nothing continues.
    pub fn free_ends(&self) -> &[FreeEnd] {
        &self.free_ends
    }

    /// Remarks on the walls.
    pub fn warnings(&self) -> &[WallWarning] {
        &self.warnings
    }

    pub(crate) fn remark(&mut self, remarks: Vec<WallWarning>) {
        self.warnings.extend(remarks);
    }

    /// The box and its periodic directions.
    pub fn domain(&self) -> &PeriodicBox {
        &self.domain
    }

    /// Both ends of a segment, the second one moved next to the first across a periodic side, m.
    pub fn ends(&self, segment: usize) -> [[f64; 2]; 2] {
        let [first, second] = self.segments[segment]
            .vertices
            .map(|v| self.vertices[v].position);
        let shift = self.domain.shift(self.segments[segment].end_image);
        [first, [second[0] + shift[0], second[1] + shift[1]]]
    }

    /// Both ends of an image of a segment relative to a point, m.
    ///
    /// Made from the vertex's own position and the whole number of periods to it, so that all
    /// segments at a vertex see bitwise the same vector, as
    /// [`Renormalisation2d::segment`](crate::Renormalisation2d::segment) asks.
    #[inline]
    pub fn seen_from(&self, point: [f64; 2], near: NearSegment) -> [[f64; 2]; 2] {
        let Segment {
            vertices,
            end_image,
            ..
        } = &self.segments[near.segment];
        let [first, second] = vertices.map(|v| self.vertices[v].position);
        let start = [first[0] - point[0], first[1] - point[1]];
        let end = [second[0] - point[0], second[1] - point[1]];
        if near.image == [0; 2] && *end_image == [0; 2] {
            return [start, end];
        }
        let to = self.domain.shift(near.image);
        let total = [near.image[0] + end_image[0], near.image[1] + end_image[1]];
        let to_end = self.domain.shift(total);
        [
            [start[0] + to[0], start[1] + to[1]],
            [end[0] + to_end[0], end[1] + to_end[1]],
        ]
    }
}
