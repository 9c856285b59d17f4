//! Rates at which a flow lifts grains off its bed.

use super::parameters::Suspended;
use crate::sediment::Grains;

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

/// 0.00033 D*^0.3 T^1.5 √((s − 1) g d), T = (θ − θ_c)/θ_c,flat. Source: van Rijn 1984, "Sediment pick-up functions", Eq. 9;
/// the division by θ_c,flat on slopes is ours, because θ_c vanishes at the angle of repose.
#[must_use]
pub(super) fn van_rijn(excess: f64, critical: f64, grains: &Grains) -> f64 {
    match critical > 0.0 && excess > 0.0 {
        true => {
            let stage = excess / critical;
            let speed = grains.unit_transport() / grains.diameter;
            0.000_33 * grains.dimensionless_diameter().powf(0.3) * stage.powf(1.5) * speed
        }
        false => 0.0,
    }
}

/// Concentration at two grains over the bed: 0.331 (θ − θ_c)^1.75/(1 + 0.331/0.46 (θ − θ_c)^1.75); the source has θ_c = 0.045.
///
/// Source: Zyserman and Fredsøe 1994.
#[must_use]
pub(super) fn zyserman_fredsoe(excess: f64) -> f64 {
    let excess = excess.max(0.0).powf(1.75);
    0.331 * excess / (1.0 + 0.331 / 0.46 * excess)
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

    /// At θ = 0.8, θ_c = 0.048: D* = 5.059, T = 15.67; 0.00033 · 1.627 · 62.0 · 0.0569 m/s = 1.894 mm/s.
    #[test]
    fn rates_are_those_of_the_sources() {
        let rate = van_rijn(0.752, 0.048, &SAND);
        assert!((rate - 1.894e-3).abs() < 2e-6, "{rate:e}");
        // 0.752^1.75 = 0.6073.
        let concentration = zyserman_fredsoe(0.752);
        assert!((concentration - 0.1399).abs() < 2e-4, "{concentration}");
        // Never more than 0.46.
        assert!((zyserman_fredsoe(1e6) - 0.46).abs() < 1e-6);
    }

    #[test]
    fn nothing_is_lifted_up_to_the_threshold() {
        for excess in [f64::NEG_INFINITY, -0.048, 0.0] {
            assert_eq!(van_rijn(excess, 0.048, &SAND), 0.0);
            assert_eq!(zyserman_fredsoe(excess), 0.0);
        }
        assert!(van_rijn(1e-9, 0.048, &SAND) > 0.0 && zyserman_fredsoe(1e-9) > 0.0);
    }
}
