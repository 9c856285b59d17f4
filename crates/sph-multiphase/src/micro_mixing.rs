//! The force against micro-mixing.

use sph_core::plugin;
use sph_neighbours::Lane;

use crate::repulsion::{Repelling, Repulsion};
use crate::{InterfaceEntry, offer_interface};
use sph_contribution::{Contribution, Offer, Refusal, Setting};

/// m_a a = −ε Σ_{b of other phases} (|p_a| V_a² + |p_b| V_b²) ∇w_ab: a share ε of the pressure
/// gradient between phases, always repulsive.
///
/// Symbols: ε number; p pressure (Pa); V volume (m^d). Conserves momentum to rounding. It does
/// nothing where there is no pressure, and depends on the level of the pressure. Thickens the gap between the
/// phases by about ε: it is a numerical force, not surface tension.
///
/// Source: Ghaïtanellis 2017, Eq. 3.32, corrected: Eq. 3.33 and 4.124 print the sign of an attraction.
///
/// ```toml
/// [interface.micro-mixing]
/// strength = 0.01
/// ```
#[plugin(InterfaceEntry [2, 3], "micro-mixing", "repulsion between phases against micro-mixing",
    source: "Ghaïtanellis 2017, Eq. 3.32", cfg(not(test)))]
pub struct MicroMixing {
    /// Strength ε.
    #[parameter(default: 0.01, unit: "1", min: 0.0, max: 1.0, source: "Ghaïtanellis 2017, Eq. 3.32: 0.005 to 0.015")]
    pub strength: f64,
}

/// |p_a| V_a² + |p_b| V_b².
#[derive(Clone, Copy, Debug)]
struct OwnVolumes;

impl Repulsion for OwnVolumes {
    const NAME: &'static str = "micro-mixing force";
    #[inline(always)]
    fn weight<L: Lane>(pressure: L, volume: L, there: L, there_volume: L) -> L {
        pressure.abs() * volume * volume + there.abs() * there_volume * there_volume
    }
}

impl<const D: usize> Contribution<D> for MicroMixing {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        offer_interface(
            Repelling::<OwnVolumes>::boxed(self.strength),
            setting,
            offer,
        )
    }
}
