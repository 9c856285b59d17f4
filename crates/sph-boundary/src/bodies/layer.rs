//! The fluid next to a body whose inertia acts within a step.

use nalgebra::{Matrix6, Vector3};

use crate::Drawing;
use crate::bodies::spatial_vector::six;

/// A* = ρ h Σ ∫ j jᵀ dS with j = (n, (x − c) × n): the inertia of a layer of fluid one smoothing length h thick that goes
/// with the surface along its normal n.
pub(crate) fn layer<'a>(
    pieces: impl IntoIterator<Item = &'a Drawing>,
    centre: Vector3<f64>,
    density: f64,
    smoothing_length: f64,
) -> Matrix6<f64> {
    let mut sum = Matrix6::zeros();
    let mut add = |x: Vector3<f64>, weighted_normal: Vector3<f64>| {
        let area = weighted_normal.norm();
        if area > 0.0 {
            let normal = weighted_normal / area;
            let j = six(normal, (x - centre).cross(&normal));
            sum += j * j.transpose() * (area * density * smoothing_length);
        }
    };
    for piece in pieces {
        match piece {
            Drawing::Line(line) => {
                for [a, b] in line.edges() {
                    let [a, b] = [a, b].map(|p| Vector3::new(p[0], p[1], 0.0));
                    let along = b - a;
                    let normal = Vector3::new(-along.y, along.x, 0.0) * 0.5;
                    // Two points are exact for squares of the arm.
                    for s in [-1.0, 1.0].map(|k| 0.5 + k * 0.5 / 3.0_f64.sqrt()) {
                        add(a + along * s, normal);
                    }
                }
            }
            Drawing::Surface(surface) => {
                for triangle in &surface.triangles {
                    let [a, b, c] = triangle.map(|k| Vector3::from(surface.points[k as usize]));
                    let normal = (b - a).cross(&(c - a)) / 6.0;
                    // So are the middles of the edges.
                    for x in [(a + b) * 0.5, (b + c) * 0.5, (c + a) * 0.5] {
                        add(x, normal);
                    }
                }
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Polyline;

    /// Of a square of side a about its centre: 2 ρ h a along each axis, ρ h 4 ∫ s² ds = ρ h a³/3 about it.
    #[test]
    fn the_layer_of_a_square_has_its_inertia() {
        let corners = vec![[1.0, 1.0], [1.0, 3.0], [3.0, 3.0], [3.0, 1.0]];
        let square = Drawing::Line(Polyline::closed("s", corners));
        let layer = layer([&square], Vector3::new(2.0, 2.0, 0.0), 1000.0, 0.1);
        let expected = [400.0, 400.0, 0.0, 0.0, 0.0, 100.0 * 8.0 / 3.0];
        for i in 0..6 {
            for k in 0..6 {
                let want = if i == k { expected[i] } else { 0.0 };
                assert!((layer[(i, k)] - want).abs() < 1e-10, "{layer}");
            }
        }
    }
}
