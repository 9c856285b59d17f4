//! Triangles near a point.

use super::closest::nearest_to_origin;
use super::grid::{NearTriangle, ROUNDING, TriangleGrid};
use super::triangle_mesh::TriangleMesh;
use super::vector::{Point, add, dot, norm, sub};

impl TriangleGrid {
    /// Lists for the present position of the walls and queries up to the radius `reach`, m.
    ///
    /// With periodic directions, points in the box or within `reach` of it are served.
    pub fn build(mesh: &TriangleMesh, reach: f64) -> Self {
        let mut margin = [0.0; 3];
        let mut radii = Vec::with_capacity(mesh.triangles().len());
        for (t, triangle) in mesh.triangles().iter().enumerate() {
            let arms = mesh.corners(t).map(|corner| sub(corner, triangle.centre));
            for arm in arms {
                margin = std::array::from_fn(|k: usize| f64::max(margin[k], arm[k].abs()));
            }
            let radius = arms.into_iter().map(norm).fold(0.0, f64::max);
            radii.push(radius * (1.0 + ROUNDING));
        }
        // Rounding loses nothing.
        let margin = margin.map(|x: f64| x * (1.0 + ROUNDING));
        let images = images(mesh, 2.0 * reach, margin);
        Self::of(&images, &radii, reach)
    }

    /// Images of triangles nearer than `radius` to a point, ascending by triangle, then image;
    /// `radius` at most the reach of the grid.
    pub fn near<'a>(
        &'a self,
        mesh: &'a TriangleMesh,
        point: [f64; 3],
        radius: f64,
    ) -> impl Iterator<Item = NearTriangle> + 'a {
        debug_assert!(radius <= self.reach(), "query beyond the reach of the grid");
        let mut found = Vec::new();
        self.visit(point, radius, |place, distance2| {
            let near = self.entries[place];
            // The mean of the corners is in the triangle.
            let surely = distance2 < radius * radius * (1.0 - ROUNDING);
            if surely || {
                let (offset, _) = nearest_to_origin(mesh.corners_from(point, near));
                dot(offset, offset) < radius * radius
            } {
                found.push(near);
            }
        });
        found.sort_unstable();
        found.into_iter()
    }
}

/// Every image of every triangle that comes within `reach` of the box, with its centre.
fn images(mesh: &TriangleMesh, reach: f64, margin: [f64; 3]) -> Vec<(NearTriangle, Point)> {
    let domain = mesh.domain();
    let mut images = Vec::with_capacity(mesh.triangles().len());
    for (t, triangle) in mesh.triangles().iter().enumerate() {
        let centre = triangle.centre;
        let range = |k: usize| {
            let images = domain.images(k, centre[k], centre[k], reach + margin[k]);
            // More images than a byte counts would be of a wall drawn far outside the box.
            (*images.start()).max(-127) as i8..=(*images.end()).min(127) as i8
        };
        for i in range(0) {
            for j in range(1) {
                for k in range(2) {
                    let near = NearTriangle {
                        triangle: t as u32,
                        image: [i, j, k],
                    };
                    let shift = domain.shift([i, j, k].map(i32::from));
                    images.push((near, add(centre, shift)));
                }
            }
        }
    }
    images
}
