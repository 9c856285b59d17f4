//! The Newtonian fluid.

use crate::{GeneralisedNewtonian, plugin};

/// τ = 2 η γ̇ with constant η.
///
/// Source: Ghaïtanellis 2017, Eq. 1.15–1.16 (the divergence part is dropped).
///
/// ```toml
/// [phase.water.rheology.newtonian]
/// viscosity = "1e-3 Pa s"
/// ```
#[plugin(crate::RheologyEntry, "newtonian", "constant viscosity", source: "Ghaïtanellis 2017, Eq. 1.15–1.16")]
pub struct Newtonian {
    /// Dynamic viscosity η.
    #[parameter(unit: "Pa s", min: 0.0, source: "Ghaïtanellis 2017, Eq. 1.15")]
    pub viscosity: f64,
}

impl GeneralisedNewtonian for Newtonian {
    fn at(&self, _strain_rate: f64) -> f64 {
        self.viscosity
    }
    fn uniform(&self) -> Option<f64> {
        Some(self.viscosity)
    }
    fn largest(&self) -> f64 {
        self.viscosity
    }
}

#[cfg(test)]
mod tests {
    use sph_core::Registry;

    use crate::RheologyEntry;

    #[test]
    fn the_registered_law_reads_units_and_refuses_negative_viscosity() {
        let entry = Registry::<RheologyEntry>::discovered().unwrap();
        let entry = entry.find("newtonian").unwrap();
        let law = (entry.build)(&toml::from_str("viscosity = '2 mPa s'").unwrap()).unwrap();
        assert_eq!(law.uniform_viscosity(), Some(2e-3));
        let refused = (entry.build)(&toml::from_str("viscosity = -1").unwrap()).unwrap_err();
        assert!(refused.to_string().contains("at least 0 Pa s"), "{refused}");
    }
}
