//! The interface force of Grenier et al. (2009).

use sph_core::plugin;
use sph_neighbours::Lane;

use crate::repulsion::{Repelling, Repulsion};
use crate::{InterfaceEntry, offer_interface};
use sph_contribution::{Contribution, Offer, Refusal, Setting};

/// ρ_a a = −ε Σ_{b of other phases} V_b (|p_a| + |p_b|) ∇w_ab.
///
/// Symbols: ε number; p pressure (Pa); V volume (m^d). Conserves momentum to rounding. The source
/// divides p by the filling of the formulation it belongs to ([`Grenier`](crate::Grenier)), which is
/// 1 up to noise at an interface and left out here, so that it serves every formulation.
///
/// Source: Grenier et al. 2009; ε from 0.01 to 0.1.
///
/// ```toml
/// [interface.grenier]
/// strength = 0.08
/// ```
#[plugin(InterfaceEntry [2, 3], "grenier", "repulsion between phases that keeps interfaces sharp",
    source: "Grenier et al. 2009", cfg(not(test)))]
pub struct GrenierInterface {
    /// Strength ε.
    #[parameter(default: 0.08, unit: "1", min: 0.0, max: 1.0, source: "Grenier et al. 2009: 0.01 to 0.1")]
    pub strength: f64,
}

/// V_a V_b (|p_a| + |p_b|).
#[derive(Clone, Copy, Debug)]
struct BothVolumes;

impl Repulsion for BothVolumes {
    const NAME: &'static str = "Grenier interface force";
    #[inline(always)]
    fn weight<L: Lane>(pressure: L, volume: L, there: L, there_volume: L) -> L {
        volume * there_volume * (pressure.abs() + there.abs())
    }
}

impl<const D: usize> Contribution<D> for GrenierInterface {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        offer_interface(
            Repelling::<BothVolumes>::boxed(self.strength),
            setting,
            offer,
        )
    }
}
