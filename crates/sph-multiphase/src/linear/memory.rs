//! Memory kept from solve to solve.

use sph_core::Vect;

use crate::linear::Halves;
use crate::linear::precondition::Factors;

/// Vectors and factors of the solves before, for vectors of D components.
#[derive(Default)]
pub struct Memory<const D: usize> {
    /// Residuals of the solve at hand.
    pub(crate) history: Vec<f64>,
    pub(crate) vectors: Vectors<D>,
    pub(crate) factors: Factors<D>,
    pub(crate) halves: Halves<D>,
}

/// The vectors of conjugate gradients.
#[derive(Default)]
pub(crate) struct Vectors<const D: usize> {
    pub r: Vec<Vect<D>>,
    pub z: Vec<Vect<D>>,
    pub direction: Vec<Vect<D>>,
    pub image: Vec<Vect<D>>,
}

/// The memory of a solver of systems with one component, and of velocities in the plane and in space.
#[derive(Default)]
pub struct Memories {
    one: Memory<1>,
    plane: Memory<2>,
    space: Memory<3>,
}

impl Clone for Memories {
    /// None yet: a memory is not shared.
    fn clone(&self) -> Self {
        Memories::default()
    }
}

/// The owner of the memory of solves for vectors of D components.
pub trait MemoryOwner<const D: usize> {
    /// That memory.
    fn memory(&mut self) -> &mut Memory<D>;
}

impl MemoryOwner<1> for Memories {
    fn memory(&mut self) -> &mut Memory<1> {
        &mut self.one
    }
}

impl MemoryOwner<2> for Memories {
    fn memory(&mut self) -> &mut Memory<2> {
        &mut self.plane
    }
}

impl MemoryOwner<3> for Memories {
    fn memory(&mut self) -> &mut Memory<3> {
        &mut self.space
    }
}
