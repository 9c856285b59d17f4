//! Remembered stresses follow the motion.

use nalgebra::Matrix3;
use rayon::prelude::*;
use sph_core::{Field, Scalar, Stage, StepError, Symmetric, fields};
use sph_neighbours::World;
use sph_rheology::Inputs;

use crate::batches::{BATCH, runs};
use crate::strain_rate::in_space;
use crate::{GradientStage, Rheologies, StrainRate};

/// Advances [`ELASTIC_STRESS`](fields::ELASTIC_STRESS) while positions drift, with the velocities
/// of the drift: together with the kick this is symplectic, and undamped elastic waves keep their
/// energy.
///
/// Leaves velocity gradients and strain rates of the drift for the next evaluation.
pub struct ElasticMotion<const D: usize> {
    /// The gradient of the velocity.
    pub gradient: GradientStage<D>,
    /// The laws.
    pub laws: Rheologies,
    /// The pressure that makes friction.
    pub pressure: Field<Scalar>,
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
        let strain_rate = world.free.get(fields::STRAIN_RATE).unwrap_or(&[]);
        let pressure = world.free.get(self.pressure).unwrap_or(&[]);
        let phase = match self.laws.len() {
            1 => None,
            _ => Some(world.free.get(fields::PHASE)?),
        };
        let batches = stress.par_chunks_mut(BATCH).enumerate();
        let new = Vec::<Matrix3<f64>>::new;
        batches.for_each_init(new, |gradients, (k, stress)| {
            let from = k * BATCH;
            for (law, run) in runs(phase, from, stress.len()) {
                let out = &mut stress[run.start - from..run.end - from];
                let Some(elastic) = self.laws[law].elastic() else {
                    out.fill(Symmetric::ZERO);
                    continue;
                };
                gradients.clear();
                gradients.extend(gradient[run.clone()].iter().map(in_space));
                let inputs = Inputs {
                    strain_rate: strain_rate.get(run.clone()).unwrap_or(&[]),
                    pressure: pressure.get(run).unwrap_or(&[]),
                };
                elastic.advance(&inputs, gradients, dt, out);
            }
        });
        Ok(world.free.put(fields::ELASTIC_STRESS, stress)?)
    }
}
