//! Friction as a matrix: what an implicit scheme needs of a viscous operator.

use nalgebra::SMatrix;
use sph_core::{Access, StepError, Vect};
use sph_neighbours::{Neighbourhood, World};

/// A friction that is linear in the velocities:
/// m_a γ_a a_a = −Σ_b C_ab (u_a − u_b) − W_a u_a + s_a with C_ab = C_baᵀ.
pub trait Coupling<const D: usize>: Send + Sync {
    /// Columns read.
    fn access(&self) -> Access;
    /// Whether C and W mix the components of the velocity.
    fn mixes_components(&self) -> bool;
    /// Looks the columns up.
    ///
    /// # Errors
    /// If a column is missing.
    fn bind<'a>(&'a self, world: &'a World<D>)
    -> Result<Box<dyn BoundCoupling<D> + 'a>, StepError>;
}

/// What walls do to a particle.
#[derive(Clone, Copy, Debug)]
pub struct CouplingRow<W, const D: usize> {
    /// W_a, N s/m.
    pub wall: W,
    /// s_a, N: from the velocities of walls.
    pub source: Vect<D>,
}

/// A [`Coupling`] with its columns.
pub trait BoundCoupling<const D: usize>: Sync {
    /// Appends C_ab (N s/m) for every free neighbour; for couplings that do not mix components.
    ///
    /// At a wall the normal part of the velocity is that of the present state.
    fn scalar_row(&self, rows: &Neighbourhood<'_, D>, out: &mut Vec<f64>) -> CouplingRow<f64, D>;

    /// Appends C_ab (N s/m) for every free neighbour.
    fn block_row(
        &self,
        rows: &Neighbourhood<'_, D>,
        out: &mut Vec<SMatrix<f64, D, D>>,
    ) -> CouplingRow<SMatrix<f64, D, D>, D>;
}
