//! Viscous operators that are sums over pairs.

use sph_core::{parameters, plugin};
use sph_neighbours::Lane;

use crate::viscosity::friction::{Across, Choice, OnLattice, PairFriction, WallTerm};
use crate::viscosity::{ViscousOperatorEntry, Within};

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

impl<const D: usize> PairFriction<D> for Morris {
    const NAME: &'static str = "Morris viscosity";
    const DIRECTIONAL: bool = false;
    const STIFFNESS: f64 = 1.0;
    fn choice(self) -> Choice {
        self.0
    }
    #[inline(always)]
    fn strengths<L: Lane>(self, _: L, there: L, _: L, factor: L) -> [L; 2] {
        [L::splat(2.0) * there * factor, L::splat(0.0)]
    }
}

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

impl<const D: usize> PairFriction<D> for EspanolRevenga {
    const NAME: &'static str = "Español–Revenga viscosity";
    const STIFFNESS: f64 = 1.75;
    fn choice(self) -> Choice {
        self.0
    }
    #[inline(always)]
    fn strengths<L: Lane>(self, _: L, there: L, distance2: L, factor: L) -> [L; 2] {
        let even = there * factor;
        let along = L::splat((D + 2) as f64) * even;
        [even, along / distance2.max(L::splat(f64::MIN_POSITIVE))]
    }
}

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

impl<const D: usize> PairFriction<D> for MonaghanGingold {
    const NAME: &'static str = "Monaghan–Gingold viscosity";
    const EVEN: bool = false;
    const STIFFNESS: f64 = 2.7;
    /// Pairs act along their line.
    const LEAVES_ROTATIONS: bool = true;
    fn choice(self) -> Choice {
        self.0
    }
    #[inline(always)]
    fn strengths<L: Lane>(self, _: L, there: L, distance2: L, factor: L) -> [L; 2] {
        let along = L::splat((2 * (D + 2)) as f64) * there * factor;
        let along = along / distance2.max(L::splat(f64::MIN_POSITIVE));
        [L::splat(0.0), along]
    }
}

/// L_a = 1/γ_a Σ_b θ_b (V_a² + V_b²)/V_a η̄_ab u_ab F_ab plus the wall's friction, as of
/// [`Morris`](crate::viscosity::Morris) times (V_a² + V_s²)/(2 V_a V_s).
///
/// The same as Morris's operator for equal volumes. The thesis prints the wall's factor without the
/// 1/2, which is twice Morris's.
///
/// Source: Ghaïtanellis 2017, Eq. 3.27, corrected; Hu & Adams 2006.
///
/// ```toml
/// [viscous-operator.hu-adams]
/// wall_term = "corrected"
/// ```
#[plugin(ViscousOperatorEntry [2, 3], "hu-adams", "div(η grad u) with the volumes of both particles",
    source: "Ghaïtanellis 2017, Eq. 3.27; Hu & Adams 2006", cfg(not(test)))]
#[derive(Copy, Default)]
pub struct HuAdamsViscosity(pub Choice);

impl<const D: usize> PairFriction<D> for HuAdamsViscosity {
    const NAME: &'static str = "Hu–Adams viscosity";
    const DIRECTIONAL: bool = false;
    const STIFFNESS: f64 = 1.0;
    fn choice(self) -> Choice {
        self.0
    }
    #[inline(always)]
    fn strengths<L: Lane>(self, volume: L, there: L, _: L, factor: L) -> [L; 2] {
        [(volume + there * there / volume) * factor, L::splat(0.0)]
    }
    #[inline(always)]
    fn at_element(self, volume: f64, there: f64) -> f64 {
        0.5 * (volume / there + there / volume)
    }
}

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
    const BY_DENSITY: bool = true;
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
    fn at_element(self, _: f64, _: f64) -> f64 {
        match self.strength {
            Strength::Corrected => 1.0,
            Strength::Literal => (D + 3) as f64 / (D + 2) as f64,
        }
    }
}
