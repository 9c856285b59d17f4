//! Weights of the particles around a place for the value of a quantity there, by least squares.

use nalgebra::{SMatrix, SVector};
use sph_core::Vect;
use sph_kernels::lanes::{Body, Lane, MOST, dispatch, dot};

/// Largest sum of the weights' amounts: errors of single particles grow by no more. It is 1 to 1.4 within particles, and
/// up to 3 beside a plane side of them.
const LARGEST: f64 = 3.0;
/// Least share of a term that the terms before it may leave undetermined: far above rounding, 10⁻¹⁵, which alone decides
/// below it whether the factor of a row of particles exists.
const LEAST_PIVOT: f64 = 1e-9;
/// Fewest particles of a fit.
const FEWEST: usize = 3;

/// Weight of a particle at `q` radii, (1 − q)⁴(1 + 4q).
#[inline(always)]
pub(crate) fn weight<L: Lane>(q: L) -> L {
    let one = L::splat(1.0);
    let inside = (one - q).max(L::splat(0.0));
    let square = inside * inside;
    square * square * (one + L::splat(4.0) * q)
}

/// Particles within a radius of a place, and their weights; memory for reuse.
#[derive(Clone, Debug)]
pub(crate) struct Fit<const D: usize> {
    /// Distances from the place over the radius, axis by axis; whole lanes, the last ones beyond it.
    away: [Vec<f64>; D],
    /// Number of particles.
    count: usize,
    /// Their weights.
    weights: Vec<f64>,
}

impl<const D: usize> Default for Fit<D> {
    fn default() -> Self {
        Fit {
            away: std::array::from_fn(|_| Vec::new()),
            count: 0,
            weights: Vec::new(),
        }
    }
}

impl<const D: usize> Fit<D> {
    /// Forgets all particles.
    pub fn clear(&mut self) {
        self.count = 0;
        self.away.iter_mut().for_each(Vec::clear);
    }

    /// Adds a particle by its way from the place over the radius.
    #[inline]
    pub fn push(&mut self, way: &Vect<D>) {
        self.count += 1;
        let axes = self.away.iter_mut().zip(way.iter());
        axes.for_each(|(away, x)| away.push(*x));
    }

    /// Weights of the particles for a value at the place: exact for polynomials of second order, or of the highest that
    /// the particles determine. None where too few are near.
    pub fn weights(&mut self) -> Option<&[f64]> {
        let lanes = self.count.next_multiple_of(MOST);
        self.away
            .iter_mut()
            .for_each(|away| away.resize(lanes, 2.0));
        self.weights.resize(lanes, 0.0);
        let found = match D {
            2 => self.terms::<6>() || self.terms::<3>() || self.terms::<1>(),
            _ => self.terms::<10>() || self.terms::<4>() || self.terms::<1>(),
        };
        found.then_some(&self.weights[..self.count])
    }

    /// Weights that give a polynomial of N terms its value at the place; false where the particles do not determine it,
    /// or barely.
    fn terms<const N: usize>(&mut self) -> bool {
        if self.count < N.max(FEWEST) {
            return false;
        }
        let away = self.away.each_ref().map(Vec::as_slice);
        let mut sums = [[[0.0; MOST]; N]; N];
        dispatch(Moments {
            away,
            sums: &mut sums,
        });
        // Of the moments a factor reads the lower triangle.
        let sum = |row: usize, column: usize| sums[column][row].iter().sum::<f64>();
        let moments = SMatrix::<f64, N, N>::from_fn(|row, column| match row >= column {
            true => sum(row, column),
            false => 0.0,
        });
        let Some(factor) = moments.cholesky() else {
            return false;
        };
        let pivot = |k: usize| factor.l_dirty()[(k, k)].powi(2);
        if (0..N).any(|k| pivot(k) < LEAST_PIVOT * moments[(k, k)]) {
            return false;
        }
        let value = factor.solve(&SVector::from_fn(|row, _| if row == 0 { 1.0 } else { 0.0 }));
        dispatch(Values {
            away,
            value: value.into(),
            weights: &mut self.weights,
        });
        let amounts: f64 = self.weights[..self.count].iter().map(|w| w.abs()).sum();
        amounts < LARGEST
    }
}

/// Some neighbours: their weights, and the first N of 1, x, y, x², xy, y² and so on over R.
#[inline(always)]
fn basis<const D: usize, const N: usize, L: Lane>(away: &[&[f64]; D], from: usize) -> (L, [L; N]) {
    let mut x = [L::splat(0.0); D];
    for (x, away) in x.iter_mut().zip(away) {
        *x = L::load(&away[from..]);
    }
    let mut basis = [L::splat(1.0); N];
    let mut term = 1;
    for x in x {
        if term < N {
            basis[term] = x;
            term += 1;
        }
    }
    for a in 0..D {
        for b in a..D {
            if term < N {
                basis[term] = x[a] * x[b];
                term += 1;
            }
        }
    }
    (weight(dot(&x, &x).sqrt()), basis)
}

/// Σ w bᵢ bⱼ, in as many sums as there may be lanes, so that their number changes no bit.
struct Moments<'a, const D: usize, const N: usize> {
    away: [&'a [f64]; D],
    /// By column and row, from the diagonal on.
    sums: &'a mut [[[f64; MOST]; N]; N],
}

impl<const D: usize, const N: usize> Body for Moments<'_, D, N> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lane>(self) {
        let count = self.away[0].len();
        for lanes in (0..MOST).step_by(L::N) {
            let mut sums = [[L::splat(0.0); N]; N];
            for from in (lanes..count).step_by(MOST) {
                let (weight, basis) = basis::<D, N, L>(&self.away, from);
                for column in 0..N {
                    let part = weight * basis[column];
                    for row in column..N {
                        sums[column][row] += part * basis[row];
                    }
                }
            }
            for (column, sums) in self.sums.iter_mut().zip(&sums) {
                for (row, sum) in column.iter_mut().zip(sums) {
                    sum.store(&mut row[lanes..]);
                }
            }
        }
    }
}

/// w Σ vᵢ bᵢ of each particle.
struct Values<'a, const D: usize, const N: usize> {
    away: [&'a [f64]; D],
    value: [f64; N],
    weights: &'a mut [f64],
}

impl<const D: usize, const N: usize> Body for Values<'_, D, N> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lane>(self) {
        for from in (0..self.weights.len()).step_by(L::N) {
            let (weight, basis) = basis::<D, N, L>(&self.away, from);
            let mut sum = L::splat(0.0);
            for (value, term) in self.value.iter().zip(&basis) {
                sum += L::splat(*value) * *term;
            }
            (weight * sum).store(&mut self.weights[from..]);
        }
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
        let mut fit = Fit::<2>::default();
        let mut value = |places: &[Vect<2>], f: &dyn Fn(&Vect<2>) -> f64| {
            fit.clear();
            places.iter().for_each(|x| fit.push(&(x / 3.0)));
            let weights = fit.weights()?.iter();
            Some(weights.zip(places).map(|(w, x)| w * f(x)).sum::<f64>())
        };
        let parabola =
            |x: &Vect<2>| 5.0 - 3.0 * x[0] + x[1] + 0.7 * x[0] * x[1] - 2.0 * x[1] * x[1];
        let mut exact = |places: &[Vect<2>], f: &dyn Fn(&Vect<2>) -> f64| {
            let found = value(places, f).expect("enough particles");
            assert!((found - 5.0).abs() < 1e-12, "{found}");
        };
        exact(&all, &parabola);
        // Beside a plane side.
        let half: Vec<_> = all.iter().copied().filter(|x| x[1] > -0.6).collect();
        exact(&half, &parabola);
        let row: Vec<_> = (-2..=2)
            .map(|i| Vect::<2>::new(f64::from(i), 0.1))
            .collect();
        exact(&row, &|_| 5.0);
        assert!(value(&all[..2], &|_| 1.0).is_none());
    }
}
