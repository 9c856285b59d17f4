//! A rheometer: a law sheared alone.
//!
//! A simple shear u = γ̇ y e_x at one pressure, at any [`viscosities`] of steady flow and along the
//! path of [`shear_stresses`] from rest.

use sph_core::Symmetric;

use crate::{Inputs, Rheology};

const XY: usize = 3;

/// Effective viscosities η at strain rates γ̇ (1/s) and one pressure (Pa), Pa s; ηγ̇ is the shear
/// stress of a law without an elastic part.
///
/// ```
/// use sph_rheology::{Newtonian, rheometer};
///
/// let water = Newtonian { viscosity: 1e-3 };
/// assert_eq!(rheometer::viscosities(&water, 0.0, &[0.1, 10.0]), [1e-3, 1e-3]);
/// ```
pub fn viscosities(law: &dyn Rheology, pressure: f64, strain_rates: &[f64]) -> Vec<f64> {
    let pressures = vec![pressure; strain_rates.len()];
    let mut viscosity = vec![0.0; strain_rates.len()];
    law.viscosity(&inputs(law, strain_rates, &pressures), &mut viscosity);
    viscosity
}

/// Shear stresses τ_xy = (carried stress)_xy + ηγ̇ (Pa) of a shear at the constant rate γ̇ (1/s) from
/// rest without stress, at one pressure (Pa) and at strains ∫γ̇ dt that grow from zero.
///
/// From one strain to the next is one step of the law: second order for the built-in ones, as the
/// steps of a run are.
pub fn shear_stresses(
    law: &dyn Rheology,
    pressure: f64,
    strain_rate: f64,
    strains: &[f64],
) -> Vec<f64> {
    let (rates, pressures) = ([strain_rate], [pressure]);
    let felt = inputs(law, &rates, &pressures);
    let mut viscosity = [0.0];
    law.viscosity(&felt, &mut viscosity);
    let viscous = viscosity[0] * strain_rate;
    let Some(elastic) = law.elastic() else {
        return vec![viscous; strains.len()];
    };
    let gradient = [[0.0, strain_rate, 0.0], [0.0; 3], [0.0; 3]];
    let (mut stress, mut carried) = ([Symmetric::ZERO], [Symmetric::ZERO]);
    let mut before = 0.0;
    let stresses = strains.iter().map(|&strain| {
        if strain > before {
            let dt = (strain - before) / strain_rate;
            elastic.advance(&felt, &[gradient], dt, &mut stress);
            before = strain;
        }
        elastic.carried(&felt, &stress, &mut carried);
        carried[0].0[XY] + viscous
    });
    stresses.collect()
}

fn inputs<'a>(law: &dyn Rheology, strain_rate: &'a [f64], pressure: &'a [f64]) -> Inputs<'a> {
    let needs = law.needs();
    let asked = |needed: bool, column: &'a [f64]| if needed { column } else { &[] };
    Inputs {
        strain_rate: asked(needs.strain_rate, strain_rate),
        pressure: asked(needs.pressure, pressure),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Bingham, DruckerPrager, ElasticSolid, Regularisation};

    #[test]
    fn a_sheared_solid_follows_the_sine_whatever_the_rate() {
        let rubber = ElasticSolid {
            young_modulus: 2e6,
            poisson_ratio: 0.4,
            viscosity: 10.0,
        };
        let modulus = 2e6 / 2.8;
        let strains: Vec<f64> = (0..=1000).map(|k| 2e-3 * f64::from(k)).collect();
        for rate in [0.1, 10.0] {
            let stresses = shear_stresses(&rubber, 0.0, rate, &strains);
            for (strain, stress) in strains.iter().zip(stresses) {
                let exact = modulus * strain.sin() + 10.0 * rate;
                let error = (stress - exact).abs();
                assert!(error < 1e-6 * modulus, "{strain}: {stress}");
            }
        }
    }

    #[test]
    fn a_soil_comes_to_its_yield_stress_slowly_or_at_once() {
        let table = "young_modulus = 0.8e6\npoisson_ratio = 0.3\nfriction_angle = 0.5235987755982988\ncone = 'tan'\n\
                     grain_diameter = 3.9e-3\ngrain_density = 2700.0";
        let soil: DruckerPrager = toml::from_str(table).expect("a law");
        let yielding = soil.yield_stress(1000.0);
        let modulus = 0.8e6 / 2.6;
        let strains: Vec<f64> = (0..=400).map(|k| 1e-5 * f64::from(k)).collect();
        let slow = shear_stresses(&soil, 1000.0, 1e-4, &strains);
        assert!((slow[50] / (modulus * strains[50]) - 1.0).abs() < 1e-3);
        assert!((slow[400] / yielding - 1.0).abs() < 1e-4, "{}", slow[400]);
        let liquid = 2.0 * yielding / soil.yield_viscosity();
        let fast = shear_stresses(&soil, 1000.0, liquid, &strains);
        assert!(fast.iter().all(|s| (s / yielding - 1.0).abs() < 1e-12));
    }

    #[test]
    fn a_law_without_memory_has_its_stress_from_the_start() {
        let mud = Bingham {
            viscosity: 2.0,
            yield_stress: 10.0,
            regularisation: Regularisation::Papanastasiou { stress_growth: 1e6 },
        };
        let stress = shear_stresses(&mud, 0.0, 5.0, &[0.0, 1.0]);
        assert!(stress.iter().all(|s| (s - 20.0).abs() < 1e-12));
        assert_eq!(viscosities(&mud, 0.0, &[5.0]), [4.0]);
    }
}
