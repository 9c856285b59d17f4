//! The Tait and the linear equation of state.

use crate::plugin;
use crate::state::{BoundState, EquationOfState, Reference};

/// p = ρ₀c₀²/ξ [(ρ/ρ₀)^ξ − 1] + P_bg, c = c₀ (ρ/ρ₀)^((ξ−1)/2).
///
/// Source: Ghaïtanellis 2017, Eq. 1.25 and 1.28. The background pressure must be the same in
/// all phases; keep it zero where there is a free surface.
///
/// A particle thrown out of the bulk sums a density far below ρ₀, and with it a tension of up
/// to ρ₀c₀²/ξ that glues splashes together. `tension_limit = 0` lets the fluid tear instead.
///
/// ```toml
/// [phase.water.equation-of-state.tait]
/// exponent = 7
/// ```
#[plugin(crate::state::EquationOfStateEntry, "tait", "stiff power law, p = ρ₀c₀²/ξ [(ρ/ρ₀)^ξ − 1]",
    source: "Ghaïtanellis 2017, Eq. 1.25")]
pub struct Tait {
    /// Exponent ξ: 7 for water and soils, 1.4 for air.
    #[parameter(default: 7.0, unit: "1", min: 1.0, max: 20.0, source: "Ghaïtanellis 2017, Eq. 1.25")]
    pub exponent: f64,
    /// Background pressure P_bg, the same in all phases.
    #[parameter(default, unit: "Pa", min: 0.0, source: "Ghaïtanellis 2017, §5.1.2")]
    pub background_pressure: f64,
    /// Largest tension the fluid carries: p ≥ −tension_limit. No limit if left out; 0 for
    /// splashing free surfaces.
    #[parameter(default, unit: "Pa", min: 0.0, source: "ours")]
    pub tension_limit: Option<f64>,
}

impl EquationOfState for Tait {
    fn bind(&self, reference: Reference) -> Box<dyn BoundState> {
        Box::new(BoundTait {
            law: *self,
            reference,
            stiffness: reference.density * reference.sound_speed.powi(2) / self.exponent,
        })
    }
}

#[derive(Debug)]
struct BoundTait {
    law: Tait,
    reference: Reference,
    stiffness: f64,
}

impl BoundTait {
    /// ∫ p/ρ² dρ of the uncut law from the reference state, J/kg.
    fn elastic_energy(&self, density: f64) -> f64 {
        let x = density / self.reference.density;
        let xi = self.law.exponent;
        let power = match xi {
            1.0 => x.ln(),
            _ => (x.powf(xi - 1.0) - 1.0) / (xi - 1.0),
        };
        let (b, background) = (self.stiffness, self.law.background_pressure);
        (b * power + (b - background) * (1.0 / x - 1.0)) / self.reference.density
    }
}

impl BoundState for BoundTait {
    fn pressure(&self, density: &[f64], pressure: &mut [f64]) {
        let inverse = 1.0 / self.reference.density;
        let (b, background) = (self.stiffness, self.law.background_pressure);
        let exponent = self.law.exponent;
        let pairs = pressure.iter_mut().zip(density);
        if exponent == 7.0 {
            for (p, rho) in pairs {
                let x = rho * inverse;
                let (x2, x4) = (x * x, (x * x) * (x * x));
                *p = b * (x4 * x2 * x - 1.0) + background;
            }
        } else {
            pairs.for_each(|(p, rho)| *p = b * ((rho * inverse).powf(exponent) - 1.0) + background);
        }
        if let Some(limit) = self.law.tension_limit {
            pressure.iter_mut().for_each(|p| *p = p.max(-limit));
        }
    }

    fn density(&self, pressure: f64) -> f64 {
        let ratio = (pressure - self.law.background_pressure) / self.stiffness + 1.0;
        self.reference.density * ratio.max(0.0).powf(1.0 / self.law.exponent)
    }

    fn sound_speed(&self, density: f64) -> f64 {
        let ratio = (density / self.reference.density).max(0.0);
        self.reference.sound_speed * ratio.powf(0.5 * (self.law.exponent - 1.0))
    }

    fn internal_energy(&self, density: f64) -> f64 {
        let limit = self.law.tension_limit;
        let torn = limit.map(|limit| (limit, self.density(-limit)));
        match torn {
            // Where the tension is cut, the pressure is constant.
            Some((limit, least)) if density < least => {
                self.elastic_energy(least) + limit * (1.0 / density - 1.0 / least)
            }
            _ => self.elastic_energy(density),
        }
    }

    fn reference(&self) -> Reference {
        self.reference
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tension_is_cut_where_a_limit_is_given() {
        let law = Tait {
            tension_limit: Some(5.0),
            ..Tait::default()
        };
        let law = law.bind(Reference {
            density: 1000.0,
            sound_speed: 30.0,
        });
        let mut p = [0.0; 3];
        law.pressure(&[400.0, 999.999, 1001.0], &mut p);
        assert_eq!(p[0], -5.0);
        assert!(p[1] < 0.0 && p[1] > -5.0 && p[2] > 0.0, "{p:?}");
        // The energy stays the integral of p/ρ², also where the tension is cut.
        for rho in [400.0, 900.0, 1010.0] {
            let mut p = [0.0];
            law.pressure(&[rho], &mut p);
            let slope = (law.internal_energy(rho + 1e-3) - law.internal_energy(rho - 1e-3)) / 2e-3;
            assert!((slope - p[0] / (rho * rho)).abs() < 1e-6 * slope.abs().max(1e-3));
        }
    }

    #[test]
    fn density_inverts_pressure_and_sound_is_its_slope() {
        for exponent in [1.0, 1.4, 7.0] {
            let law = Tait {
                exponent,
                background_pressure: 200.0,
                ..Tait::default()
            };
            let law = law.bind(Reference {
                density: 1000.0,
                sound_speed: 30.0,
            });
            for rho in [950.0, 1000.0, 1049.0] {
                let mut p = [0.0; 2];
                law.pressure(&[rho, rho + 1e-4], &mut p);
                assert!((law.density(p[0]) - rho).abs() < 1e-10 * rho);
                let c2 = (p[1] - p[0]) / 1e-4;
                assert!((law.sound_speed(rho).powi(2) / c2 - 1.0).abs() < 1e-5);
                let de = law.internal_energy(rho + 1e-2) - law.internal_energy(rho - 1e-2);
                assert!((de / 2e-2 - p[0] / (rho * rho)).abs() < 1e-6 * c2 / rho);
            }
        }
    }
}
