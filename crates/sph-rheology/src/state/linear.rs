//! The linear equation of state.

use crate::plugin;
use crate::state::{BoundState, EquationOfState, Reference};

/// p = c₀² (ρ − ρ₀) + P_bg, constant speed of sound.
///
/// Source: the Tait law of Ghaïtanellis 2017, Eq. 1.25, for ξ = 1.
///
/// ```toml
/// [phase.water.equation-of-state.linear]
/// ```
#[plugin(crate::state::EquationOfStateEntry, "linear", "p = c₀² (ρ − ρ₀)",
    source: "Ghaïtanellis 2017, Eq. 1.25 with ξ = 1")]
pub struct Linear {
    /// Background pressure P_bg, the same in all phases.
    #[parameter(default, unit: "Pa", min: 0.0, source: "Ghaïtanellis 2017, §5.1.2")]
    pub background_pressure: f64,
}

impl EquationOfState for Linear {
    fn bind(&self, reference: Reference) -> Box<dyn BoundState> {
        Box::new(BoundLinear {
            background: self.background_pressure,
            reference,
        })
    }
}

#[derive(Debug)]
struct BoundLinear {
    background: f64,
    reference: Reference,
}

impl BoundState for BoundLinear {
    fn pressure(&self, density: &[f64], pressure: &mut [f64]) {
        let c2 = self.reference.sound_speed.powi(2);
        for (p, rho) in pressure.iter_mut().zip(density) {
            *p = c2 * (rho - self.reference.density) + self.background;
        }
    }

    fn density(&self, pressure: f64) -> f64 {
        self.reference.density + (pressure - self.background) / self.reference.sound_speed.powi(2)
    }

    fn sound_speed(&self, _density: f64) -> f64 {
        self.reference.sound_speed
    }

    fn internal_energy(&self, density: f64) -> f64 {
        let (rho, c2) = (self.reference.density, self.reference.sound_speed.powi(2));
        let x = density / rho;
        c2 * x.ln() + (c2 - self.background / rho) * (1.0 / x - 1.0)
    }

    fn reference(&self) -> Reference {
        self.reference
    }
}
