//! Suspension as plugins.

use sph_core::plugin;

use super::contribution::SuspensionEntry;
use super::parameters::Suspended;
use super::pick_up::{self, PickUp};
use crate::sediment::Grains;

/// Grains that settle and mix; beds take them in and give none.
///
/// ```toml
/// [suspension.settling]
/// grain_diameter = "0.29 mm"
/// grain_density = 1050.0
/// settling = "stokes"
/// start = [{ body = "oil", concentration = 0.5 }]
/// ```
#[plugin(SuspensionEntry, "settling", "grains that settle and mix, and that no flow lifts off a bed",
    source: "Richardson and Zaki 1954; Kynch 1952", cfg(not(test)))]
pub struct Settling(pub Suspended);

/// E = 0.00033 D*^0.3 T^1.5 √((s − 1) g d), T = (θ − θ_c)/θ_c,flat, of sand from 0.13 to 1.5 mm.
///
/// ```toml
/// [suspension.van-rijn]
/// ```
#[plugin(SuspensionEntry, "van-rijn", "pick-up of van Rijn, 0.00033 D*^0.3 T^1.5",
    source: "van Rijn 1984, \"Sediment pick-up functions\"", cfg(not(test)))]
pub struct PickUpVanRijn(pub Suspended);

/// E = w c(θ), c = 0.331 (θ − θ_c)^1.75/(1 + 0.72 (θ − θ_c)^1.75) at two grains over the bed; θ_c is 0.045 in the source.
///
/// ```toml
/// [suspension.zyserman-fredsoe]
/// ```
#[plugin(SuspensionEntry, "zyserman-fredsoe", "pick-up up to the concentration of Zyserman and Fredsøe next to the bed",
    source: "Zyserman and Fredsøe 1994", cfg(not(test)))]
pub struct ZysermanFredsoe(pub Suspended);

/// A law's plugin, with its rate.
macro_rules! pick_up {
    ($plugin:ident, $lifts:literal, $rate:expr) => {
        impl PickUp for $plugin {
            fn suspended(&self) -> &Suspended {
                &self.0
            }
            fn lifts(&self) -> bool {
                $lifts
            }
            fn rate(&self, excess: f64, critical: f64, grains: &Grains, settling: f64) -> f64 {
                $rate(excess, critical, grains, settling)
            }
        }
    };
}

pick_up!(Settling, false, |_, _, _: &Grains, _| 0.0);
pick_up!(PickUpVanRijn, true, |excess, critical, grains, _| {
    pick_up::van_rijn(excess, critical, grains)
});
pick_up!(
    ZysermanFredsoe,
    true,
    |excess, _, _: &Grains, settling: f64| { settling * pick_up::zyserman_fredsoe(excess) }
);
