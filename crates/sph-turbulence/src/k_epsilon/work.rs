//! Production and dissipation within a step, and what walls set.

use rayon::prelude::*;
use sph_contribution::StepWork;
use sph_core::{Access, StepError, fields};
use sph_neighbours::World;

use super::model::KEpsilonModel;
use crate::columns::{DISSIPATION, FRICTION_VELOCITY, TURBULENT_ENERGY, WALL_UNITS};

/// After diffusion: k and ε are produced and dissipated, and next to walls with a wall function they are its values.
pub(crate) struct Sources {
    /// The model.
    pub model: KEpsilonModel,
    /// κ.
    pub karman: f64,
    /// ν, m²/s.
    pub viscosity: f64,
}

impl<const D: usize> StepWork<D> for Sources {
    fn name(&self) -> String {
        "k-epsilon".into()
    }
    fn access(&self) -> Access {
        Access::none()
            .here(fields::STRAIN_RATE)
            .here(fields::POSITION)
            .here(fields::IDENTITY)
            .here(TURBULENT_ENERGY)
            .here(DISSIPATION)
            .where_there(FRICTION_VELOCITY)
            .where_there(WALL_UNITS)
            .writes(TURBULENT_ENERGY)
            .writes(DISSIPATION)
    }
    fn after_kick(&mut self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        let mut energy = world.free.take(TURBULENT_ENERGY)?;
        let mut dissipation = world.free.take(DISSIPATION)?;
        refuse_negative(world, TURBULENT_ENERGY.name, &energy)?;
        refuse_negative(world, DISSIPATION.name, &dissipation)?;
        let rates = world.free.get(fields::STRAIN_RATE)?;
        let model = self.model;
        let both = energy.par_iter_mut().zip(&mut dissipation).zip(rates);
        both.with_min_len(1024).for_each(|((k, e), rate)| {
            [*k, *e] = model.after(*k, *e, *rate, dt);
        });
        if world.free.has(FRICTION_VELOCITY.name) {
            let friction = world.free.get(FRICTION_VELOCITY)?;
            let units = world.free.get(WALL_UNITS)?;
            for (i, u) in friction.iter().enumerate().filter(|(_, u)| **u > 0.0) {
                let distance = units[i] * self.viscosity / u;
                if distance < world.spacing {
                    let [k, e] = model.at_wall(*u, distance, self.karman);
                    (energy[i], dissipation[i]) = (k, e);
                }
            }
        }
        world.free.put(TURBULENT_ENERGY, energy)?;
        Ok(world.free.put(DISSIPATION, dissipation)?)
    }
}

/// Nothing is cut off: a step whose diffusion takes more than there is fails, and is taken again in shorter ones.
pub(crate) fn refuse_negative<const D: usize>(
    world: &World<D>,
    quantity: &'static str,
    values: &[f64],
) -> Result<(), StepError> {
    let found = values.iter().position(|v| !(*v > 0.0 && v.is_finite()));
    let Some(i) = found else {
        return Ok(());
    };
    let position = world.free.get(fields::POSITION)?[i];
    Err(StepError::Bad {
        quantity,
        particle: world.free.get(fields::IDENTITY)?[i],
        position: position.iter().copied().collect(),
        value: values[i],
        reason: "where a positive number was expected: the step is too long for its diffusion"
            .into(),
    })
}
