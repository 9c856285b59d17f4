//! The elastic solid.

use sph_core::Symmetric;

use crate::{Elastic, Gradient, Inputs, Needs, Rheology, jaumann, plugin};

/// dτ/dt = 2𝒢D′ + ωτ − τω with 𝒢 = E/(2(1 + ν)): Hooke's law for the deviatoric stress, which turns
/// with the material.
///
/// Symbols: E Young's modulus (Pa), ν Poisson's ratio, D′ deviatoric strain rate, ω = ½(G − Gᵀ),
/// G_ij = ∂u_i/∂x_j. The pressure is that of the equation of state, so the bulk modulus is ρ₀c₀²
/// and not that of E and ν. A simple shear s gives τ_xy = 𝒢 sin s and τ_xx = 𝒢(1 − cos s), as the
/// Jaumann rate does: shears of up to about one.
///
/// Source: Ghaïtanellis 2017, Eq. 1.18–1.23 and 4.69–4.72 (the last with the other sign of ω, which is
/// that of Eq. 4.69).
///
/// ```toml
/// [phase.rubber.rheology.elastic]
/// young_modulus = "2 MPa"
/// poisson_ratio = 0.4
/// ```
#[plugin(crate::RheologyEntry, "elastic", "Hooke's law for the deviatoric stress, with the Jaumann rate",
    source: "Ghaïtanellis 2017, Eq. 1.18–1.23, 4.69–4.73")]
pub struct ElasticSolid {
    /// Young's modulus E.
    #[parameter(unit: "Pa", above: 0.0, quantity: "modulus", source: "Ghaïtanellis 2017, Eq. 1.21")]
    pub young_modulus: f64,
    /// Poisson's ratio ν.
    #[parameter(unit: "1", above: -1.0, max: 0.5, source: "Ghaïtanellis 2017, Eq. 1.21")]
    pub poisson_ratio: f64,
    /// Viscosity that damps the motion.
    #[parameter(default, unit: "Pa s", min: 0.0, source: "ours")]
    pub viscosity: f64,
}

impl Rheology for ElasticSolid {
    fn needs(&self) -> Needs {
        Needs::default()
    }
    fn uniform_viscosity(&self) -> Option<f64> {
        Some(self.viscosity)
    }
    fn viscosity(&self, _inputs: &Inputs<'_>, viscosity: &mut [f64]) {
        viscosity.fill(self.viscosity);
    }
    fn largest_viscosity(&self) -> f64 {
        self.viscosity
    }
    fn elastic(&self) -> Option<&dyn Elastic> {
        Some(self)
    }
}

impl Elastic for ElasticSolid {
    fn shear_modulus(&self) -> f64 {
        jaumann::shear_modulus(self.young_modulus, self.poisson_ratio)
    }
    fn advance(
        &self,
        _inputs: &Inputs<'_>,
        gradient: &[Gradient],
        dt: f64,
        stress: &mut [Symmetric],
    ) {
        let modulus = self.shear_modulus();
        for (stress, gradient) in stress.iter_mut().zip(gradient) {
            *stress = jaumann::advanced(stress, gradient, modulus, dt);
        }
    }
    fn carried(&self, _inputs: &Inputs<'_>, stress: &[Symmetric], carried: &mut [Symmetric]) {
        carried.copy_from_slice(stress);
    }
}
