//! Morris's viscous operator with the wall term of Ghaïtanellis (2017).

use sph_core::plugin;
use sph_neighbours::Lane;

use crate::viscosity::ViscousOperatorEntry;
use crate::viscosity::friction::{Choice, PairFriction, PairOperator, ViscousTerm};

/// L_a = 2/γ_a Σ_b θ_b V_b η̄_ab u_ab F_ab − 2κ_a/γ_a Σ_s η_a u_t,as/δr_as |∇γ_as|.
///
/// η̄ is the harmonic mean, u_t the tangential velocity relative to the wall, and
/// δr_as = max((r_a − r_s)·n_s, δr) + λ_s with the slip length λ_s of the wall. Conserves linear
/// momentum, not angular momentum. Explicitly stable for νΔt/h² ≤ 0.29 (h = 2δr, lattice).
///
/// # The wall term
/// For a linear velocity the sum over particles is 2u' Σ_b θ_b V_b F_ab r_ab, and the wall term
/// 2u' ∇γ_a: they cancel as far as the sum is −∇γ_a, which it is to 2 % in the first row of a
/// lattice. The rest, ε u'/h, shifts the wall by ε δr: the literal term is of first order. The
/// corrected one scales the wall's flux by κ_a = Σ θ V F r·G/|G|² with G = ∇γ_a, so that linear
/// velocities are exact whatever the arrangement of the particles; κ = 1 in the literal one.
/// On a curved wall the plane of an element some way off is farther than the wall: the corrected
/// term takes d/(n_s·n) with the distance d and the normal n of the nearest element for δr_as where
/// n_s·n > 0.7, and not less than δr/2; the literal one the height over each plane and not less
/// than δr.
///
/// Source: Ghaïtanellis 2017, Eq. 3.29–3.30 and 2.83–2.89.
///
/// ```toml
/// [viscous-operator.morris]
/// wall_term = "corrected"
/// ```
#[plugin(ViscousOperatorEntry [2, 3], "morris", "div(η grad u) by first differences of velocity; cheap and robust",
    source: "Ghaïtanellis 2017, Eq. 3.29; Morris et al. 1997", cfg(not(test)))]
#[derive(Copy, Default)]
pub struct Morris(pub Choice);

impl<const D: usize> PairOperator<D> for Morris {
    type Formula = FirstDifferences;
    const STIFFNESS: f64 = 1.0;
    fn formula(&self) -> FirstDifferences {
        FirstDifferences
    }
    fn choice(&self) -> Choice {
        self.0
    }
}

/// 2 V_b u_ab F_ab: the pair formula of [`Morris`].
#[derive(Clone, Copy, Debug)]
pub struct FirstDifferences;

/// The term of [`Morris`].
pub type MorrisTerm = ViscousTerm<FirstDifferences>;

impl<const D: usize> PairFriction<D> for FirstDifferences {
    const NAME: &'static str = "Morris viscosity";
    const DIRECTIONAL: bool = false;
    #[inline(always)]
    fn strengths<L: Lane>(self, _: L, there: L, _: L, factor: L) -> [L; 2] {
        [L::splat(2.0) * there * factor, L::splat(0.0)]
    }
}
