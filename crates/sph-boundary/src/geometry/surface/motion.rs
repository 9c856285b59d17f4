//! Surfaces that move as rigid bodies.

use super::triangle_mesh::TriangleMesh;
use super::vector::Point;
use crate::error::{BoundaryError, SurfaceError};
use crate::rigid::pose::Pose;

impl TriangleMesh {
    /// Moves every wall to its pose, one per wall, given with respect to the reference position.
    ///
    /// Positions never accumulate rounding: they are computed from the reference. Fluid angles do
    /// not change. Walls whose pose is unchanged cost nothing. A [`TriangleGrid`](crate::TriangleGrid)
    /// must be built again afterwards.
    ///
    /// # Errors
    /// A number of poses other than that of the walls, two walls of one group with different
    /// poses, or the rotation of a wall that is closed through periodicity; the mesh is then left
    /// as it was.
    pub fn move_walls(&mut self, poses: &[Pose<3>]) -> Result<(), BoundaryError> {
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
        let maps: Vec<_> = poses.iter().map(Pose::map).collect();
        for (node, reference) in self.nodes.iter_mut().zip(&self.reference) {
            if moved[node.wall] {
                node.position = maps[node.wall](*reference);
            }
        }
        for (face, reference) in self.faces.iter_mut().zip(&self.reference_normals) {
            if moved[face.wall] {
                face.normal = match poses[face.wall].turns() {
                    true => poses[face.wall].turned(*reference),
                    false => *reference,
                };
            }
        }
        for triangle in 0..self.triangles.len() {
            if moved[self.triangles[triangle].wall] {
                self.measure(triangle);
            }
        }
        self.sides = std::sync::OnceLock::new();
        Ok(())
    }

    /// Present poses, one per wall.
    pub fn poses(&self) -> &[Pose<3>] {
        &self.poses
    }

    /// Position of a node before any motion, m.
    pub fn reference_position(&self, node: usize) -> Point {
        self.reference[node]
    }

    fn check_poses(&self, poses: &[Pose<3>]) -> Result<(), BoundaryError> {
        if poses.len() != self.walls.len() {
            let (given, walls) = (poses.len(), self.walls.len());
            return Err(BoundaryError::PoseCount { given, walls });
        }
        for wall in 0..self.walls.len() {
            let together = |other: &usize| self.groups[*other] == self.groups[wall];
            let differs = (0..wall)
                .filter(together)
                .find(|w| poses[*w] != poses[wall]);
            if let Some(other) = differs {
                let [wall, other] = [other, wall].map(|w| self.walls[w].clone());
                return Err(SurfaceError::TornApart { wall, other }.into());
            }
        }
        if !poses.iter().any(Pose::turns) {
            return Ok(());
        }
        let across = self.triangles.iter().filter(|t| t.images != [[0; 3]; 3]);
        for triangle in across {
            if poses[triangle.wall].turns() {
                let wall = self.walls[triangle.wall].clone();
                return Err(BoundaryError::PeriodicWallRotated { wall });
            }
        }
        Ok(())
    }
}
