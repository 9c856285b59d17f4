//! The state of the particles near a zone at one time, and between two times.

use rayon::prelude::*;
use sph_core::{Field, FieldError, Scalar, Vect, fields};
use sph_neighbours::{Domain, World};
use sph_solver::Flow;

use super::fit::Fit;
use super::near::NearbyPlaces;

/// Most scalars of state of a flow besides the density.
pub(crate) const SCALARS: usize = 4;

/// Density, velocity, acceleration and other scalars of state at a place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct State<const D: usize> {
    pub density: f64,
    pub velocity: Vect<D>,
    pub acceleration: Vect<D>,
    /// In the order of the flow's [`scalars`](super::refusals::scalars), then zeros.
    pub scalars: [f64; SCALARS],
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
    /// Mean accelerations, m/s²; none in flows that do not know them.
    pub mean_accelerations: Vec<Vect<D>>,
    pub states: Vec<State<D>>,
    /// Number of scalars of state that the states have.
    scalars: usize,
}

impl<const D: usize> Sample<D> {
    /// Those of a flow that are `wanted`, with some scalars of state.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn of_flow(
        flow: &Flow<D>,
        scalars: &[Field<Scalar>],
        wanted: impl Fn(&Vect<D>) -> bool,
    ) -> Result<Self, FieldError> {
        let free = &flow.world.free;
        let scalars = scalars.iter().map(|field| free.get(*field));
        let scalars = scalars.collect::<Result<Vec<_>, _>>()?;
        let identity = free.get(fields::IDENTITY)?;
        let position = free.get(fields::POSITION)?;
        let (mass, density) = (free.get(fields::MASS)?, free.get(fields::DENSITY)?);
        let velocity = free.get(fields::VELOCITY)?;
        let acceleration = free.get(fields::ACCELERATION)?;
        let mean = free.get(fields::MEAN_ACCELERATION).ok();
        let mut sample = Sample {
            time: Some(flow.world.time),
            scalars: scalars.len(),
            ..Sample::default()
        };
        for k in (0..position.len()).filter(|k| wanted(&position[*k])) {
            sample.identities.push(identity[k]);
            sample.positions.push(position[k]);
            sample.masses.push(mass[k]);
            sample.mean_accelerations.extend(mean.map(|mean| mean[k]));
            sample.states.push(State {
                density: density[k],
                velocity: velocity[k],
                acceleration: acceleration[k],
                scalars: std::array::from_fn(|n| scalars.get(n).map_or(0.0, |all| all[k])),
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
                scalars: std::array::from_fn(|n| part(then.scalars[n], now.scalars[n])),
            };
        }
        between
    }
}

/// A sample from which states elsewhere are fitted.
pub(crate) struct Source<'a, const D: usize> {
    sample: &'a Sample<D>,
    near: NearbyPlaces<'a, D>,
}

impl<'a, const D: usize> Source<'a, D> {
    /// Of particles with a spacing, m.
    pub fn new(sample: &'a Sample<D>, domain: &'a Domain<D>, spacing: f64) -> Self {
        let near = NearbyPlaces::new(&sample.positions, REACH * spacing, domain);
        Source { sample, near }
    }

    /// The states at those of some places that are `wanted`, where enough particles are near; where they are too few that
    /// of the nearest one, if the place is `led` in any case.
    pub fn all(
        &self,
        places: &[Vect<D>],
        wanted: impl Fn(&Vect<D>) -> bool + Sync,
        led: impl Fn(&Vect<D>) -> bool + Sync,
    ) -> States<D> {
        let memory = || (Vec::new(), Fit::default());
        let at = |(near, fit): &mut (Vec<u32>, Fit<D>), (k, x): (usize, &Vect<D>)| {
            let fitted = wanted(x).then(|| self.at(x, near, fit))?;
            let state = fitted.or_else(|| led(x).then(|| self.nearest(x)).flatten())?;
            Some((k, state))
        };
        let all = places.par_iter().enumerate().with_min_len(256);
        all.map_init(memory, at).flatten_iter().collect()
    }

    /// The state of the nearest particle within the radius of a fit.
    fn nearest(&self, x: &Vect<D>) -> Option<State<D>> {
        let mut nearest = None;
        self.near.visit(x, |k, _, q| {
            if nearest.is_none_or(|(_, least)| q < least) {
                nearest = Some((k, q));
            }
        });
        nearest.map(|(k, _)| self.sample.states[k])
    }

    /// The state at a place by a fit; none where too few particles are near.
    fn at(&self, x: &Vect<D>, near: &mut Vec<u32>, fit: &mut Fit<D>) -> Option<State<D>> {
        near.clear();
        fit.clear();
        self.near.visit(x, |k, way, _| {
            near.push(k as u32);
            fit.push(way);
        });
        let weights = fit.weights()?;
        let mut sum = State {
            density: 0.0,
            velocity: Vect::zeros(),
            acceleration: Vect::zeros(),
            scalars: [0.0; SCALARS],
        };
        let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
        let mut ranges = [[f64::INFINITY, f64::NEG_INFINITY]; SCALARS];
        for (weight, k) in weights.iter().zip(near) {
            let state = &self.sample.states[*k as usize];
            sum.density += state.density * *weight;
            sum.velocity += state.velocity * *weight;
            sum.acceleration += state.acceleration * *weight;
            (least, most) = (least.min(state.density), most.max(state.density));
            for (n, value) in state.scalars[..self.sample.scalars].iter().enumerate() {
                sum.scalars[n] += value * *weight;
                ranges[n] = [ranges[n][0].min(*value), ranges[n][1].max(*value)];
            }
        }
        let own = sum.scalars[..self.sample.scalars].iter_mut();
        for (sum, [least, most]) in own.zip(ranges) {
            // A clamp would panic where a scalar is no number.
            *sum = sum.max(least).min(most);
        }
        let beyond = if most < SMOOTH * least {
            most - least
        } else {
            0.0
        };
        sum.density = sum.density.clamp(least - beyond, most + beyond);
        Some(sum)
    }
}

/// Ratio of the densities around a place below which a fitted density may be out of their range, by its width. In spray
/// densities of 0.01 lie beside 1, and a polynomial through them reaches 0.
const SMOOTH: f64 = 1.1;
/// Radius of a fit over the spacing of the particles.
pub(crate) const REACH: f64 = 3.0;
