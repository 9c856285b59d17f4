//! A fluid at rest.

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{Vect, register};

use crate::{Solution, SolutionEntry};

/// p = ρ g (z_s − z) below the surface z_s, and no motion.
///
/// Source: Ghaïtanellis 2017, Eq. 1.32.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Hydrostatic {
    /// Density ρ.
    #[schemars(extend("exclusiveMinimum" = 0.0, "unit" = "kg/m³"))]
    pub density: f64,
    /// Magnitude g of gravity, which points down the last axis.
    #[schemars(extend("unit" = "m/s²"))]
    pub gravity: f64,
    /// Ordinate z_s of the free surface.
    #[schemars(extend("unit" = "m"))]
    pub surface: f64,
}

impl<const D: usize> Solution<D> for Hydrostatic {
    fn velocity(&self, _position: &Vect<D>, _time: f64) -> Option<Vect<D>> {
        Some(Vect::zeros())
    }
    fn pressure(&self, position: &Vect<D>, _time: f64) -> Option<f64> {
        Some(self.density * self.gravity * (self.surface - position[D - 1]))
    }
}

register!(
    SolutionEntry [2, 3],
    Hydrostatic,
    "hydrostatic",
    "a fluid at rest under gravity",
    "Ghaïtanellis 2017, Eq. 1.32"
);
