//! Lightness of a body for the fluid at its surface.

use nalgebra::Matrix6;

use crate::{Elements, FreeBody};

/// The largest λ of Σ S j jᵀ a = λ M a over the elements of a body of area S, m^(d−1)/kg: a layer of fluid of the thickness
/// l at its surface has ρ l λ times its inertia.
pub fn lightness<const D: usize>(body: &FreeBody<D>, elements: &Elements<D>) -> f64 {
    let mut surface = Matrix6::zeros();
    for (s, wall) in elements.wall.iter().enumerate() {
        if body.walls.contains(wall) {
            let j = body.along(&elements.centre[s], &elements.normal[s]);
            surface += j * j.transpose() * elements.measure[s];
        }
    }
    let mut root = Matrix6::zeros();
    for (k, column) in body.roots().enumerate() {
        root.set_column(k, &column);
    }
    (root.transpose() * surface * root)
        .symmetric_eigenvalues()
        .max()
}
