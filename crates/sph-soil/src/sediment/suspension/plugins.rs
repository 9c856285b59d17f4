//! Rates at which a flow lifts grains off its bed.

use sph_core::{Work, contract, plugin};

use crate::sediment::{Grains, Suspended};

/// A law of suspension: the rate at which grains leave a bed for the water over it.
pub trait PickUp: Send {
    /// Settling and mixing of the grains.
    fn suspended(&self) -> &Suspended;
    /// True if it lifts grains: then a scene needs a bed.
    fn lifts(&self) -> bool {
        true
    }
    /// Volume of grains, without pores, that a flow lifts per area and time, m/s, by the excess of the Shields number over its
    /// critical value on the slope, that of a flat bed, and the speed at which the grains settle, m/s. Zero without an excess.
    fn rate(&self, excess: f64, critical: f64, grains: &Grains, settling: f64) -> f64;
}

contract!(
    /// A law of suspension that a scene may name.
    pub SuspensionEntry, "suspension", One, "grains that a flow carries within it", PickUp, .works(Work::Others)
);

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

impl PickUp for Settling {
    fn suspended(&self) -> &Suspended {
        &self.0
    }
    fn lifts(&self) -> bool {
        false
    }
    fn rate(&self, _: f64, _: f64, _: &Grains, _: f64) -> f64 {
        0.0
    }
}

/// E = 0.00033 D*^0.3 T^1.5 √((s − 1) g d), T = (θ − θ_c)/θ_c,flat, of sand from 0.13 to 1.5 mm; the division by θ_c,flat on
/// slopes is ours, because θ_c vanishes at the angle of repose. Source: Eq. 9.
///
/// ```toml
/// [suspension.van-rijn]
/// ```
#[plugin(SuspensionEntry, "van-rijn", "pick-up of van Rijn, 0.00033 D*^0.3 T^1.5",
    source: "van Rijn 1984, \"Sediment pick-up functions\"", cfg(not(test)))]
pub struct PickUpVanRijn(pub Suspended);

impl PickUp for PickUpVanRijn {
    fn suspended(&self) -> &Suspended {
        &self.0
    }
    fn rate(&self, excess: f64, critical: f64, grains: &Grains, _: f64) -> f64 {
        if !(critical > 0.0 && excess > 0.0) {
            return 0.0;
        }
        let stage = excess / critical;
        let speed = grains.unit_transport() / grains.diameter;
        0.000_33 * grains.dimensionless_diameter().powf(0.3) * stage.powf(1.5) * speed
    }
}

/// E = w c(θ), c = 0.331 (θ − θ_c)^1.75/(1 + 0.72 (θ − θ_c)^1.75) at two grains over the bed; θ_c is 0.045 in the source.
///
/// ```toml
/// [suspension.zyserman-fredsoe]
/// ```
#[plugin(SuspensionEntry, "zyserman-fredsoe", "pick-up up to the concentration of Zyserman and Fredsøe next to the bed",
    source: "Zyserman and Fredsøe 1994", cfg(not(test)))]
pub struct ZysermanFredsoe(pub Suspended);

impl PickUp for ZysermanFredsoe {
    fn suspended(&self) -> &Suspended {
        &self.0
    }
    fn rate(&self, excess: f64, _: f64, _: &Grains, settling: f64) -> f64 {
        let excess = excess.max(0.0).powf(1.75);
        settling * (0.331 * excess / (1.0 + 0.331 / 0.46 * excess))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAND: Grains = Grains {
        diameter: 2e-4,
        relative_density: 2.65,
        viscosity: 1e-6,
        gravity: 9.81,
    };

    /// The rates of van Rijn, and of Zyserman and Fredsøe over the speed of settling.
    fn rates(excess: f64) -> [f64; 2] {
        let own: Suspended = toml::from_str("").expect("defaults");
        let laws: [&dyn PickUp; 2] = [&PickUpVanRijn(own.clone()), &ZysermanFredsoe(own)];
        laws.map(|law| law.rate(excess, 0.048, &SAND, 1.0))
    }

    /// At θ = 0.8, θ_c = 0.048: D* = 5.059, T = 15.67; 0.00033 · 1.627 · 62.0 · 0.0569 m/s = 1.894 mm/s.
    #[test]
    fn rates_are_those_of_the_sources() {
        let [rate, concentration] = rates(0.752);
        assert!((rate - 1.894e-3).abs() < 2e-6, "{rate:e}");
        // 0.752^1.75 = 0.6073.
        assert!((concentration - 0.1399).abs() < 2e-4, "{concentration}");
        // Never more than 0.46.
        assert!((rates(1e6)[1] - 0.46).abs() < 1e-6);
    }

    #[test]
    fn nothing_is_lifted_up_to_the_threshold() {
        for excess in [f64::NEG_INFINITY, -0.048, 0.0] {
            assert_eq!(rates(excess), [0.0; 2]);
        }
        assert!(rates(1e-9).iter().all(|rate| *rate > 0.0));
    }
}
