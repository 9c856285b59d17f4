//! The state of the particles near a box at one time, and between two times.

use sph_core::{FieldError, Vect, fields};
use sph_neighbours::{CellGrid, Domain, World};
use sph_solver::Flow;

use super::fit::{REACH, weights};

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
        let (velocity, acceleration) =
            (free.get(fields::VELOCITY)?, free.get(fields::ACCELERATION)?);
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
                    let way = zone
                        .domain
                        .nearest(self.positions[k] - before.positions[slot]);
                    (way, before.states[slot])
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
