//! The rates that an integrator keeps within a step.

use rayon::prelude::*;
use sph_core::{StepError, Vect, fields};

use crate::Flow;

/// Rates of one particle.
#[derive(Clone, Copy)]
pub struct Kept<const D: usize> {
    acceleration: Vect<D>,
    scalar: f64,
}

impl<const D: usize> Flow<D> {
    /// Copies the present rates, in the order of the kept state.
    pub(crate) fn keep_rates(&mut self) -> Result<(), StepError> {
        let free = &self.world.free;
        let acceleration = free.get(fields::ACCELERATION)?;
        let scalar = self.evolved.first().map(|e| free.get(e.rate)).transpose()?;
        let one = |i: usize| Kept {
            acceleration: acceleration[i],
            scalar: scalar.map_or(0.0, |s| s[i]),
        };
        let all = (0..free.len()).into_par_iter().with_min_len(2048);
        all.map(one).collect_into_vec(&mut self.kept_rates);
        Ok(())
    }

    /// Rates become the mean of the present and the kept ones.
    pub(crate) fn average_with_kept(&mut self) -> Result<(), StepError> {
        let places = self.kept.places(self)?;
        let kept = &self.kept_rates;
        let at = |i: usize| match &places {
            None => kept[i],
            Some(places) => kept[places[i] as usize],
        };
        let free = &mut self.world.free;
        let accelerations = free.get_mut(fields::ACCELERATION)?.par_iter_mut();
        let accelerations = accelerations.enumerate().with_min_len(2048);
        accelerations.for_each(|(i, a)| *a = (*a + at(i).acceleration) * 0.5);
        if let Some(evolved) = self.evolved.first() {
            let rates = free.get_mut(evolved.rate)?.par_iter_mut();
            let rates = rates.enumerate().with_min_len(2048);
            rates.for_each(|(i, r)| *r = (*r + at(i).scalar) * 0.5);
        }
        Ok(())
    }
}
