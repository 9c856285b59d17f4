//! The Herschel–Bulkley fluid.

use crate::{Inputs, Needs, PowerLaw, Regularisation, Rheology, plugin};

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
    /// The law without its yield stress.
    pub fn viscous_part(&self) -> PowerLaw {
        PowerLaw {
            consistency: self.consistency,
            exponent: self.exponent,
            smallest_viscosity: self.smallest_viscosity,
            largest_viscosity: self.largest_viscosity,
        }
    }

    /// η at a strain rate, Pa s.
    pub fn at(&self, strain_rate: f64) -> f64 {
        let viscous = self.viscous_part().at(strain_rate);
        let plastic = self
            .regularisation
            .plastic(self.yield_stress, strain_rate, viscous);
        (viscous + plastic).min(self.largest_viscosity)
    }
}

impl Rheology for HerschelBulkley {
    fn needs(&self) -> Needs {
        Needs {
            strain_rate: self.uniform_viscosity().is_none(),
            pressure: false,
        }
    }
    fn uniform_viscosity(&self) -> Option<f64> {
        match self.yield_stress > 0.0 {
            true => None,
            false => self.viscous_part().uniform_viscosity(),
        }
    }
    fn viscosity(&self, inputs: &Inputs<'_>, viscosity: &mut [f64]) {
        for (k, eta) in viscosity.iter_mut().enumerate() {
            *eta = self.at(inputs.at(k).0);
        }
    }
    fn largest_viscosity(&self) -> f64 {
        match self.viscous_part().uniform_viscosity() {
            None => self.largest_viscosity,
            Some(viscous) => {
                let plastic = self
                    .regularisation
                    .largest_plastic(self.yield_stress, viscous);
                (viscous + plastic).min(self.largest_viscosity)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Bingham;

    const SMOOTH: Regularisation = Regularisation::Papanastasiou {
        stress_growth: 10.0,
    };

    #[test]
    fn with_exponent_one_it_is_a_bingham_fluid() {
        let law = HerschelBulkley {
            consistency: 0.5,
            exponent: 1.0,
            yield_stress: 3.0,
            regularisation: SMOOTH,
            smallest_viscosity: 0.0,
            largest_viscosity: 1e9,
        };
        let bingham = Bingham {
            viscosity: 0.5,
            yield_stress: 3.0,
            regularisation: SMOOTH,
        };
        for strain_rate in [0.0, 1e-9, 1e-3, 0.2, 7.0, 1e5] {
            let mut eta = [0.0];
            let inputs = Inputs {
                strain_rate: &[strain_rate],
                pressure: &[],
            };
            bingham.viscosity(&inputs, &mut eta);
            assert_eq!(law.at(strain_rate), eta[0]);
        }
        assert_eq!(law.largest_viscosity(), bingham.largest_viscosity());
    }

    #[test]
    fn above_yield_the_stress_is_that_of_the_law() {
        let law = HerschelBulkley {
            consistency: 5.0,
            exponent: 0.4,
            yield_stress: 25.0,
            regularisation: SMOOTH,
            smallest_viscosity: 0.0,
            largest_viscosity: 400.0,
        };
        for rate in [5.0_f64, 40.0, 300.0] {
            let stress = 25.0 + 5.0 * rate.powf(0.4);
            assert!((law.at(rate) * rate / stress - 1.0).abs() < 1e-14);
        }
        assert_eq!(law.at(0.0), 400.0);
    }
}
