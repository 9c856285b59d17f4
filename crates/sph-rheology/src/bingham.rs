//! The Bingham fluid.

use crate::{Inputs, Needs, Regularisation, Rheology, plugin};

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

impl Rheology for Bingham {
    fn needs(&self) -> Needs {
        Needs {
            strain_rate: self.yield_stress > 0.0,
            pressure: false,
        }
    }
    fn uniform_viscosity(&self) -> Option<f64> {
        (self.yield_stress <= 0.0).then_some(self.viscosity)
    }
    fn viscosity(&self, inputs: &Inputs<'_>, viscosity: &mut [f64]) {
        for (k, eta) in viscosity.iter_mut().enumerate() {
            let (rate, _) = inputs.at(k);
            let plastic = self
                .regularisation
                .plastic(self.yield_stress, rate, self.viscosity);
            *eta = self.viscosity + plastic;
        }
    }
    fn largest_viscosity(&self) -> f64 {
        let plastic = self
            .regularisation
            .largest_plastic(self.yield_stress, self.viscosity);
        self.viscosity + plastic
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::RheologyEntry;
    use sph_core::Registry;

    /// Values of Krimi et al. 2018, Eq. 13, computed apart.
    #[test]
    fn the_table_of_values_is_met() {
        let mud = Bingham {
            viscosity: 0.07,
            yield_stress: 25.0,
            regularisation: Regularisation::Ratio { ratio: 1000.0 },
        };
        let strain_rate = [0.0, 0.1, 1.0, 10.0, 100.0];
        let mut eta = [0.0; 5];
        let inputs = Inputs {
            strain_rate: &strain_rate,
            pressure: &[],
        };
        mud.viscosity(&inputs, &mut eta);
        let table = [70.0, 67.414968, 23.610881, 2.5684039, 0.3199984];
        for (eta, table) in eta.iter().zip(table) {
            assert!((eta / table - 1.0).abs() < 1e-6, "{eta} {table}");
        }
        assert_eq!(mud.largest_viscosity(), 0.07 * 999.0 + 0.07);
    }

    #[test]
    fn the_regularisation_is_a_table_that_is_checked() {
        let entry = Registry::<RheologyEntry>::discovered().expect("unique names");
        let entry = entry.find("bingham").expect("registered");
        let build = |text: &str| {
            (entry.build)(
                &toml::from_str(&format!("viscosity = 1\nyield_stress = 2\n{text}")).expect("TOML"),
            )
            .map(|law| law.largest_viscosity())
            .map_err(|e| e.to_string())
        };
        assert_eq!(
            build("regularisation.papanastasiou = { stress_growth = '100 ms' }"),
            Ok(1.2)
        );
        assert_eq!(
            build("regularisation.bi-viscosity = { largest_viscosity = 30 }"),
            Ok(30.0)
        );
        assert_eq!(
            build("regularisation.bercovier-engelman = { strain_rate = 0.5 }"),
            Ok(5.0)
        );
        assert_eq!(build("regularisation.ratio = { ratio = 7 }"), Ok(7.0));
        let refused = |text: &str, word: &str| {
            let message = build(text).expect_err("refused");
            assert!(message.contains(word), "{message}");
        };
        refused("", "`regularisation` is missing");
        refused("regularisation.ratio = { ratio = 0.5 }", "at least 1");
        refused("regularisation.ratio = { raito = 5 }", "`raito`");
        refused(
            "regularisation.papanastasiu = { stress_growth = 1 }",
            "papanastasi",
        );
    }
}
