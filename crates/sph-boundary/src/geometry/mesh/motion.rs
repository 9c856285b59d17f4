//! Meshes that move as rigid bodies.

use std::collections::HashMap;

use sph_core::bed::Bed;

use super::elements::{Mesh, Simplices};
use crate::error::{BoundaryError, Place, Result};
use crate::rigid::pose::Pose;

pub(crate) fn bed_of(beds: &[Bed], wall: usize) -> Option<&Bed> {
    beds.iter().find(|bed| bed.walls.contains(&(wall as u32)))
}

impl<const D: usize> Mesh<D>
where
    Self: Simplices<D>,
{
    /// Moves every wall to its pose, one per wall, given with respect to the reference position.
    ///
    /// Positions never accumulate rounding: they are computed from the reference. Fluid angles change only where walls
    /// bend. Walls whose pose is unchanged cost nothing. An [`ElementTree`](crate::ElementTree) must be built again
    /// afterwards.
    ///
    /// # Errors
    /// A number of poses other than that of the walls, two walls that are joined or of one group with different poses, or
    /// the rotation of a wall that is closed through periodicity; the mesh is then left as it was.
    pub fn move_walls(&mut self, poses: &[Pose<D>]) -> Result<()> {
        self.check_poses(poses)?;
        let both = self.poses.iter().zip(poses);
        let moved: Vec<bool> = both.map(|(old, new)| old != new).collect();
        self.poses.copy_from_slice(poses);
        if !moved.contains(&true) {
            return Ok(());
        }
        let walls = self.motions.iter().zip(poses).enumerate();
        let maps = walls.map(|(k, (motion, pose))| motion.map(pose, bed_of(&self.beds, k)));
        let maps: Vec<_> = maps.collect();
        for (node, reference) in self.nodes.iter_mut().zip(&self.reference) {
            if moved[node.wall] {
                node.position = maps[node.wall](*reference);
            }
        }
        drop(maps);
        for element in 0..self.elements.len() {
            if moved[self.elements[element].wall] {
                self.measure(element);
            }
        }
        self.follow(&moved);
        self.sides = std::sync::OnceLock::new();
        Ok(())
    }

    fn check_poses(&self, poses: &[Pose<D>]) -> Result<()> {
        if poses.len() != self.walls.len() {
            let (given, walls) = (poses.len(), self.walls.len());
            let why = format!("{given} pose(s) given for {walls} wall(s)");
            return Err(BoundaryError(why));
        }
        let name = |wall: usize| &self.walls[wall];
        let mut firsts = HashMap::new();
        for (wall, group) in self.groups.iter().enumerate() {
            let first = *firsts.entry(group).or_insert(wall);
            if poses[first] != poses[wall] {
                let (wall, other) = (name(first), name(wall));
                return Err(BoundaryError(format!(
                    "walls `{wall}` and `{other}` move together and cannot be given different motions"
                )));
            }
        }
        for element in &self.elements {
            let (wall, pose) = (element.wall, &poses[element.wall]);
            let other = |node: &&usize| poses[self.nodes[**node].wall] != *pose;
            if let Some(&joint) = element.nodes.iter().find(other) {
                return Err(BoundaryError(format!(
                    "walls `{}` and `{}` are joined at {} and cannot move differently",
                    name(wall),
                    name(self.nodes[joint].wall),
                    Place::from(self.reference[joint])
                )));
            }
            if element.images != [[0; D]; D] && pose.turns() {
                let why = "is closed through periodicity and cannot rotate";
                return Err(BoundaryError::unfit(name(wall), why));
            }
        }
        Ok(())
    }
}
