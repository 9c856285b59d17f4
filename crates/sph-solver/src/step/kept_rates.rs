//! The rates that an integrator keeps within a step.

use rayon::prelude::*;
use sph_core::{Evolved, FieldError, Store, Vect, fields};

/// Rates of all particles, in the order of the kept state.
#[derive(Default)]
pub struct Kept<const D: usize> {
    acceleration: Vec<Vect<D>>,
    /// One column per evolved scalar.
    scalars: Vec<Vec<f64>>,
}

impl<const D: usize> Kept<D> {
    /// Copies the present rates, in the order of the kept state.
    pub(crate) fn keep(&mut self, free: &Store<D>, evolved: &[Evolved]) -> Result<(), FieldError> {
        free.get(fields::ACCELERATION)?
            .clone_into(&mut self.acceleration);
        self.scalars.resize_with(evolved.len(), Vec::new);
        for (evolved, column) in evolved.iter().zip(&mut self.scalars) {
            free.get(evolved.rate)?.clone_into(column);
        }
        Ok(())
    }

    /// Rates become the mean of the present and the kept ones; `places` are those of the particles in the kept state.
    pub(crate) fn average(
        &self,
        free: &mut Store<D>,
        evolved: &[Evolved],
        places: Option<&[u32]>,
    ) -> Result<(), FieldError> {
        let at = |i: usize| places.map_or(i, |places| places[i] as usize);
        let accelerations = free.get_mut(fields::ACCELERATION)?.par_iter_mut();
        let accelerations = accelerations.enumerate().with_min_len(2048);
        accelerations.for_each(|(i, a)| *a = (*a + self.acceleration[at(i)]) * 0.5);
        for (evolved, column) in evolved.iter().zip(&self.scalars) {
            let rates = free.get_mut(evolved.rate)?.par_iter_mut();
            let rates = rates.enumerate().with_min_len(2048);
            rates.for_each(|(i, r)| *r = (*r + column[at(i)]) * 0.5);
        }
        Ok(())
    }
}
