//! The realisable k–ε model at one place.

use nalgebra::{Matrix3, SMatrix};

use crate::closures::in_space;

/// C_μ that falls with strain and rotation, so that normal stresses stay positive, and an equation of ε without P:
///
/// C_μ = 1/(A_0 + A_s U* k/ε), U* = √(S_ij S_ij + Ω_ij Ω_ij), A_s = √6 cos(⅓ arccos(√6 W)), W = S_ij S_jk S_ki/(S_ij S_ij)^{3/2},
/// dε/dt = diffusion + C_1 S ε − C_2 ε²/(k + √(νε)), C_1 = max(0.43, η/(η + 5)), η = S k/ε, S = √(2 S_ij S_ij).
///
/// Source: Shih, Liou, Shabbir, Yang and Zhu 1995, Eq. 19–21 and 25.
pub struct RealisableModel;

impl RealisableModel {
    /// A_0.
    pub const A_0: f64 = 4.04;
    /// C_2.
    pub const C_2: f64 = 1.9;
    /// σ_k.
    pub const SIGMA_K: f64 = 1.0;
    /// σ_ε.
    pub const SIGMA_EPSILON: f64 = 1.2;

    /// C_μ of a velocity gradient ∂u_i/∂x_j, 1/s, and a time k/ε, s.
    pub fn c_mu<const D: usize>(gradient: &SMatrix<f64, D, D>, time: f64) -> f64 {
        let g = in_space(gradient);
        let trace = Matrix3::identity() * (g.trace() / 3.0);
        let strain = (g + g.transpose()) * 0.5 - trace;
        let turn = (g - g.transpose()) * 0.5;
        let squared = strain.norm_squared();
        let cubic = (strain * strain * strain).trace();
        let w = match squared > 0.0 {
            true => 6.0f64.sqrt() * cubic / squared.powf(1.5),
            false => 0.0,
        };
        let a_s = 6.0f64.sqrt() * (w.clamp(-1.0, 1.0).acos() / 3.0).cos();
        1.0 / (Self::A_0 + a_s * (squared + turn.norm_squared()).sqrt() * time)
    }

    /// k and ε after `dt` seconds of production P, m²/s³, and dissipation at a strain rate S, 1/s, and a viscosity,
    /// m²/s; the sinks are of the end of the step, so that both are positive for any Δt.
    pub fn after(
        [energy, dissipation]: [f64; 2],
        production: f64,
        strain_rate: f64,
        viscosity: f64,
        dt: f64,
    ) -> [f64; 2] {
        let eta = strain_rate * energy / dissipation;
        let c_1 = (eta / (eta + 5.0)).max(0.43);
        let sink = Self::C_2 * dissipation / (energy + (viscosity * dissipation).sqrt());
        [
            (energy + dt * production) / (1.0 + dt * dissipation / energy),
            dissipation * (1.0 + dt * c_1 * strain_rate) / (1.0 + dt * sink),
        ]
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix2;

    use super::*;

    /// In a layer of shear with P = ε: C_μ (g k/ε)² = 1, of which C_μ = 0.09 (Shih et al. 1995, after Eq. 21).
    #[test]
    fn a_logarithmic_layer_has_c_mu_of_0p0900() {
        let c_mu = |time: f64| RealisableModel::c_mu(&Matrix2::new(0.0, 1.0, 0.0, 0.0), time);
        let time = (1..60).fold(3.0, |t: f64, _| 0.5 * (t + 1.0 / c_mu(t).sqrt()));
        assert!((c_mu(time) * time * time - 1.0).abs() < 1e-9);
        assert!((c_mu(time) - 0.09).abs() < 1e-4, "{}", c_mu(time));
    }

    /// 2/3 k − 2 C_μ k²/ε S_11 > 0 at any strain.
    #[test]
    fn normal_stresses_stay_positive() {
        for rate in [0.1, 1.0, 10.0, 1e4] {
            for ratio in [-1.0, -0.5, 0.0] {
                let other = -1.0 - ratio;
                let g = Matrix3::from_diagonal(&[rate, ratio * rate, other * rate].into());
                let stress = 2.0 / 3.0 - 2.0 * RealisableModel::c_mu(&g, 1.0) * rate;
                assert!(stress > 0.0, "{stress} at {rate}, {ratio}");
            }
        }
    }

    /// k = k₀(1 + (C_2 − 1)ε₀t/k₀)^{−1/(C_2 − 1)} without viscosity and strain.
    #[test]
    fn it_decays_with_its_exponent() {
        let (start, end, steps) = ([0.02, 0.05], 10.0, 40_000);
        let dt = end / f64::from(steps);
        let [k, _] = (0..steps).fold(start, |both, _| {
            RealisableModel::after(both, 0.0, 0.0, 0.0, dt)
        });
        let exact = 0.02 * (1.0 + 0.9 * 0.05 * end / 0.02f64).powf(-1.0 / 0.9);
        assert!((k / exact - 1.0).abs() < 1e-3, "{k}, {exact}");
    }
}
