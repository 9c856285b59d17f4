//! How wide the filter of a large-eddy simulation is.

use schemars::JsonSchema;
use serde::Deserialize;
use sph_neighbours::World;

/// A length that particles have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, serde::Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FilterLength {
    /// The smoothing length h.
    SmoothingLength,
    /// The particle spacing δr.
    Spacing,
}

impl FilterLength {
    /// Its length, m.
    pub fn of<const D: usize>(self, world: &World<D>) -> f64 {
        match self {
            FilterLength::SmoothingLength => world.kernel.smoothing_length(),
            FilterLength::Spacing => world.spacing,
        }
    }
}
