//! The viscous operator of Monaghan and Gingold.

use sph_core::plugin;
use sph_neighbours::Lane;

use crate::viscosity::ViscousOperatorEntry;
use crate::viscosity::friction::{Choice, PairFriction, PairOperator};

/// L_a = 2(d + 2)/γ_a Σ_b θ_b V_b η̄_ab F_ab (u_ab·e)e plus the wall's friction, as of
/// [`Morris`](crate::viscosity::Morris): div(η(∇u + ∇uᵀ)) + ∇(η div u), also for variable η.
///
/// Forces are along the line of centres: conserves linear and angular momentum. On a square lattice
/// with h = 2δr a sheared layer has 4 % too little. Explicitly stable for νΔt/h² ≤ 0.1.
///
/// Source: Monaghan & Gingold 1983; Cleary 1998; as discussed with Krimi et al. 2018, Eq. 41.
///
/// ```toml
/// [viscous-operator.monaghan-gingold]
/// wall_term = "corrected"
/// ```
#[plugin(ViscousOperatorEntry [2, 3], "monaghan-gingold", "central forces: conserves angular momentum; stiffest",
    source: "Monaghan & Gingold 1983; Cleary 1998", cfg(not(test)))]
#[derive(Copy, Default)]
pub struct MonaghanGingold(pub Choice);

impl<const D: usize> PairOperator<D> for MonaghanGingold {
    type Formula = Central;
    const STIFFNESS: f64 = 2.7;
    /// Pairs act along their line.
    const LEAVES_ROTATIONS: bool = true;
    fn formula(&self) -> Central {
        Central
    }
    fn choice(&self) -> Choice {
        self.0
    }
}

/// 2(d + 2) V_b F_ab (u_ab·e)e: the pair formula of [`MonaghanGingold`].
#[derive(Clone, Copy, Debug)]
pub struct Central;

impl<const D: usize> PairFriction<D> for Central {
    const NAME: &'static str = "Monaghan–Gingold viscosity";
    const EVEN: bool = false;
    #[inline(always)]
    fn strengths<L: Lane>(self, _: L, there: L, distance2: L, factor: L) -> [L; 2] {
        let along = L::splat((2 * (D + 2)) as f64) * there * factor;
        let along = along / distance2.max(L::splat(f64::MIN_POSITIVE));
        [L::splat(0.0), along]
    }
}
