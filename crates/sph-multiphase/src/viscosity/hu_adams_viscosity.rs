//! The viscous operator of Hu and Adams.

use sph_core::plugin;
use sph_neighbours::Lane;

use crate::viscosity::ViscousOperatorEntry;
use crate::viscosity::friction::{Choice, PairFriction, PairOperator};

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

impl<const D: usize> PairOperator<D> for HuAdamsViscosity {
    type Formula = BothVolumes;
    const STIFFNESS: f64 = 1.0;
    fn formula(&self) -> BothVolumes {
        BothVolumes
    }
    fn choice(&self) -> Choice {
        self.0
    }
}

/// (V_a² + V_b²)/V_a u_ab F_ab: the pair formula of [`HuAdamsViscosity`].
#[derive(Clone, Copy, Debug)]
pub struct BothVolumes;

impl<const D: usize> PairFriction<D> for BothVolumes {
    const NAME: &'static str = "Hu–Adams viscosity";
    const DIRECTIONAL: bool = false;
    #[inline(always)]
    fn strengths<L: Lane>(self, volume: L, there: L, _: L, factor: L) -> [L; 2] {
        [(volume + there * there / volume) * factor, L::splat(0.0)]
    }
    #[inline(always)]
    fn at_element(self, volume: f64, there: f64) -> f64 {
        0.5 * (volume / there + there / volume)
    }
}
