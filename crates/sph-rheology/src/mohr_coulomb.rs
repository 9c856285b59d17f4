//! The Mohr–Coulomb viscoplastic soil.

use crate::{Inputs, Needs, Regularisation, Rheology, plugin};

/// A Bingham fluid whose yield stress is that of a soil: τ_y = max(p, 0) sin φ + c cos φ.
///
/// Symbols: p pressure, φ friction angle, c cohesion. With `ratio` it is
/// η = μ(α − 1)τ_y/√((μ(α − 1)γ̇)² + τ_y²) + μ, which at rest is αμ for any τ_y > 0 and μ for
/// τ_y = 0: a particle at the surface flickers between the two with the sign of its pressure.
///
/// In isochoric plane strain this is Mohr–Coulomb itself; on other stress paths a cone near it. The
/// pressure is the effective one where the scene computes it; with the total one a soil under water
/// is too strong.
///
/// Source: Krimi et al. 2018, Eq. 19–24.
///
/// ```toml
/// [phase.sand.rheology.mohr-coulomb]
/// viscosity = "0.1 Pa s"
/// friction_angle = "22 deg"
/// regularisation.ratio = { ratio = 3000 }
/// ```
#[plugin(crate::RheologyEntry, "mohr-coulomb", "viscoplastic soil with friction and cohesion",
    source: "Krimi et al. 2018, Eq. 19–24")]
#[derive(Copy)]
pub struct MohrCoulomb {
    /// Plastic viscosity μ.
    #[parameter(unit: "Pa s", min: 0.0, source: "Krimi et al. 2018, Eq. 24")]
    pub viscosity: f64,
    /// Friction angle φ, as in "22 deg".
    #[parameter(unit: "rad", min: 0.0, max: 1.5, source: "Krimi et al. 2018, Eq. 21")]
    pub friction_angle: f64,
    /// Cohesion c.
    #[parameter(default, unit: "Pa", min: 0.0, source: "Krimi et al. 2018, Eq. 21")]
    pub cohesion: f64,
    /// Limit of the viscosity at rest: a table `papanastasiou` (with `stress_growth`), `bi-viscosity`
    /// (`largest_viscosity`), `bercovier-engelman` (`strain_rate`) or `ratio` (`ratio`).
    pub regularisation: Regularisation,
}

impl MohrCoulomb {
    /// τ_y at a pressure, Pa.
    pub fn yield_stress(&self, pressure: f64) -> f64 {
        pressure.max(0.0) * self.friction_angle.sin() + self.cohesion * self.friction_angle.cos()
    }

    fn strong(&self) -> bool {
        self.friction_angle > 0.0 || self.cohesion > 0.0
    }
}

impl Rheology for MohrCoulomb {
    fn slow_friction(&self) -> Option<f64> {
        Some(self.friction_angle.sin()).filter(|slope| *slope > 0.0)
    }
    fn needs(&self) -> Needs {
        Needs {
            strain_rate: self.strong(),
            pressure: self.friction_angle > 0.0,
        }
    }
    fn uniform_viscosity(&self) -> Option<f64> {
        (!self.strong()).then_some(self.viscosity)
    }
    fn viscosity(&self, inputs: &Inputs<'_>, viscosity: &mut [f64]) {
        let (sine, cosine) = self.friction_angle.sin_cos();
        for (k, eta) in viscosity.iter_mut().enumerate() {
            let (rate, pressure) = inputs.at(k);
            let yield_stress = pressure.max(0.0) * sine + self.cohesion * cosine;
            let limit = &self.regularisation;
            *eta = self.viscosity + limit.plastic(yield_stress, rate, self.viscosity);
        }
    }
    /// Infinite for `papanastasiou` and `bercovier-engelman` with friction: there the viscosity at
    /// rest grows with the pressure.
    fn largest_viscosity(&self) -> f64 {
        let strongest = match self.friction_angle > 0.0 {
            true => f64::INFINITY,
            false => self.cohesion,
        };
        let limit = &self.regularisation;
        self.viscosity + limit.largest_plastic(strongest, self.viscosity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rheometer::viscosities;

    fn pile() -> MohrCoulomb {
        MohrCoulomb {
            viscosity: 0.1,
            friction_angle: 22_f64.to_radians(),
            cohesion: 0.0,
            regularisation: Regularisation::Ratio { ratio: 3000.0 },
        }
    }

    /// Values computed independently from Krimi et al. 2018, Eq. 24.
    #[test]
    fn the_table_of_values_is_met() {
        let rates = [0.0, 0.1, 1.0, 10.0, 100.0];
        let table = [
            (-50.0, [0.1; 5]),
            (0.0, [0.1; 5]),
            (100.0, [300.0, 234.21708, 37.271793, 3.8457737, 0.4746063]),
            (1000.0, [300.0, 299.04354, 234.21708, 37.271793, 3.8457737]),
        ];
        for (pressure, row) in table {
            for (eta, table) in viscosities(&pile(), pressure, &rates).iter().zip(row) {
                assert!((eta / table - 1.0).abs() < 1e-6, "{pressure}: {eta}");
            }
        }
        for (pressure, table) in [(100.0, 37.460659), (1000.0, 374.606593)] {
            assert!((pile().yield_stress(pressure) / table - 1.0).abs() < 1e-8);
        }
    }

    #[test]
    fn it_reads_and_bounds_what_its_parameters_ask_for() {
        assert_eq!(pile().largest_viscosity(), 0.1 * 2999.0 + 0.1);
        let smooth = Regularisation::Papanastasiou { stress_growth: 2.0 };
        let soil = MohrCoulomb {
            regularisation: smooth,
            ..pile()
        };
        assert_eq!(soil.largest_viscosity(), f64::INFINITY);
        let clay = MohrCoulomb {
            friction_angle: 0.0,
            cohesion: 5.0,
            ..soil
        };
        assert_eq!(clay.largest_viscosity(), 10.1);
        assert!(!clay.needs().pressure && clay.needs().strain_rate);
        let water = MohrCoulomb {
            cohesion: 0.0,
            ..clay
        };
        assert_eq!(water.uniform_viscosity(), Some(0.1));
        assert_eq!(water.needs(), Needs::default());
    }
}
