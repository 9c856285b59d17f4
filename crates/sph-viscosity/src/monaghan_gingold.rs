//! The viscous operator of Monaghan and Gingold.

use sph_core::plugin;
use sph_neighbours::{Interaction, Lane};

use crate::friction::{Across, Choice, OnLattice, PairFriction, WallTerm};
use crate::{Coupling, Viscosity, ViscousOperator, ViscousOperatorEntry, Within};
use sph_contribution::Stages;

/// L_a = 2(d + 2)/γ_a Σ_b θ_b V_b η̄_ab F_ab (u_ab·e)e plus the wall's friction, as of
/// [`Morris`](crate::Morris): div(η(∇u + ∇uᵀ)) + ∇(η div u), also for variable η.
///
/// Forces are along the line of centres: conserves linear and angular momentum. On a square lattice
/// with h = 2δr a sheared layer feels 4 % too little. Explicitly stable for νΔt/h² ≤ 0.1.
///
/// Source: Monaghan & Gingold 1983; Cleary 1998; as discussed with Krimi et al. 2018, Eq. 41.
///
/// ```toml
/// [viscous-operator.monaghan-gingold]
/// wall_term = "corrected"
/// ```
#[plugin(ViscousOperatorEntry [2, 3], "monaghan-gingold", "central forces: conserves angular momentum; stiffest",
    source: "Monaghan & Gingold 1983; Cleary 1998", cfg(not(test)))]
#[derive(Copy)]
pub struct MonaghanGingold {
    /// Friction at walls.
    #[parameter(default)]
    pub wall_term: WallTerm,
    /// Scale of the operator on a lattice.
    #[parameter(default, source: "ours; literal: as printed")]
    pub on_lattice: OnLattice,
    /// Viscosity of pairs of two phases.
    #[parameter(default, source: "ours; harmonic: Ghaïtanellis 2017, Eq. 3.30")]
    pub across: Across,
    /// Viscosity of pairs of one phase.
    #[parameter(default, source: "ours; harmonic: Ghaïtanellis 2017, Eq. 3.30")]
    pub within: Within,
}

impl MonaghanGingold {
    fn choice(&self) -> Choice {
        Choice {
            wall_term: self.wall_term,
            on_lattice: self.on_lattice,
            across: self.across,
            within: self.within,
        }
    }
}

impl<const D: usize> ViscousOperator<D> for MonaghanGingold {
    fn term(&self, viscosity: Viscosity) -> Box<dyn Interaction<D>> {
        self.choice().term(Central, viscosity)
    }
    fn coupling(&self, viscosity: Viscosity) -> Box<dyn Coupling<D>> {
        self.choice().coupling(Central, viscosity)
    }
    fn stages(&self, viscosity: Viscosity) -> Stages<D> {
        self.choice().stages(viscosity)
    }
    fn stiffness(&self) -> f64 {
        2.7
    }
    /// Pairs act along their line.
    fn leaves_rotations(&self) -> bool {
        true
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
