//! The viscous operator of Krimi et al. (2018).

use sph_core::{parameters, plugin};
use sph_neighbours::Lane;

use crate::viscosity::friction::{Across, Choice, OnLattice, PairFriction, WallTerm};
use crate::viscosity::{BoundViscosity, OwnViscosity, ViscousOperatorEntry, Within};

/// L_a = c/γ_a Σ_b θ_b (V_a² + V_b²)/V_a η̃_ab F_ab [u_ab + (u_ab·e)e] plus the wall's friction, as
/// of [`Morris`](crate::viscosity::Morris), with η̃_ab = (ρ_a η_b + ρ_b η_a)/(ρ_a + ρ_b).
///
/// As printed (c = 1) the operator is (1 + 1/(d + 2)) η∇²u for constant η: 25 % too strong in two
/// dimensions, 20 % in three. `strength = "corrected"` takes c = (d + 2)/(d + 3), which is exact there.
/// The mean weighs by density and is arithmetic: a viscous soil drags a layer of water along.
///
/// Source: Krimi et al. 2018, Eq. 41 and 51.
///
/// ```toml
/// [viscous-operator.krimi]
/// strength = "corrected"
/// ```
#[plugin(ViscousOperatorEntry [2, 3], "krimi", "averages stresses between particles by density; literal or corrected",
    source: "Krimi et al. 2018, Eq. 41", cfg(not(test)))]
#[derive(Copy)]
pub struct KrimiViscosity {
    /// The factor c.
    #[parameter(default, source: "Krimi et al. 2018, Eq. 41; the correction is ours")]
    pub strength: Strength,
    /// Friction at walls.
    #[parameter(default)]
    pub wall_term: WallTerm,
    /// Scale of the operator on a lattice.
    #[parameter(default, source: "ours; literal: as printed")]
    pub on_lattice: OnLattice,
}

/// The factor of the operator.
#[parameters]
pub enum Strength {
    /// Exact for constant viscosity and div u = 0.
    #[default]
    Corrected,
    /// As printed: a quarter too strong in two dimensions.
    Literal,
}

impl<const D: usize> PairFriction<D> for KrimiViscosity {
    const NAME: &'static str = "Krimi viscosity";
    const STIFFNESS: f64 = 1.65;
    fn choice(self) -> Choice {
        Choice {
            wall_term: self.wall_term,
            // Scaled to be exact, the literal strength would not be literal.
            on_lattice: match self.strength {
                Strength::Corrected => self.on_lattice,
                Strength::Literal => OnLattice::Literal,
            },
            across: Across::Harmonic,
            within: Within::Harmonic,
        }
    }
    #[inline(always)]
    fn strengths<L: Lane>(self, volume: L, there: L, distance2: L, factor: L) -> [L; 2] {
        let strength = match self.strength {
            Strength::Corrected => (D + 2) as f64 / (D + 3) as f64,
            Strength::Literal => 1.0,
        };
        let even = L::splat(strength) * (volume + there * there / volume) * factor;
        [even, even / distance2.max(L::splat(f64::MIN_POSITIVE))]
    }
    #[inline(always)]
    fn means<L: Lane>(
        self,
        viscosity: &BoundViscosity<'_>,
        here: &OwnViscosity<L>,
        j: usize,
        rho: [L; 2],
    ) -> L {
        (rho[0] * L::splat(viscosity.at(j)) + rho[1] * here.eta) / (rho[0] + rho[1])
    }
    #[inline(always)]
    fn at_element(self, _: f64, _: f64) -> f64 {
        match self.strength {
            Strength::Corrected => 1.0,
            Strength::Literal => (D + 3) as f64 / (D + 2) as f64,
        }
    }
}
