//! Width of the filter of a large-eddy simulation.

use sph_core::parameters;
use sph_neighbours::World;

/// A length that particles have.
#[parameters]
pub enum FilterLength {
    /// The smoothing length h.
    SmoothingLength,
    /// The particle spacing δr.
    Spacing,
}

impl FilterLength {
    /// Its length, m.
    pub fn metres<const D: usize>(self, world: &World<D>) -> f64 {
        match self {
            FilterLength::SmoothingLength => world.kernel.smoothing_length(),
            FilterLength::Spacing => world.spacing,
        }
    }
}
