//! The state of the particles near a box at one time, and between two times; weights of the particles around a place for
//! the value of a quantity there.

use nalgebra::{SMatrix, SVector};
use sph_core::{FieldError, Vect, fields};
use sph_neighbours::{CellGrid, Domain, World};
use sph_solver::Flow;

/// Density, velocity and acceleration at a place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct State<const D: usize> {
    pub density: f64,
    pub velocity: Vect<D>,
    pub acceleration: Vect<D>,
}

/// Particles of a flow, by their places in its columns, with states that another flow has there.
pub(crate) type States<const D: usize> = Vec<(usize, State<D>)>;

/// Particles at one time, by their identities.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sample<const D: usize> {
    /// s; a sample without particles has none.
    pub time: Option<f64>,
    pub identities: Vec<u32>,
    pub positions: Vec<Vect<D>>,
    pub masses: Vec<f64>,
    pub states: Vec<State<D>>,
}

impl<const D: usize> Sample<D> {
    /// Those of a flow that are `wanted`.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn of_flow(flow: &Flow<D>, wanted: impl Fn(&Vect<D>) -> bool) -> Result<Self, FieldError> {
        let free = &flow.world.free;
        let identity = free.get(fields::IDENTITY)?;
        let position = free.get(fields::POSITION)?;
        let (mass, density) = (free.get(fields::MASS)?, free.get(fields::DENSITY)?);
        let velocity = free.get(fields::VELOCITY)?;
        let acceleration = free.get(fields::ACCELERATION)?;
        let mut sample = Sample {
            time: Some(flow.world.time),
            ..Sample::default()
        };
        for k in (0..position.len()).filter(|k| wanted(&position[*k])) {
            sample.identities.push(identity[k]);
            sample.positions.push(position[k]);
            sample.masses.push(mass[k]);
            sample.states.push(State {
                density: density[k],
                velocity: velocity[k],
                acceleration: acceleration[k],
            });
        }
        Ok(sample)
    }

    /// The state at the time of a zone, between an earlier sample and this one; accelerations are the change of velocities.
    ///
    /// `earlier` has the places of the particles in the earlier sample; those that it lacks are traced back with their
    /// velocity.
    pub fn since(&self, before: &Sample<D>, earlier: &[Option<u32>], zone: &World<D>) -> Self {
        let (Some(from), Some(to)) = (before.time, self.time) else {
            return self.clone();
        };
        let length = to - from;
        if length <= 0.0 {
            return self.clone();
        }
        let share = ((zone.time - from) / length).clamp(0.0, 1.0);
        let last = share == 1.0;
        let mut between = self.clone();
        between.time = Some(zone.time);
        for (k, now) in self.states.iter().enumerate() {
            let (way, then) = match earlier[k].map(|slot| slot as usize) {
                Some(slot) => {
                    let way = self.positions[k] - before.positions[slot];
                    (zone.domain.nearest(way), before.states[slot])
                }
                None => (now.velocity * length, *now),
            };
            between.positions[k] -= way * (1.0 - share);
            let part = |a: f64, b: f64| if last { b } else { a + share * (b - a) };
            let mixed = |a: Vect<D>, b: Vect<D>| a.zip_map(&b, part);
            between.states[k] = State {
                density: part(then.density, now.density),
                velocity: mixed(then.velocity, now.velocity),
                acceleration: (now.velocity - then.velocity) / length,
            };
        }
        between
    }
}

/// A sample in which neighbours are found.
pub(crate) struct Source<'a, const D: usize> {
    sample: &'a Sample<D>,
    domain: &'a Domain<D>,
    grid: CellGrid<D>,
    /// Radius of fits, m.
    reach: f64,
}

impl<'a, const D: usize> Source<'a, D> {
    /// Of particles with a spacing, m.
    pub fn new(sample: &'a Sample<D>, domain: &'a Domain<D>, spacing: f64) -> Self {
        let reach = REACH * spacing;
        Source {
            grid: CellGrid::new(&sample.positions, reach, domain),
            sample,
            domain,
            reach,
        }
    }

    /// The state at a place by a fit; none where too few particles are near.
    pub fn at(&self, x: &Vect<D>) -> Option<State<D>> {
        let (mut near, mut away) = (Vec::new(), Vec::new());
        self.visit(x, |k, d| {
            near.push(k);
            away.push(d);
        });
        let weights = weights(self.reach, &away)?;
        let nothing = State {
            density: 0.0,
            velocity: Vect::zeros(),
            acceleration: Vect::zeros(),
        };
        let add = |sum: State<D>, (weight, k): (&f64, &usize)| {
            let state = &self.sample.states[*k];
            State {
                density: sum.density + state.density * *weight,
                velocity: sum.velocity + state.velocity * *weight,
                acceleration: sum.acceleration + state.acceleration * *weight,
            }
        };
        Some(weights.iter().zip(&near).fold(nothing, add))
    }

    fn visit(&self, x: &Vect<D>, mut each: impl FnMut(usize, Vect<D>)) {
        let order = self.grid.order();
        self.grid.ranges(x, self.reach, |places| {
            for k in &order[places] {
                let k = *k as usize;
                let d = self.domain.nearest(self.sample.positions[k] - x);
                if d.norm_squared() < self.reach * self.reach {
                    each(k, d);
                }
            }
        });
    }
}

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
        for ((a, b), k) in pairs.zip(1 + D..) {
            basis[k] = x[a] * x[b];
        }
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
    let of_two_orders = match D {
        2 => weights_of_terms::<D, 6>(radius, away)
            .or_else(|| weights_of_terms::<D, 3>(radius, away)),
        _ => weights_of_terms::<D, 10>(radius, away)
            .or_else(|| weights_of_terms::<D, 4>(radius, away)),
    };
    of_two_orders.or_else(|| weights_of_terms::<D, 1>(radius, away))
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
