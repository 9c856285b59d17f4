//! Remembered stresses follow the motion.

use nalgebra::Matrix3;
use sph_core::{Stage, StepError, Symmetric, fields};
use sph_neighbours::World;

use crate::strain_rate::in_space;
use crate::{Felt, GradientStage, StrainRate};

/// Advances [`ELASTIC_STRESS`](fields::ELASTIC_STRESS) while positions drift, with the velocities
/// of the drift: together with the kick this is symplectic, and undamped elastic waves keep their
/// energy.
///
/// Leaves velocity gradients and strain rates of the drift for the next evaluation.
pub struct ElasticMotion<const D: usize> {
    /// The gradient of the velocity.
    pub gradient: GradientStage<D>,
    /// The laws and what they feel.
    pub felt: Felt,
}

impl<const D: usize> ElasticMotion<D> {
    /// Advances all stresses over `dt` at the present places and velocities.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn apply(&mut self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        self.gradient.run(world)?;
        if world.free.has(fields::STRAIN_RATE.name) {
            StrainRate.run(world)?;
        }
        let mut stress = world.free.take(fields::ELASTIC_STRESS)?;
        let gradient = world.free.get(fields::VELOCITY_GRADIENT)?;
        self.felt
            .each(world, &mut stress, |law, inputs, run, out| {
                let Some(elastic) = law.elastic() else {
                    out.fill(Symmetric::ZERO);
                    return;
                };
                let gradients: Vec<Matrix3<f64>> = gradient[run].iter().map(in_space).collect();
                elastic.advance(inputs, &gradients, dt, out);
            })?;
        Ok(world.free.put(fields::ELASTIC_STRESS, stress)?)
    }
}
