//! Memory kept from solve to solve.

use std::any::Any;

use sph_core::Vect;

use crate::linear::Halves;
use crate::linear::precondition::Factors;

/// Vectors and factors of the solves before, for vectors of D components.
#[derive(Default)]
pub(crate) struct Memory<const D: usize> {
    /// Residuals of the solve at hand.
    pub history: Vec<f64>,
    pub r: Vec<Vect<D>>,
    pub z: Vec<Vect<D>>,
    pub direction: Vec<Vect<D>>,
    pub image: Vec<Vect<D>>,
    pub factors: Factors<D>,
    pub halves: Halves<D>,
}

/// The memory of a solver.
#[derive(Default)]
pub struct Memories(Option<Box<dyn Any + Send + Sync>>);

impl Memories {
    /// Lends that of solves for vectors of D components.
    pub(crate) fn with_memory<const D: usize, R>(
        &mut self,
        work: impl FnOnce(&mut Memory<D>) -> R,
    ) -> R {
        let kept = self.0.take().and_then(|kept| kept.downcast().ok());
        let mut memory: Box<Memory<D>> = kept.unwrap_or_default();
        let done = work(&mut memory);
        self.0 = Some(memory);
        done
    }
}

impl Clone for Memories {
    /// None yet: a memory is not shared.
    fn clone(&self) -> Self {
        Memories::default()
    }
}
