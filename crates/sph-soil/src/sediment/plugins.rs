//! The laws of bed load as plugins.

use sph_core::plugin;

use crate::sediment::{BedLoadEntry, BedLoadLaw, Grains, MovingBed};

macro_rules! bed_load {
    ($plugin:ident, $rate:expr) => {
        impl BedLoadLaw for $plugin {
            fn bed(&self) -> &MovingBed {
                &self.0
            }
            fn rate(&self, shields: f64, critical: f64, grains: &Grains) -> f64 {
                $rate(shields, critical, grains)
            }
        }
    };
}

/// q* = 8 (θ − θ_c)^(3/2), of gravel in flumes; 1.5 to 2 times what later analyses of the same data give.
///
/// ```toml
/// [bed-load.meyer-peter-muller]
/// grain_diameter = "1 mm"
/// ```
#[plugin(BedLoadEntry, "meyer-peter-muller", "bed load of Meyer-Peter and Müller, 8 (θ − θ_c)^1.5",
    source: "Meyer-Peter and Müller 1948", cfg(not(test)))]
pub struct MeyerPeterMuller(pub MovingBed);

bed_load!(MeyerPeterMuller, |shields: f64, critical: f64, _| {
    8.0 * (shields - critical).max(0.0).powf(1.5)
});

/// q* = 3.97 (θ − θ_c)^(3/2), the data of Meyer-Peter and Müller without their correction for bed forms.
///
/// ```toml
/// [bed-load.wong-parker]
/// grain_diameter = "1 mm"
/// ```
#[plugin(BedLoadEntry, "wong-parker", "bed load of Wong and Parker, 3.97 (θ − θ_c)^1.5",
    source: "Wong and Parker 2006, Eq. 24", cfg(not(test)))]
pub struct WongParker(pub MovingBed);

bed_load!(WongParker, |shields: f64, critical: f64, _| {
    3.97 * (shields - critical).max(0.0).powf(1.5)
});

/// q* = 5 p (√θ − 0.7 √θ_c) with the share p = (1 + (π μ/(6 (θ − θ_c)))⁴)^(−1/4) of the grains at the surface that move, and the
/// coefficient of friction μ = 0.51. Source: Fredsøe and Deigaard 1992, Eq. 7.59.
///
/// ```toml
/// [bed-load.engelund-fredsoe]
/// grain_diameter = "0.36 mm"
/// ```
#[plugin(BedLoadEntry, "engelund-fredsoe", "bed load of Engelund and Fredsøe, by the share of grains that move",
    source: "Engelund and Fredsøe 1976", cfg(not(test)))]
pub struct EngelundFredsoe(pub MovingBed);

bed_load!(EngelundFredsoe, |shields: f64, critical: f64, _| {
    const FRICTION: f64 = 0.51;
    let excess = shields - critical;
    if excess <= 0.0 {
        return 0.0;
    }
    let held = std::f64::consts::PI * FRICTION / (6.0 * excess);
    let moving = (1.0 + held.powi(4)).powf(-0.25);
    5.0 * moving * (shields.sqrt() - 0.7 * critical.sqrt())
});

/// q* = 0.053 T^2.1/D*^0.3, T = (θ − θ_c)/θ_c,flat, of sand from 0.2 to 2 mm; the division by θ_c,flat on slopes is ours,
/// because θ_c vanishes at the angle of repose.
///
/// ```toml
/// [bed-load.van-rijn]
/// grain_diameter = "0.5 mm"
/// ```
#[plugin(BedLoadEntry, "van-rijn", "bed load of van Rijn, 0.053 T^2.1/D*^0.3",
    source: "van Rijn 1984, Part I, Eq. 22", cfg(not(test)))]
pub struct VanRijn(pub MovingBed);

bed_load!(VanRijn, |shields: f64, critical: f64, grains: &Grains| {
    let excess = (shields - critical).max(0.0) / grains.critical_shields();
    0.053 * excess.powf(2.1) / grains.dimensionless_diameter().powf(0.3)
});

#[cfg(test)]
mod tests {
    use super::*;

    const SAND: Grains = Grains {
        diameter: 1e-3,
        relative_density: 2.65,
        viscosity: 1e-6,
        gravity: 9.81,
    };

    /// The rates of Meyer-Peter and Müller, Wong and Parker, Engelund and Fredsøe, van Rijn.
    fn rates(shields: f64, critical: f64) -> [f64; 4] {
        let bed: MovingBed = toml::from_str("grain_diameter = 0.001").expect("a bed");
        let laws: [&dyn BedLoadLaw; 4] = [
            &MeyerPeterMuller(bed),
            &WongParker(bed),
            &EngelundFredsoe(bed),
            &VanRijn(bed),
        ];
        laws.map(|law| law.rate(shields, critical, &SAND))
    }

    #[test]
    fn nothing_moves_up_to_the_threshold() {
        for theta in [0.0, 0.02, 0.047] {
            assert_eq!(rates(theta, 0.047), [0.0; 4]);
        }
    }

    /// At θ = 0.247, θ_c = 0.047: 8 · 0.2^1.5 = 0.7155 and 3.97 · 0.2^1.5 = 0.3551; p of Engelund and Fredsøe is
    /// (1 + 1.3352⁴)^(−1/4) = 0.6999; D* = 25.30 of van Rijn.
    #[test]
    fn rates_are_those_of_the_sources() {
        let critical = 0.047;
        let p = (1.0 + 1.335_177_f64.powi(4)).powf(-0.25);
        let excess = 0.2 / SAND.critical_shields();
        let exact = [
            (0.715_542, 1e-6),
            (0.355_088, 1e-6),
            (5.0 * p * (0.247_f64.sqrt() - 0.7 * 0.047_f64.sqrt()), 1e-6),
            (
                0.053 * excess.powf(2.1) / SAND.dimensionless_diameter().powf(0.3),
                1e-12,
            ),
        ];
        for (rate, (exact, error)) in rates(0.247, critical).iter().zip(exact) {
            assert!((rate - exact).abs() < error, "{rate} for {exact}");
        }
        // All grains of the surface move in a strong flow.
        let [_, _, strong, _] = rates(100.0, critical);
        assert!((strong / (5.0 * (10.0 - 0.7 * critical.sqrt())) - 1.0).abs() < 1e-6);
    }
}
