//! Scalars that the motion compresses: d ln(value)/dt = exponent · D{u}.

use rayon::prelude::*;
use sph_core::{StepError, Vect};
use sph_multiphase::Compressed;
use sph_neighbours::{Interaction, There, World, interactions};

/// The divergence of a formulation, at work while positions drift.
pub struct Dilatation<const D: usize> {
    compressed: Compressed,
    term: [Box<dyn Interaction<D>>; 1],
    states: Vec<There<D>>,
    /// The sweep sums accelerations, too; nobody reads them.
    unused: Vec<Vect<D>>,
    divergence: Vec<f64>,
}

impl<const D: usize> Dilatation<D> {
    /// Of a scalar, with the divergence term of its formulation.
    pub fn new(compressed: Compressed, term: Box<dyn Interaction<D>>) -> Self {
        Dilatation {
            compressed,
            term: [term],
            states: Vec::new(),
            unused: Vec::new(),
            divergence: Vec::new(),
        }
    }

    /// value ← value · exp(exponent · D{u} · dt) at the present positions and velocities.
    pub fn apply(&mut self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        self.unused.resize(world.free.len(), Vect::zeros());
        self.divergence.resize(world.free.len(), 0.0);
        interactions(
            world,
            &mut self.states,
            &self.term,
            &mut self.unused,
            Some(&mut self.divergence),
        )?;
        let factor = self.compressed.exponent * dt;
        let mut value = world.free.take(self.compressed.value)?;
        value
            .par_iter_mut()
            .zip(&self.divergence)
            .with_min_len(2048)
            .for_each(|(v, d)| *v *= (factor * d).exp());
        Ok(world.free.put(self.compressed.value, value)?)
    }
}
