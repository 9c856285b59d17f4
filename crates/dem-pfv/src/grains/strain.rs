//! Strain around each grain.

use nalgebra::Matrix3;

use crate::grains::Vector;

/// Small strain ε = ½ (∇u + ∇uᵀ) around each grain from displacements u (m), positive in extension.
///
/// In each tetrahedron of grains, u is linear between the centres, so that ⟨∇u⟩ = (1/V) Σ_facets ū ⊗ S; a
/// grain takes the mean of its tetrahedra, weighted by their volumes, and zero if it has none. Tetrahedra that
/// name a grain that is not there or are flat are left out. Source: Catalano 2012, Eqs. (2.20), (2.21), in space; the
/// printed factor 1/L there is 1/S.
pub fn strains(
    tetrahedra: &[[usize; 4]],
    positions: &[Vector],
    displacements: &[Vector],
) -> Vec<Matrix3<f64>> {
    let grains = positions.len().min(displacements.len());
    let mut sums = vec![(Matrix3::zeros(), 0.0); positions.len()];
    for corners in tetrahedra {
        if corners.iter().any(|&c| c >= grains) {
            continue;
        }
        let [a, b, c, d] = *corners;
        let edges =
            |of: &[Vector]| Matrix3::from_columns(&[of[b] - of[a], of[c] - of[a], of[d] - of[a]]);
        let shape = edges(positions);
        let Some(inverse) = shape.try_inverse() else {
            continue;
        };
        let gradient = edges(displacements) * inverse;
        let volume = shape.determinant().abs() / 6.0;
        for &corner in corners {
            sums[corner].0 += (gradient + gradient.transpose()) * (0.5 * volume);
            sums[corner].1 += volume;
        }
    }
    let mean = |(sum, volume): (Matrix3<f64>, f64)| {
        if volume > 0.0 {
            sum / volume
        } else {
            Matrix3::zeros()
        }
    };
    sums.into_iter().map(mean).collect()
}
