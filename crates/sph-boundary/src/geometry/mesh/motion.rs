//! Walls that move as rigid bodies.

use super::segment_mesh::SegmentMesh;
use crate::error::BoundaryError;
use crate::geometry::sides::Sides;
use crate::rigid::motion::RigidMotion;
use crate::rigid::pose::Pose;

impl SegmentMesh {
    /// Says how the walls move, one motion per wall; only a bend matters to the mesh.
    pub(crate) fn bend_by(&mut self, motions: Vec<RigidMotion<2>>) {
        self.motions = motions;
    }

    /// Moves every wall to its pose, one per wall, given with respect to the reference position.
    ///
    /// Positions never accumulate rounding: they are computed from the reference. Fluid angles change only where walls
    /// bend. Walls whose pose is unchanged cost nothing. A [`SegmentGrid`](crate::SegmentGrid)
    /// must be built again afterwards.
    ///
    /// # Errors
    /// A number of poses other than that of the walls, two walls joined end to end with different
    /// poses, or the rotation of a wall that is closed through periodicity; the mesh is then left
    /// as it was.
    pub fn move_walls(&mut self, poses: &[Pose]) -> Result<(), BoundaryError> {
        self.check_poses(poses)?;
        let moved: Vec<bool> = self
            .poses
            .iter()
            .zip(poses)
            .map(|(old, new)| old != new)
            .collect();
        self.poses.copy_from_slice(poses);
        if !moved.contains(&true) {
            return Ok(());
        }
        self.sides = Sides::default();
        let walls = self.motions.iter().zip(poses);
        let maps: Vec<_> = walls.map(|(motion, pose)| motion.map(pose)).collect();
        for (vertex, reference) in self.vertices.iter_mut().zip(&self.reference) {
            if moved[vertex.wall] {
                vertex.position = maps[vertex.wall](*reference);
            }
        }
        for segment in 0..self.segments.len() {
            if moved[self.segments[segment].wall] {
                self.measure(segment);
            }
        }
        if self.motions.iter().any(|motion| motion.bend.is_some()) {
            self.find_angles();
        }
        for free in &mut self.free_ends {
            free.position = self.vertices[free.vertex].position;
        }
        Ok(())
    }

    /// Present poses, one per wall.
    pub fn poses(&self) -> &[Pose] {
        &self.poses
    }

    /// Position of a vertex before any motion, m.
    pub fn reference_position(&self, vertex: usize) -> [f64; 2] {
        self.reference[vertex]
    }

    fn check_poses(&self, poses: &[Pose]) -> Result<(), BoundaryError> {
        if poses.len() != self.walls.len() {
            let (given, walls) = (poses.len(), self.walls.len());
            return Err(BoundaryError::PoseCount { given, walls });
        }
        for segment in &self.segments {
            let joint = segment.vertices[1];
            let next = self.vertices[joint].wall;
            if poses[segment.wall] != poses[next] {
                let [x, y] = self.reference[joint];
                return Err(BoundaryError::JointTornApart {
                    wall: self.walls[segment.wall].clone(),
                    other: self.walls[next].clone(),
                    x,
                    y,
                });
            }
            if segment.end_image != [0; 2] && poses[segment.wall].turns() {
                let wall = self.walls[segment.wall].clone();
                return Err(BoundaryError::PeriodicWallRotated { wall });
            }
        }
        Ok(())
    }
}
