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

/// What a particle gets from walls and weak pairs.
#[derive(Clone, Copy, Debug)]
pub struct CouplingRow<W, const D: usize> {
    /// W_a, N s/m.
    pub wall: W,
    /// s_a, N: from the velocities of walls and of weak pairs.
    pub source: Vect<D>,
}

/// Pairs that are coupled too weakly to be solved for: −C_ab (u_a − u_b) of a given velocity goes to the source.
#[derive(Clone, Copy, Debug)]
pub struct Weak<'a, const D: usize> {
    /// With which they act, m/s.
    pub velocity: &'a [Vect<D>],
    /// The norm of C_ab is not above that of either particle, N s/m.
    pub limit: &'a [f64],
}

/// A [`Coupling`] with its columns.
pub trait BoundCoupling<const D: usize>: Sync {
    /// Appends b and C_ab (N s/m) for every free neighbour that is not `weak`; for couplings that do not mix components.
    ///
    /// At a wall the normal part of the velocity is that of the present state.
    fn scalar_row(
        &self,
        rows: &Neighbourhood<'_, D>,
        weak: Option<Weak<'_, D>>,
        out: &mut Vec<(u32, f64)>,
    ) -> CouplingRow<f64, D>;

    /// Appends b and C_ab (N s/m) for every free neighbour that is not `weak`.
    fn block_row(
        &self,
        rows: &Neighbourhood<'_, D>,
        weak: Option<Weak<'_, D>>,
        out: &mut Vec<(u32, SMatrix<f64, D, D>)>,
    ) -> CouplingRow<SMatrix<f64, D, D>, D>;
}
