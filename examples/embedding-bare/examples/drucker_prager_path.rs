//! An elastic–viscoplastic soil sheared to and fro at constant pressure, with the laws of
//! `sph-rheology` alone.

use sph_core::Symmetric;
use sph_rheology::{Cone, DruckerPrager, Elastic, Inputs, Rheology};

/// Shear strain and shear stress (Pa) along a path: to three times the strain of yield, and back to its negative.
pub fn cycle(law: &DruckerPrager, pressure: f64, steps: usize) -> Vec<[f64; 2]> {
    let strain_at_yield = law.yield_stress(pressure) / law.shear_modulus();
    let rate = 1e-4 * law.yield_stress(pressure) / law.yield_viscosity();
    let dt = 9.0 * strain_at_yield / rate / steps as f64;
    let (mut strain, mut stress, mut path) = (0.0, [Symmetric::ZERO], Vec::new());
    for k in 0..steps {
        let rate = if 3 * k < steps { rate } else { -rate };
        let gradient = [[0.0, rate, 0.0], [0.0; 3], [0.0; 3]]; // u = (γ̇ y, 0, 0)
        let inputs = Inputs {
            strain_rate: &[rate.abs()],
            pressure: &[pressure],
        };
        let elastic = law.elastic().expect("the law has an elastic part");
        elastic.advance(&inputs, &[gradient], dt, &mut stress);
        strain += rate * dt;
        path.push([strain, stress[0].0[3]]);
    }
    path
}

/// The PVC pellets of Ghaïtanellis 2017.
pub fn pellets() -> DruckerPrager {
    DruckerPrager {
        young_modulus: 8e5,
        poisson_ratio: 0.3,
        friction_angle: 38_f64.to_radians(),
        cohesion: 0.0,
        grain_diameter: 3.9e-3,
        grain_density: 1580.0,
        blending_order: 2.0,
        cone: Cone::Circumscribed,
        smallest_viscosity: 0.0,
        damping: 0.0,
    }
}

fn main() {
    println!(
        "yield stress at 1 kPa: {:.1} Pa",
        pellets().yield_stress(1000.0)
    );
    for [strain, stress] in cycle(&pellets(), 1000.0, 900).iter().step_by(60) {
        println!("γ = {strain:9.5}   τ = {stress:8.1} Pa");
    }
}
