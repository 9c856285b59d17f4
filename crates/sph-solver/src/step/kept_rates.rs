//! The rates that an integrator keeps within a step.

use rayon::prelude::*;
use sph_core::{StepError, Vect, fields};

use crate::Flow;

/// Rates of all particles, in the order of the kept state.
#[derive(Default)]
pub struct Kept<const D: usize> {
    acceleration: Vec<Vect<D>>,
    /// One column per evolved scalar.
    scalars: Vec<Vec<f64>>,
}

impl<const D: usize> Flow<D> {
    /// Copies the present rates, in the order of the kept state.
    pub(crate) fn keep_rates(&mut self) -> Result<(), StepError> {
        let free = &self.world.free;
        let kept = &mut self.kept_rates;
        free.get(fields::ACCELERATION)?
            .clone_into(&mut kept.acceleration);
        kept.scalars.resize_with(self.evolved.len(), Vec::new);
        for (evolved, column) in self.evolved.iter().zip(&mut kept.scalars) {
            free.get(evolved.rate)?.clone_into(column);
        }
        Ok(())
    }

    /// Rates become the mean of the present and the kept ones.
    pub(crate) fn average_with_kept(&mut self) -> Result<(), StepError> {
        let places = self.kept.places(self)?;
        let kept = &self.kept_rates;
        let at = |i: usize| places.as_ref().map_or(i, |places| places[i] as usize);
        let free = &mut self.world.free;
        let accelerations = free.get_mut(fields::ACCELERATION)?.par_iter_mut();
        let accelerations = accelerations.enumerate().with_min_len(2048);
        accelerations.for_each(|(i, a)| *a = (*a + kept.acceleration[at(i)]) * 0.5);
        for (evolved, column) in self.evolved.iter().zip(&kept.scalars) {
            let rates = free.get_mut(evolved.rate)?.par_iter_mut();
            let rates = rates.enumerate().with_min_len(2048);
            rates.for_each(|(i, r)| *r = (*r + column[at(i)]) * 0.5);
        }
        Ok(())
    }
}
