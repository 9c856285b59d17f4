//! Gradients of the velocity from sums over neighbours.

use nalgebra::SMatrix;
use sph_core::{Work, contract};

/// Terms of a formula: sums over neighbours, wall points and elements with the weights θ_b V_b ∇w_ab and −∇γ_as.
#[derive(Clone, Copy, Debug)]
pub struct NeighbourSums<const D: usize> {
    /// Σ (u_b − u_a) ⊗ weight, 1/s.
    pub velocity: SMatrix<f64, D, D>,
    /// Σ (r_b − r_a) ⊗ weight: the unit tensor where neighbours surround the particle evenly.
    pub position: SMatrix<f64, D, D>,
    /// 1/γ.
    pub inverse_renormalisation: f64,
}

/// A formula for (grad u)_ij = ∂u_i/∂x_j.
pub trait VelocityGradient<const D: usize>: Send + Sync {
    /// The gradient from the sums, 1/s; zero for a particle without neighbours.
    fn gradient(&self, sums: &NeighbourSums<D>) -> SMatrix<f64, D, D>;
    /// True if the force of an elastic stress is the adjoint of this formula, and not of the plain sum over γ.
    fn adjoint(&self) -> bool {
        false
    }
    /// C in G = 1/γ Σ (u_b − u_a) ⊗ weight C.
    fn correction(&self, _sums: &NeighbourSums<D>) -> SMatrix<f64, D, D> {
        SMatrix::identity()
    }
}

contract!(
    /// A velocity gradient that a scene may name.
    pub VelocityGradientEntry, "velocity-gradient", One, "the strain rate that a law reads", VelocityGradient<D>,
    .by_default("renormalised").ordered(30).works(Work::Others).idle(
        "no law of this scene reads a strain rate, and no output shows one: take this table out"
    )
);
