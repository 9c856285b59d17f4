//! Explicit algebraic Reynolds stresses.

use nalgebra::{Matrix3, SMatrix};
use rayon::prelude::*;
use sph_core::{Access, Stage, Symmetric, fields};
use sph_neighbours::{World, column_stage};

use crate::closures::in_space;
use crate::columns::{DISSIPATION, EDDY_STRESS, TURBULENT_ENERGY};

/// R_ij = k (⅔ δ_ij + a_ij), a = β_1 S* + β_4 (S*Ω* − Ω*S*) with S* = τS, Ω* = ½τ(∂u_i/∂x_j − ∂u_j/∂x_i), τ = k/ε:
///
/// β_1 = −(6/5) N/(N² − 2 II_Ω), β_4 = −(6/5)/(N² − 2 II_Ω), and N the largest root of
/// N³ − c₁'N² − (27/10 II_S + 2 II_Ω) N + 2c₁' II_Ω = 0, c₁' = 9/4 (c₁ − 1).
///
/// Of a mean flow in the plane. Source: Wallin and Johansson 2000, Eq. 3.9–3.16, 4.1.
pub struct AlgebraicStress;

/// Stresses from a velocity gradient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anisotropy {
    /// N.
    pub n: f64,
    /// β_1.
    pub beta_1: f64,
    /// a.
    pub tensor: Matrix3<f64>,
    /// β_4 (S*Ω* − Ω*S*), the part of a that is not along the strain.
    pub across: Matrix3<f64>,
}

impl Anisotropy {
    /// C_μ = −β_1/2 of an eddy viscosity with the same shear.
    pub fn c_mu(&self) -> f64 {
        -0.5 * self.beta_1
    }
}

impl AlgebraicStress {
    /// c₁.
    pub const C_1: f64 = 1.8;

    /// N of II_S = tr S*² and II_Ω = tr Ω*² ≤ 0.
    pub fn root(strain: f64, turn: f64) -> f64 {
        let c = 2.25 * (Self::C_1 - 1.0);
        let p_1 = (c * c / 27.0 + 0.45 * strain - 2.0 / 3.0 * turn) * c;
        let p_2 = p_1 * p_1 - (c * c / 9.0 + 0.9 * strain + 2.0 / 3.0 * turn).powi(3);
        if p_2 >= 0.0 {
            return c / 3.0 + (p_1 + p_2.sqrt()).cbrt() + (p_1 - p_2.sqrt()).cbrt();
        }
        let size = (p_1 * p_1 - p_2).sqrt();
        c / 3.0 + 2.0 * size.cbrt() * ((p_1 / size).clamp(-1.0, 1.0).acos() / 3.0).cos()
    }

    /// The stresses of a velocity gradient, 1/s, at a time τ = k/ε, s.
    pub fn anisotropy<const D: usize>(gradient: &SMatrix<f64, D, D>, time: f64) -> Anisotropy {
        let g = in_space(gradient) * time;
        let trace = Matrix3::identity() * (g.trace() / 3.0);
        let s = (g + g.transpose()) * 0.5 - trace;
        let o = (g - g.transpose()) * 0.5;
        let (strain, turn) = ((s * s).trace(), (o * o).trace());
        let n = Self::root(strain, turn);
        let below = n * n - 2.0 * turn;
        let [beta_1, beta_4] = [-1.2 * n / below, -1.2 / below];
        let across = (s * o - o * s) * beta_4;
        Anisotropy {
            n,
            beta_1,
            tensor: s * beta_1 + across,
            across,
        }
    }
}

/// [`EDDY_STRESS`] −ρ k β_4 (S*Ω* − Ω*S*): normal stresses that differ, which drive secondary flows. It does no work on
/// the mean flow. Nothing where k and ε are not known.
///
/// Source: Wallin and Johansson 2000, Eq. 3.9.
pub(crate) fn extra_stress<const D: usize>() -> impl Stage<World<D>> {
    let strained = (fields::DENSITY, fields::VELOCITY_GRADIENT);
    let transported = (TURBULENT_ENERGY, DISSIPATION);
    let (name, access) = (
        "stress of eddies",
        Access::none().here((strained, transported)),
    );
    column_stage::<D, _>(name, access, EDDY_STRESS, move |world, stresses| {
        let (density, gradients) = world.free.all(strained)?;
        let (energy, dissipation) = world.free.all(transported)?;
        let all = stresses.par_iter_mut().enumerate().with_min_len(512);
        all.for_each(|(i, stress)| {
            let (k, e) = (energy[i], dissipation[i]);
            *stress = match e > 0.0 {
                true => {
                    Symmetric::part_of(AlgebraicStress::anisotropy(&gradients[i], k / e).across)
                        * (-density[i] * k)
                }
                false => Symmetric::ZERO,
            };
        });
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix2;

    use super::*;

    fn shear(time: f64) -> Anisotropy {
        AlgebraicStress::anisotropy(&Matrix2::new(0.0, 1.0, 0.0, 0.0), time)
    }

    /// Page §3.8, `earsm-homogeneous`: in shear with P = ε, −a_12 τ du/dz = 1, at τ du/dz = 3.387: N = 4.05, a_12 = −0.295,
    /// a_11 = 0.247 = −a_22, C_μ = 0.0872.
    #[test]
    fn shear_in_balance_has_the_stresses_of_wallin_and_johansson() {
        let (mut low, mut high) = (1.0, 10.0);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            match -shear(middle).tensor[(0, 1)] * middle < 1.0 {
                true => low = middle,
                false => high = middle,
            }
        }
        let found = shear(low);
        assert!((low - 3.387).abs() < 1e-3, "{low}");
        assert!((found.n - 4.05).abs() < 5e-3, "{}", found.n);
        assert!((found.tensor[(0, 1)] + 0.295).abs() < 1e-3);
        assert!((found.tensor[(0, 0)] - 0.247).abs() < 1e-3);
        assert!((found.tensor[(0, 0)] + found.tensor[(1, 1)]).abs() < 1e-12);
        assert!((found.c_mu() - 0.0872).abs() < 1e-4, "{}", found.c_mu());
    }

    #[test]
    fn its_n_solves_the_cubic() {
        let c = 1.8;
        for strain in [0.0, 0.1, 1.0, 30.0, 1e4] {
            for turn in [0.0, -0.1, -1.0, -30.0, -1e4] {
                let n = AlgebraicStress::root(strain, turn);
                let rest = n.powi(3) - c * n * n - (2.7 * strain + 2.0 * turn) * n + 2.0 * c * turn;
                let scale = n.abs().powi(3) + c * n * n + (2.7 * strain - 2.0 * turn) * n.abs()
                    - 2.0 * c * turn;
                assert!(
                    rest.abs() <= 1e-10 * scale.max(1e-300),
                    "{rest} at {strain}, {turn}"
                );
            }
        }
    }
}
