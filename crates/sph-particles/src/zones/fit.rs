//! Weights of the particles around a place for the value of a quantity there.

use nalgebra::{SMatrix, SVector};
use sph_core::Vect;

/// Radius of a fit over the spacing of the particles.
pub(crate) const REACH: f64 = 3.0;
/// Terms of a polynomial of second order in space.
const TERMS: usize = 10;
/// Largest sum of the weights' amounts: errors of single particles grow by no more. It is 1 to 1.4 within particles, and
/// up to 3 beside a plane side of them.
const LARGEST: f64 = 3.0;
/// Least share of a term that the terms before it may leave undetermined: far above rounding, 10⁻¹⁵, which alone decides
/// below it whether the factor of a row of particles exists.
const LEAST_PIVOT: f64 = 1e-9;
/// Fewest particles of a fit.
const FEWEST: usize = 3;

/// Weights that give a polynomial of `order` its value at the place from which the particles are `away`, m: least
/// squares with (1 − r/R)⁴(1 + 4r/R). None where the particles do not determine it, or barely.
fn weights_of_order<const D: usize>(order: u32, radius: f64, away: &[Vect<D>]) -> Option<Vec<f64>> {
    let terms = match order {
        0 => 1,
        1 => 1 + D,
        _ => 1 + D + D * (D + 1) / 2,
    };
    if away.len() < terms.max(FEWEST) {
        return None;
    }
    let weighted = |d: &Vect<D>| {
        let q = d.norm() / radius;
        let weight = (1.0 - q).powi(4) * (1.0 + 4.0 * q);
        (weight, polynomial(terms, &(d / radius)))
    };
    let mut moments = SMatrix::<f64, TERMS, TERMS>::identity();
    (0..terms).for_each(|k| moments[(k, k)] = 0.0);
    for d in away {
        let (weight, basis) = weighted(d);
        moments += basis * basis.transpose() * weight;
    }
    let first = SVector::<f64, TERMS>::ith(0, 1.0);
    let factor = moments.cholesky()?;
    let pivot = |k: usize| factor.l_dirty()[(k, k)].powi(2);
    if (0..terms).any(|k| pivot(k) < LEAST_PIVOT * moments[(k, k)]) {
        return None;
    }
    let value = factor.solve(&first);
    let weights = away.iter().map(|d| {
        let (weight, basis) = weighted(d);
        weight * basis.dot(&value)
    });
    let weights: Vec<f64> = weights.collect();
    let amounts: f64 = weights.iter().map(|w| w.abs()).sum();
    (amounts < LARGEST).then_some(weights)
}

/// 1, x, y, x², xy, y² and so on.
fn polynomial<const D: usize>(terms: usize, x: &Vect<D>) -> SVector<f64, TERMS> {
    let mut all = SVector::<f64, TERMS>::zeros();
    all[0] = 1.0;
    if terms > 1 {
        (0..D).for_each(|k| all[1 + k] = x[k]);
    }
    if terms > 1 + D {
        let pairs = (0..D).flat_map(|a| (a..D).map(move |b| (a, b)));
        let places = 1 + D..;
        pairs
            .zip(places)
            .for_each(|((a, b), k)| all[k] = x[a] * x[b]);
    }
    all
}

/// Weights of the particles that are `away`, m, within a radius, for a value at the place: exact for polynomials of
/// second order, or of the highest that the particles determine. None where too few are near.
pub(crate) fn weights<const D: usize>(radius: f64, away: &[Vect<D>]) -> Option<Vec<f64>> {
    let orders = [2, 1, 0].into_iter();
    let mut found = orders.map(|order| weights_of_order(order, radius, away));
    found.find_map(|weights| weights)
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
