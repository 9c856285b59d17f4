//! Rates that the interaction sweep sums.

use sph_core::Vect;

/// Sums of the interaction sweep per particle.
#[derive(Clone, Copy, Debug)]
pub struct Rates<const D: usize> {
    /// Acceleration, m/s².
    pub acceleration: Vect<D>,
    /// Rate of the scalar that the formulation evolves (density diffusion), its unit per s.
    pub scalar: f64,
    /// Rates of further scalars, each in its [`World::slot`](crate::World::slot), their units per s.
    pub more: [f64; TRANSPORTED],
}

/// Most scalars whose rates one sweep sums besides the formulation's own.
pub const TRANSPORTED: usize = 7;

impl<const D: usize> Rates<D> {
    /// An acceleration, and scalars at rest.
    #[inline(always)]
    pub fn from_acceleration(acceleration: Vect<D>) -> Self {
        Rates {
            acceleration,
            scalar: 0.0,
            more: [0.0; TRANSPORTED],
        }
    }
}
