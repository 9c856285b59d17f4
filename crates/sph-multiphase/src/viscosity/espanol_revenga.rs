//! The viscous operator of Español and Revenga.

use sph_core::plugin;
use sph_neighbours::Lane;

use crate::viscosity::ViscousOperatorEntry;
use crate::viscosity::friction::{Choice, PairFriction, PairOperator};

/// L_a = 1/γ_a Σ_b θ_b V_b η̄_ab F_ab [(d + 2)(u_ab·e)e + u_ab] plus the wall's friction, as of
/// [`Morris`](crate::viscosity::Morris): div(η(∇u + ∇uᵀ)) for constant η and div u = 0.
///
/// For variable η half of the transposed gradient is lost: the limit is
/// η∇²u + ∇u·∇η + ½(∇u)ᵀ∇η. On a square lattice with h = 2δr a sheared layer has 2 % too
/// little, whatever the spacing. Conserves linear momentum, not angular momentum. Explicitly
/// stable for νΔt/h² ≤ 0.17.
///
/// Source: Ghaïtanellis 2017, Eq. 3.31; Español & Revenga 2003.
///
/// ```toml
/// [viscous-operator.espanol-revenga]
/// wall_term = "corrected"
/// ```
#[plugin(ViscousOperatorEntry [2, 3], "espanol-revenga", "div(η(∇u + ∇uᵀ)) for constant η; stiffer than Morris",
    source: "Ghaïtanellis 2017, Eq. 3.31; Español & Revenga 2003", cfg(not(test)))]
#[derive(Copy, Default)]
pub struct EspanolRevenga(pub Choice);

impl<const D: usize> PairOperator<D> for EspanolRevenga {
    type Formula = WithTransposed;
    const STIFFNESS: f64 = 1.75;
    fn formula(&self) -> WithTransposed {
        WithTransposed
    }
    fn choice(&self) -> Choice {
        self.0
    }
}

/// V_b F_ab [(d + 2)(u_ab·e)e + u_ab]: the pair formula of [`EspanolRevenga`].
#[derive(Clone, Copy, Debug)]
pub struct WithTransposed;

impl<const D: usize> PairFriction<D> for WithTransposed {
    const NAME: &'static str = "Español–Revenga viscosity";
    #[inline(always)]
    fn strengths<L: Lane>(self, _: L, there: L, distance2: L, factor: L) -> [L; 2] {
        let even = there * factor;
        let along = L::splat((D + 2) as f64) * even;
        [even, along / distance2.max(L::splat(f64::MIN_POSITIVE))]
    }
}
