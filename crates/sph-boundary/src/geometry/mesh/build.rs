//! From polylines to segments.

use std::f64::consts::TAU;

use super::joints::{Continuation, Joints, SAME_PLACE, joints};
use super::segment_mesh::{Segment, SegmentMesh, Vertex};
use crate::error::BoundaryError;
use crate::geometry::checks::{check_area, check_crossings, check_points, short_edges};
use crate::geometry::periodic::PeriodicBox;
use crate::geometry::polyline::Polyline;
use crate::geometry::sides::Sides;
use crate::geometry::wall_end::{FreeEnd, WallEnd};
use crate::rigid::motion::RigidMotion;
use crate::rigid::pose::Pose;

/// Two segments folded onto each other within this angle leave the fluid all around their vertex.
const FOLD: f64 = 1e-9;

impl SegmentMesh {
    /// Cuts the walls into segments of about `spacing` metres.
    ///
    /// # Errors
    /// A wall that is degenerate, crosses itself or another one, or meets another end to end with
    /// the fluid on the other side. A wall that ends freely is not refused here: see
    /// [`SegmentMesh::check_free_ends`].
    pub fn build(
        polylines: &[Polyline],
        spacing: f64,
        domain: &PeriodicBox,
    ) -> Result<Self, BoundaryError> {
        if !(spacing > 0.0 && spacing.is_finite()) {
            return Err(BoundaryError::NotPositive {
                name: "wall spacing",
                value: spacing,
            });
        }
        domain.check()?;
        let tolerance = SAME_PLACE * spacing;
        for line in polylines {
            check_points(line)?;
        }
        check_crossings(polylines, tolerance, domain)?;
        for line in polylines {
            check_area(line, tolerance)?;
        }
        let joints = joints(polylines, tolerance, domain)?;
        let mut mesh = SegmentMesh {
            walls: polylines.iter().map(|line| line.name.clone()).collect(),
            vertices: Vec::new(),
            segments: Vec::new(),
            free_ends: Vec::new(),
            warnings: polylines
                .iter()
                .flat_map(|line| short_edges(line, spacing))
                .collect(),
            domain: *domain,
            reference: Vec::new(),
            poses: vec![Pose::default(); polylines.len()],
            motions: vec![RigidMotion::default(); polylines.len()],
            sides: Sides::default(),
        };
        let first_vertices = first_vertices(polylines, &joints, spacing);
        for (wall, line) in polylines.iter().enumerate() {
            mesh.cut(wall, line, spacing, joints.after[wall], &first_vertices);
            if joints.starts_free[wall] {
                mesh.free_end(wall, WallEnd::First, first_vertices[wall]);
            }
            if joints.after[wall] == Continuation::Free {
                let last = mesh.vertices.len() - 1;
                mesh.free_end(wall, WallEnd::Last, last);
            }
        }
        mesh.reference = mesh.vertices.iter().map(|vertex| vertex.position).collect();
        for segment in 0..mesh.segments.len() {
            mesh.measure(segment);
        }
        mesh.connect();
        Ok(mesh)
    }
}

/// Number of equal parts of an edge.
fn parts([a, b]: [[f64; 2]; 2], spacing: f64) -> usize {
    let length = (b[0] - a[0]).hypot(b[1] - a[1]);
    ((length / spacing).round() as usize).max(1)
}

/// Index of the first vertex of every wall.
fn first_vertices(polylines: &[Polyline], joints: &Joints, spacing: f64) -> Vec<usize> {
    let mut next = 0;
    polylines
        .iter()
        .zip(&joints.after)
        .map(|(line, after)| {
            let first = next;
            next += line.edges().map(|edge| parts(edge, spacing)).sum::<usize>();
            next += usize::from(*after == Continuation::Free);
            first
        })
        .collect()
}

impl SegmentMesh {
    fn cut(
        &mut self,
        wall: usize,
        line: &Polyline,
        spacing: f64,
        after: Continuation,
        first_vertices: &[usize],
    ) {
        for (edge, [a, b]) in line.edges().enumerate() {
            let count = parts([a, b], spacing);
            for k in 0..count {
                let along = k as f64 / count as f64;
                let vertex = self.vertices.len();
                self.push_vertex([0, 1].map(|i| a[i] + (b[i] - a[i]) * along), wall);
                self.segments.push(Segment {
                    vertices: [vertex, vertex + 1],
                    end_image: [0; 2],
                    wall,
                    edge,
                    length: 0.0,
                    centre: [0.0; 2],
                    normal: [0.0; 2],
                    theta_shares: [0.0; 2],
                });
            }
        }
        match after {
            Continuation::Free => self.push_vertex(line.points[line.points.len() - 1], wall),
            Continuation::Start { wall: next, image } => {
                if let Some(last) = self.segments.last_mut() {
                    last.vertices[1] = first_vertices[next];
                    last.end_image = image;
                }
            }
        }
    }

    fn push_vertex(&mut self, position: [f64; 2], wall: usize) {
        self.vertices.push(Vertex {
            position,
            theta: 0.5,
            wall,
            previous: None,
            next: None,
        });
    }

    fn free_end(&mut self, wall: usize, end: WallEnd, vertex: usize) {
        let position = self.vertices[vertex].position;
        self.free_ends.push(FreeEnd {
            wall,
            end,
            vertex,
            position,
        });
    }

    /// Length, centre and normal of a segment from the positions of its vertices.
    pub(super) fn measure(&mut self, segment: usize) {
        let [a, b] = self.ends(segment);
        let (x, y) = (b[0] - a[0], b[1] - a[1]);
        let length = x.hypot(y);
        let segment = &mut self.segments[segment];
        segment.length = length;
        segment.centre = [a[0] + 0.5 * x, a[1] + 0.5 * y];
        segment.normal = [-y / length, x / length];
    }

    /// Neighbours and fluid angles of the vertices.
    fn connect(&mut self) {
        for (s, segment) in self.segments.iter().enumerate() {
            self.vertices[segment.vertices[0]].next = Some(s);
            self.vertices[segment.vertices[1]].previous = Some(s);
        }
        self.find_angles();
    }

    /// Fluid angles of the vertices, and the segments' shares of them.
    pub(super) fn find_angles(&mut self) {
        for vertex in &mut self.vertices {
            if let (Some(previous), Some(next)) = (vertex.previous, vertex.next) {
                vertex.theta = fluid_angle(
                    self.segments[previous].tangent(),
                    self.segments[next].tangent(),
                );
            }
        }
        for segment in &mut self.segments {
            let [first, second] = segment.vertices.map(|v| self.vertices[v]);
            let share = |vertex: Vertex| match (vertex.previous, vertex.next) {
                (Some(_), Some(_)) => 0.5 * vertex.theta,
                _ => vertex.theta,
            };
            segment.theta_shares = [share(first), share(second)];
        }
    }
}

/// θ = 1/2 − turn/2π between two directions of travel; 1 where the wall folds back.
fn fluid_angle(from: [f64; 2], to: [f64; 2]) -> f64 {
    let cross = from[0] * to[1] - from[1] * to[0];
    let dot = from[0] * to[0] + from[1] * to[1];
    if dot < 0.0 && cross.abs() <= FOLD {
        return 1.0;
    }
    0.5 - cross.atan2(dot) / TAU
}
