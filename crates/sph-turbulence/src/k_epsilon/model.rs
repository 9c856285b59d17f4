//! The equations of the k–ε model at one place.

use sph_core::parameters;

use super::realisable::RealisableModel;

/// Equations of k and ε.
#[parameters]
pub enum Variant {
    /// Launder and Spalding 1974, with the production of Guimet and Laurence 2002: [`KEpsilonModel`].
    #[default]
    Standard,
    /// Shih et al. 1995: [`RealisableModel`].
    Realisable,
    /// The standard equations, with P = −R_ij ∂u_i/∂x_j and the stresses of Wallin and Johansson 2000,
    /// [`AlgebraicStress`](super::AlgebraicStress): the part along the strain is an eddy viscosity η_t = −½ρβ_1 k²/ε, the rest,
    /// which does no work, a stress whose divergence acts. The isotropic part is in the pressure.
    ExplicitAlgebraic,
}

impl Variant {
    /// σ_k and σ_ε.
    pub(crate) fn sigmas(self) -> [f64; 2] {
        match self {
            Variant::Standard | Variant::ExplicitAlgebraic => {
                [KEpsilonModel::SIGMA_K, KEpsilonModel::SIGMA_EPSILON]
            }
            Variant::Realisable => [RealisableModel::SIGMA_K, RealisableModel::SIGMA_EPSILON],
        }
    }
}

/// The standard k–ε model. Source: Launder and Spalding 1974; Issa 2004, Eq. 5.32.
pub struct KEpsilonModel;

impl KEpsilonModel {
    /// C_μ.
    pub const C_MU: f64 = 0.09;
    /// σ_k.
    pub const SIGMA_K: f64 = 1.0;
    /// σ_ε.
    pub const SIGMA_EPSILON: f64 = 1.3;
    /// C_ε1.
    pub const C_1: f64 = 1.44;
    /// C_ε2.
    pub const C_2: f64 = 1.92;

    /// ν_t = C_μ k²/ε, m²/s. Issa 2004, Eq. 5.26.
    pub fn eddy_viscosity(energy: f64, dissipation: f64) -> f64 {
        Self::C_MU * energy * energy / dissipation
    }

    /// P = min(√C_μ, C_μ k S/ε) k S, m²/s³, at a strain rate S = √(2 D:D), 1/s: ν_t S² of weak strain, linear in S of
    /// strong. Source: Guimet and Laurence 2002; Issa 2004, Eq. 5.29 and 5.63 with their square roots.
    pub fn production(energy: f64, dissipation: f64, strain_rate: f64) -> f64 {
        let weak = Self::C_MU * energy / dissipation * strain_rate;
        Self::C_MU.sqrt().min(weak) * energy * strain_rate
    }

    /// k and ε after `dt` seconds of a production P, m²/s³, and of dissipation, the sinks of the end of the step:
    ///
    /// k' = (k + Δt P)/(1 + Δt ε/k), ε' = (ε + Δt C_ε1 P ε/k)/(1 + Δt C_ε2 ε/k),
    ///
    /// which are positive whatever Δt.
    pub fn produced(energy: f64, dissipation: f64, production: f64, dt: f64) -> [f64; 2] {
        let rate = dissipation / energy;
        [
            (energy + dt * production) / (1.0 + dt * rate),
            (dissipation + dt * Self::C_1 * production * rate) / (1.0 + dt * Self::C_2 * rate),
        ]
    }

    /// k and ε after `dt` seconds next to a wall that no flux of k passes, with u_k = C_μ^¼ √k: P = u*² u_k/(κz) and
    /// ε = u_k³/(κz), which balance where u_k = u*. Source: Launder and Spalding 1974, §4; Ferrand et al. 2013 (no flux of k).
    pub fn with_flux(
        energy: f64,
        friction_velocity: f64,
        distance: f64,
        karman: f64,
        dt: f64,
    ) -> [f64; 2] {
        let speed = |k: f64| Self::C_MU.powf(0.25) * k.sqrt();
        let dissipation = |k: f64| speed(k).powi(3) / (karman * distance);
        let produced = Self::wall_production(energy, friction_velocity, distance, karman);
        let next = (energy + dt * produced) / (1.0 + dt * dissipation(energy) / energy);
        [next, dissipation(next)]
    }

    /// P = u*² u_k/(κz) next to a wall, u_k = C_μ^¼ √k, m²/s³. Source: Launder and Spalding 1974, §4.
    pub fn wall_production(energy: f64, friction_velocity: f64, distance: f64, karman: f64) -> f64 {
        let speed = Self::C_MU.powf(0.25) * energy.sqrt();
        friction_velocity.powi(2) * speed / (karman * distance)
    }

    /// ε = k^{3/2}/(0.18 H) at the surface of a channel of a depth H, m: eddies there are limited to a share of it.
    /// Source: Celik and Rodi 1984 (Naot and Rodi 1982: C_μ^¾ k^{3/2}/(κ 0.07 H)).
    pub fn at_surface(energy: f64, depth: f64) -> f64 {
        energy.powf(1.5) / (0.18 * depth)
    }

    /// k = u*²/√C_μ and ε = u*³/(κz) where production balances dissipation in the logarithm. Issa 2004, Eq. 5.33.
    pub fn at_wall(friction_velocity: f64, distance: f64, karman: f64) -> [f64; 2] {
        let squared = friction_velocity * friction_velocity;
        [
            squared / Self::C_MU.sqrt(),
            squared * friction_velocity / (karman * distance),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Page §4.10 `k-eps-decay`: k = k₀(1 + (C_ε2 − 1)ε₀t/k₀)^{−1/(C_ε2 − 1)}, to 1e-3.
    #[test]
    fn homogeneous_turbulence_decays_with_the_exponent_of_the_model() {
        let decayed = |steps: i32| {
            let (start, end) = ([0.02, 0.05], 10.0);
            let dt = end / f64::from(steps);
            let each = (0..steps).fold(start, |[k, e], _| KEpsilonModel::produced(k, e, 0.0, dt));
            let time = 1.0 + 0.92 * start[1] * end / start[0];
            let exact = start[0] * time.powf(-1.0 / 0.92);
            (each[0] / exact - 1.0).abs()
        };
        let errors = [1000, 2000, 40_000].map(decayed);
        assert!(errors[2] < 1e-3, "{errors:?}");
        // First order: half the step, half the error.
        assert!((errors[0] / errors[1] - 2.0).abs() < 0.1, "{errors:?}");
    }

    #[test]
    fn both_stay_positive_whatever_the_step() {
        for dt in [1e-6, 1.0, 1e9] {
            for strain_rate in [0.0, 1.0, 1e6] {
                let production = KEpsilonModel::production(1e-12, 1e3, strain_rate);
                let [k, e] = KEpsilonModel::produced(1e-12, 1e3, production, dt);
                assert!(k > 0.0 && e > 0.0 && k.is_finite() && e.is_finite());
            }
        }
    }

    /// In the logarithm S = u*/(κz), so that P = ε and ν_t = κu*z.
    #[test]
    fn wall_values_are_in_balance() {
        let (u, z, kappa) = (0.05, 0.013, 0.41);
        let [k, e] = KEpsilonModel::at_wall(u, z, kappa);
        let strain_rate = u / (kappa * z);
        assert!((KEpsilonModel::production(k, e, strain_rate) / e - 1.0).abs() < 1e-12);
        assert!((KEpsilonModel::eddy_viscosity(k, e) / (kappa * u * z) - 1.0).abs() < 1e-12);
    }

    /// Left to itself k next to a wall tends to u*²/√C_μ, from above and from below.
    #[test]
    fn without_a_flux_of_k_the_wall_layer_finds_its_balance() {
        let (u, z, kappa) = (0.05, 0.013, 0.41);
        let values = KEpsilonModel::at_wall(u, z, kappa);
        for start in [1e-6, 1.0] {
            let mut both = [start, 0.0];
            for _ in 0..10_000 {
                both = KEpsilonModel::with_flux(both[0], u, z, kappa, 0.1);
            }
            for (found, exact) in both.iter().zip(values) {
                assert!((found / exact - 1.0).abs() < 1e-9, "{found}, {exact}");
            }
        }
    }

    /// Homogeneous shear at P = ε needs S k/ε = 1/√C_μ: stronger strain produces linearly, not with its square.
    #[test]
    fn strong_strain_produces_linearly() {
        let at = |s: f64| KEpsilonModel::production(1.0, 1.0, s);
        assert!((at(2.0) / at(1.0) - 4.0).abs() < 1e-12);
        assert!((at(20.0) / at(10.0) - 2.0).abs() < 1e-12);
    }
}
