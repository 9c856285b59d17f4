//! Free ends of open walls.

use crate::error::BoundaryError;
use crate::geometry::mesh::Mesh;

impl Mesh<2> {
    /// Refuses a free end within the kernel radius of any point, where γ is not defined.
    ///
    /// # Errors
    /// Names the wall, the end and the nearest point. Lengths in metres.
    pub fn check_free_ends(
        &self,
        points: &[[f64; 2]],
        kernel_radius: f64,
    ) -> Result<(), BoundaryError> {
        for free in &self.free_ends {
            let position = self.nodes[free.node].position;
            let distance = |point: &[f64; 2]| {
                let apart = [0, 1].map(|k| point[k] - position[k]);
                let shift = self.domain.shift(self.domain.nearest_image(apart));
                (apart[0] - shift[0]).hypot(apart[1] - shift[1])
            };
            let nearest = points
                .iter()
                .map(distance)
                .enumerate()
                .min_by(|a, b| a.1.total_cmp(&b.1));
            if let Some((particle, distance)) = nearest.filter(|(_, d)| *d < kernel_radius) {
                return Err(BoundaryError::FreeEndInReach {
                    wall: self.walls[free.wall].clone(),
                    end: free.end,
                    at: position.into(),
                    particle,
                    distance,
                    radius: kernel_radius,
                });
            }
        }
        Ok(())
    }
}
