//! Fluids with a yield stress.

use crate::{GeneralisedNewtonian, PowerLaw, Regularisation, plugin};

/// η = η_∞ + τ_y/γ̇ above the yield stress τ_y, rigid below it; regularised.
///
/// Source: Ghaïtanellis 2017, Eq. 4.5.
///
/// ```toml
/// [phase.mud.rheology.bingham]
/// viscosity = "0.07 Pa s"
/// yield_stress = "25 Pa"
/// regularisation.papanastasiou = { stress_growth = "10 s" }
/// ```
#[plugin(crate::RheologyEntry, "bingham", "yield stress and constant plastic viscosity",
    source: "Ghaïtanellis 2017, Eq. 4.5")]
#[derive(Copy)]
pub struct Bingham {
    /// Plastic viscosity η_∞.
    #[parameter(unit: "Pa s", min: 0.0, source: "Ghaïtanellis 2017, Eq. 4.5")]
    pub viscosity: f64,
    /// Yield stress τ_y.
    #[parameter(unit: "Pa", min: 0.0, source: "Ghaïtanellis 2017, Eq. 4.5")]
    pub yield_stress: f64,
    /// Limit of the viscosity at rest: a table `papanastasiou` (with `stress_growth`), `bi-viscosity`
    /// (`largest_viscosity`), `bercovier-engelman` (`strain_rate`) or `ratio` (`ratio`).
    pub regularisation: Regularisation,
}

impl GeneralisedNewtonian for Bingham {
    fn at(&self, strain_rate: f64) -> f64 {
        let (limit, viscous) = (&self.regularisation, self.viscosity);
        viscous + limit.plastic(self.yield_stress, strain_rate, viscous)
    }
    fn uniform(&self) -> Option<f64> {
        (self.yield_stress <= 0.0).then_some(self.viscosity)
    }
    fn largest(&self) -> f64 {
        let (limit, viscous) = (&self.regularisation, self.viscosity);
        viscous + limit.largest_plastic(self.yield_stress, viscous)
    }
}

/// η = K γ̇^(n−1) + τ_y/γ̇ above the yield stress τ_y, rigid below it; regularised, and held between
/// a smallest and a largest viscosity.
///
/// The bounds hold for the viscous part and for the sum. In `ratio` the viscous part is that of the
/// present strain rate.
///
/// Source: Herschel & Bulkley 1926; n = 1 is Ghaïtanellis 2017, Eq. 4.5.
///
/// ```toml
/// [phase.mud.rheology.herschel-bulkley]
/// consistency = 5.0
/// exponent = 0.4
/// yield_stress = "25 Pa"
/// regularisation.papanastasiou = { stress_growth = "10 s" }
/// largest_viscosity = "400 Pa s"
/// ```
#[plugin(crate::RheologyEntry, "herschel-bulkley", "yield stress and a power of the strain rate, bounded",
    source: "Herschel & Bulkley 1926")]
#[derive(Copy)]
pub struct HerschelBulkley {
    /// Consistency K.
    #[parameter(unit: "Pa s^n", min: 0.0, source: "Herschel & Bulkley 1926")]
    pub consistency: f64,
    /// Exponent n; 1 is a Bingham fluid.
    #[parameter(unit: "1", above: 0.0, source: "Herschel & Bulkley 1926")]
    pub exponent: f64,
    /// Yield stress τ_y.
    #[parameter(unit: "Pa", min: 0.0, source: "Herschel & Bulkley 1926")]
    pub yield_stress: f64,
    /// Limit of the viscosity at rest: a table `papanastasiou` (with `stress_growth`), `bi-viscosity`
    /// (`largest_viscosity`), `bercovier-engelman` (`strain_rate`) or `ratio` (`ratio`).
    pub regularisation: Regularisation,
    /// Bound of the viscosity from below.
    #[parameter(default, unit: "Pa s", min: 0.0, source: "ours")]
    pub smallest_viscosity: f64,
    /// Bound of the viscosity from above.
    #[parameter(unit: "Pa s", above: 0.0, source: "ours")]
    pub largest_viscosity: f64,
}

impl HerschelBulkley {
    fn viscous_part(&self) -> PowerLaw {
        PowerLaw {
            consistency: self.consistency,
            exponent: self.exponent,
            smallest_viscosity: self.smallest_viscosity,
            largest_viscosity: self.largest_viscosity,
        }
    }
}

impl GeneralisedNewtonian for HerschelBulkley {
    fn at(&self, strain_rate: f64) -> f64 {
        let (limit, viscous) = (&self.regularisation, self.viscous_part().at(strain_rate));
        let plastic = limit.plastic(self.yield_stress, strain_rate, viscous);
        (viscous + plastic).min(self.largest_viscosity)
    }
    fn uniform(&self) -> Option<f64> {
        match self.yield_stress > 0.0 {
            true => None,
            false => self.viscous_part().uniform(),
        }
    }
    fn largest(&self) -> f64 {
        let Some(viscous) = self.viscous_part().uniform() else {
            return self.largest_viscosity;
        };
        let limit = &self.regularisation;
        let plastic = limit.largest_plastic(self.yield_stress, viscous);
        (viscous + plastic).min(self.largest_viscosity)
    }
}

/// √τ = √τ_y + √(η_∞ γ̇) above the yield stress τ_y, rigid below it; regularised:
/// η = [√η_∞ + √(τ_y/γ̇) (1 − e^(−√(mγ̇)))]².
///
/// At rest η = (√η_∞ + √(τ_y m))². Blood and chocolate are described so.
///
/// Source: Casson 1959, with the growth of Papanastasiou 1987.
///
/// ```toml
/// [phase.blood.rheology.casson]
/// viscosity = "3.5 mPa s"
/// yield_stress = "4 mPa"
/// stress_growth = "100 s"
/// ```
#[plugin(crate::RheologyEntry, "casson", "roots of stresses add up: yield and viscous", source: "Casson 1959")]
pub struct Casson {
    /// Viscosity η_∞ at high strain rates.
    #[parameter(unit: "Pa s", min: 0.0, source: "Casson 1959")]
    pub viscosity: f64,
    /// Yield stress τ_y.
    #[parameter(unit: "Pa", min: 0.0, source: "Casson 1959")]
    pub yield_stress: f64,
    /// Stress growth time m.
    #[parameter(unit: "s", above: 0.0, source: "Papanastasiou 1987")]
    pub stress_growth: f64,
}

impl GeneralisedNewtonian for Casson {
    fn at(&self, strain_rate: f64) -> f64 {
        let m = self.stress_growth;
        let growth = crate::regularisation::saturation((m * strain_rate).sqrt());
        (self.viscosity.sqrt() + (self.yield_stress * m).sqrt() * growth).powi(2)
    }
    fn uniform(&self) -> Option<f64> {
        (self.yield_stress <= 0.0).then_some(self.viscosity)
    }
    fn largest(&self) -> f64 {
        self.uniform().unwrap_or_else(|| self.at(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{RheologyEntry, rheometer::viscosities};
    use sph_core::Registry;

    /// Values of Krimi et al. 2018, Eq. 13, computed apart.
    #[test]
    fn the_table_of_values_is_met() {
        let mud = Bingham {
            viscosity: 0.07,
            yield_stress: 25.0,
            regularisation: Regularisation::Ratio { ratio: 1000.0 },
        };
        let eta = viscosities(&mud, 0.0, &[0.0, 0.1, 1.0, 10.0, 100.0]);
        let table = [70.0, 67.414968, 23.610881, 2.5684039, 0.3199984];
        for (eta, table) in eta.iter().zip(table) {
            assert!((eta / table - 1.0).abs() < 1e-6, "{eta} {table}");
        }
        assert_eq!(mud.largest(), 0.07 * 999.0 + 0.07);
    }

    #[test]
    fn the_regularisation_is_a_table_that_is_checked() {
        let entry = Registry::<RheologyEntry>::discovered().expect("unique names");
        let entry = entry.find("bingham").expect("registered");
        let build = |text: &str| {
            let text = format!("viscosity = 1\nyield_stress = 2\n{text}");
            let law = (entry.build)(&toml::from_str(&text).expect("TOML"));
            let law = law.map_err(|e| e.to_string());
            law.map(|law| law.largest_viscosity())
        };
        for (text, largest) in [
            ("papanastasiou = { stress_growth = '100 ms' }", 1.2),
            ("bi-viscosity = { largest_viscosity = 30 }", 30.0),
            ("bercovier-engelman = { strain_rate = 0.5 }", 5.0),
            ("ratio = { ratio = 7 }", 7.0),
        ] {
            assert_eq!(build(&format!("regularisation.{text}")), Ok(largest));
        }
        for (text, word) in [
            ("ratio = { ratio = 0.5 }", "at least 1"),
            ("ratio = { raito = 5 }", "`raito`"),
            ("papanastasiu = { stress_growth = 1 }", "papanastasi"),
        ] {
            let message = build(&format!("regularisation.{text}")).expect_err("refused");
            assert!(message.contains(word), "{message}");
        }
        let message = build("").expect_err("refused");
        assert!(message.contains("`regularisation` is missing"), "{message}");
    }

    const SMOOTH: Regularisation = Regularisation::Papanastasiou {
        stress_growth: 10.0,
    };

    const MUD: HerschelBulkley = HerschelBulkley {
        consistency: 5.0,
        exponent: 0.4,
        yield_stress: 25.0,
        regularisation: SMOOTH,
        smallest_viscosity: 0.0,
        largest_viscosity: 400.0,
    };

    #[test]
    fn with_exponent_one_it_is_a_bingham_fluid() {
        let law = HerschelBulkley {
            consistency: 0.5,
            exponent: 1.0,
            yield_stress: 3.0,
            largest_viscosity: 1e9,
            ..MUD
        };
        let bingham = Bingham {
            viscosity: 0.5,
            yield_stress: 3.0,
            regularisation: SMOOTH,
        };
        for strain_rate in [0.0, 1e-9, 1e-3, 0.2, 7.0, 1e5] {
            assert_eq!(law.at(strain_rate), bingham.at(strain_rate));
        }
        assert_eq!(law.largest(), bingham.largest());
    }

    #[test]
    fn above_yield_the_stress_is_that_of_the_law() {
        for rate in [5.0_f64, 40.0, 300.0] {
            let stress = 25.0 + 5.0 * rate.powf(0.4);
            assert!((MUD.at(rate) * rate / stress - 1.0).abs() < 1e-14);
        }
        assert_eq!(MUD.at(0.0), 400.0);
    }

    #[test]
    fn the_roots_of_the_stresses_add_up() {
        let law = Casson {
            viscosity: 3.5e-3,
            yield_stress: 4e-3,
            stress_growth: 100.0,
        };
        for rate in [50.0_f64, 1e3] {
            let stress: f64 = law.at(rate) * rate;
            let root = 4e-3_f64.sqrt() + (3.5e-3 * rate).sqrt();
            assert!((stress.sqrt() / root - 1.0).abs() < 1e-13, "{rate}");
        }
        let rest = (3.5e-3_f64.sqrt() + 0.4_f64.sqrt()).powi(2);
        assert!((law.at(0.0) / rest - 1.0).abs() < 1e-14);
        assert!((law.at(1e-20) / rest - 1.0).abs() < 1e-8);
    }
}
