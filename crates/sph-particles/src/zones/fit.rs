//! Weights of the particles around a place for the value of a quantity there.

use nalgebra::{SMatrix, SVector};
use sph_core::Vect;

/// Radius of a fit over the spacing of the particles.
pub(crate) const REACH: f64 = 3.0;
/// Largest sum of the weights' amounts: errors of single particles grow by no more. It is 1 to 1.4 within particles, and
/// up to 3 beside a plane side of them.
const LARGEST: f64 = 3.0;
/// Least share of a term that the terms before it may leave undetermined: far above rounding, 10⁻¹⁵, which alone decides
/// below it whether the factor of a row of particles exists.
const LEAST_PIVOT: f64 = 1e-9;
/// Fewest particles of a fit.
const FEWEST: usize = 3;

/// Weight of a particle at `q` radii, (1 − q)⁴(1 + 4q).
pub(crate) fn weight(q: f64) -> f64 {
    (1.0 - q).max(0.0).powi(4) * (1.0 + 4.0 * q)
}

/// A neighbour: its weight, and the first N of 1, x, y, x², xy, y² and so on over R.
fn neighbour<const D: usize, const N: usize>(
    radius: f64,
    away: &Vect<D>,
) -> (f64, SVector<f64, N>) {
    let x = away / radius;
    let q = x.norm();
    let mut basis = SVector::<f64, N>::zeros();
    basis[0] = 1.0;
    if N > 1 {
        (0..D).for_each(|k| basis[1 + k] = x[k]);
    }
    if N > 1 + D {
        let pairs = (0..D).flat_map(|a| (a..D).map(move |b| (a, b)));
        let places = 1 + D..;
        pairs
            .zip(places)
            .for_each(|((a, b), k)| basis[k] = x[a] * x[b]);
    }
    (weight(q), basis)
}

/// Weights that give a polynomial of N terms its value at the place from which the particles are `away`, m: weighted
/// least squares. None where the particles do not determine it, or barely.
fn weights_of_terms<const D: usize, const N: usize>(
    radius: f64,
    away: &[Vect<D>],
) -> Option<Vec<f64>> {
    if away.len() < N.max(FEWEST) {
        return None;
    }
    let all: Vec<_> = away.iter().map(|d| neighbour::<D, N>(radius, d)).collect();
    // Of the moments a factor reads the lower triangle.
    let mut moments = SMatrix::<f64, N, N>::zeros();
    for (weight, basis) in &all {
        for column in 0..N {
            let part = weight * basis[column];
            (column..N).for_each(|row| moments[(row, column)] += part * basis[row]);
        }
    }
    let factor = moments.cholesky()?;
    let pivot = |k: usize| factor.l_dirty()[(k, k)].powi(2);
    if (0..N).any(|k| pivot(k) < LEAST_PIVOT * moments[(k, k)]) {
        return None;
    }
    let value = factor.solve(&SVector::from_fn(|row, _| if row == 0 { 1.0 } else { 0.0 }));
    let weight = |(weight, basis): &(f64, SVector<f64, N>)| weight * basis.dot(&value);
    let weights: Vec<f64> = all.iter().map(weight).collect();
    let amounts: f64 = weights.iter().map(|w| w.abs()).sum();
    (amounts < LARGEST).then_some(weights)
}

/// Weights of the particles that are `away`, m, within a radius, for a value at the place: exact for polynomials of
/// second order, or of the highest that the particles determine. None where too few are near.
pub(crate) fn weights<const D: usize>(radius: f64, away: &[Vect<D>]) -> Option<Vec<f64>> {
    let constant = || weights_of_terms::<D, 1>(radius, away);
    if D == 2 {
        weights_of_terms::<D, 6>(radius, away)
            .or_else(|| weights_of_terms::<D, 3>(radius, away))
            .or_else(constant)
    } else {
        weights_of_terms::<D, 10>(radius, away)
            .or_else(|| weights_of_terms::<D, 4>(radius, away))
            .or_else(constant)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever the places, parabolas are exact where they spread, linear fields beside a row, constants always.
    #[test]
    fn polynomials_are_exact_to_the_order_that_the_particles_determine() {
        let at = |k: i32| {
            let (i, j) = (f64::from(k % 7) - 3.0, f64::from(k / 7) - 3.0);
            Vect::<2>::new(i + 0.13 * (1.7 * i + j).sin(), j + 0.21 * (i - j).cos())
        };
        let all: Vec<_> = (0..49).map(at).filter(|x| x.norm() < 3.0).collect();
        let value = |places: &[Vect<2>], f: &dyn Fn(&Vect<2>) -> f64| -> f64 {
            let weights = weights(3.0, places).unwrap();
            weights.iter().zip(places).map(|(w, x)| w * f(x)).sum()
        };
        let parabola =
            |x: &Vect<2>| 5.0 - 3.0 * x[0] + x[1] + 0.7 * x[0] * x[1] - 2.0 * x[1] * x[1];
        assert!((value(&all, &parabola) - 5.0).abs() < 1e-12);
        // Beside a plane side.
        let half: Vec<_> = all.iter().copied().filter(|x| x[1] > -0.6).collect();
        assert!((value(&half, &parabola) - 5.0).abs() < 1e-12);
        let row: Vec<_> = (-2..=2)
            .map(|i| Vect::<2>::new(f64::from(i), 0.1))
            .collect();
        assert!((value(&row, &|_| 5.0) - 5.0).abs() < 1e-12);
        assert!(weights::<2>(3.0, &all[..2]).is_none());
    }
}
