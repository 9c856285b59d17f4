//! A fluid at rest.

use sph_core::{Vect, plugin};

use crate::{Solution, SolutionEntry};

/// p = ρ g (z_s − z) below the surface z_s, and no motion.
///
/// Source: Ghaïtanellis 2017, Eq. 1.32.
#[plugin(SolutionEntry [2, 3], "hydrostatic", "a fluid at rest under gravity", source: "Ghaïtanellis 2017, Eq. 1.32")]
pub struct Hydrostatic {
    /// Density ρ.
    #[parameter(unit: "kg/m³", above: 0.0)]
    pub density: f64,
    /// Magnitude g of gravity, which points down the last axis.
    #[parameter(unit: "m/s²")]
    pub gravity: f64,
    /// Ordinate z_s of the free surface.
    #[parameter(unit: "m")]
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
