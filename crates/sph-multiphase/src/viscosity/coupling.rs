//! Friction as a matrix: the form of a viscous operator for an implicit scheme.

use nalgebra::SMatrix;
use sph_core::{Access, StepError, Vect};
use sph_neighbours::{Cluster, Kinds, Neighbourhood, World};

/// A friction that is linear in the velocities: m_a γ_a a_a = −Σ_b C_ab (u_a − u_b) − W_a u_a + s_a with C_ab = C_baᵀ.
pub trait Coupling<const D: usize>: Send + Sync {
    /// Columns read.
    fn access(&self) -> Access;
    /// True if C and W mix the components of the velocity.
    fn mixes_components(&self) -> bool;
    /// Lends the coupling with its columns to `with`, once.
    ///
    /// # Errors
    /// If a column is missing, and those of `with`.
    fn with_columns(
        &self,
        world: &World<D>,
        with: &mut WithCoupling<'_, D>,
    ) -> Result<(), StepError>;
}

/// Work with a coupling that has its columns.
pub type WithCoupling<'w, const D: usize> =
    dyn FnMut(&dyn BoundCoupling<D>) -> Result<(), StepError> + 'w;

/// Wall terms of a particle.
#[derive(Clone, Copy, Debug)]
pub struct CouplingRow<W, const D: usize> {
    /// W_a, N s/m.
    pub wall: W,
    /// s_a, N: from the velocities of walls.
    pub source: Vect<D>,
}

/// A [`Coupling`] with its columns. Since the separation is the only direction, C_ab = α 1 + β r rᵀ.
pub trait BoundCoupling<const D: usize>: Sync {
    /// Parts of α and β that are not zero everywhere.
    fn kinds(&self) -> Kinds;

    /// α (N s/m), β (N s/m³) and their norm |α| + |β| r² for every candidate of a cluster, one number per lane each;
    /// exactly zero beyond the support.
    fn strengths(&self, cluster: &Cluster<'_, D>, out: &mut Vec<f64>);

    /// True if [`walls`](Self::scalar_walls) reads the free neighbours of a particle.
    fn walls_need_neighbours(&self, particle: usize) -> bool;

    /// W and s of walls, for couplings that do not mix components.
    ///
    /// At a wall the normal part of the velocity is that of the present state.
    fn scalar_walls(&self, rows: &Neighbourhood<'_, D>) -> CouplingRow<f64, D>;

    /// W and s of walls.
    fn block_walls(&self, rows: &Neighbourhood<'_, D>) -> CouplingRow<SMatrix<f64, D, D>, D>;
}
