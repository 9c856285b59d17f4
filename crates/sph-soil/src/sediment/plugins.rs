//! The laws of bed load as plugins.

use sph_core::plugin;

use super::grains::Grains;
use super::laws;
use super::moving_bed::{BedLoadEntry, BedLoadLaw, MovingBed};

/// q* = 8 (θ − θ_c)^(3/2), of gravel in flumes; 1.5 to 2 times what later analyses of the same data give.
///
/// ```toml
/// [bed-load.meyer-peter-muller]
/// grain_diameter = "1 mm"
/// ```
#[plugin(BedLoadEntry, "meyer-peter-muller", "bed load of Meyer-Peter and Müller, 8 (θ − θ_c)^1.5",
    source: "Meyer-Peter and Müller 1948", cfg(not(test)))]
pub struct MeyerPeterMuller(pub MovingBed);

/// q* = 3.97 (θ − θ_c)^(3/2), the data of Meyer-Peter and Müller without their correction for bed forms.
///
/// ```toml
/// [bed-load.wong-parker]
/// grain_diameter = "1 mm"
/// ```
#[plugin(BedLoadEntry, "wong-parker", "bed load of Wong and Parker, 3.97 (θ − θ_c)^1.5",
    source: "Wong and Parker 2006, Eq. 24", cfg(not(test)))]
pub struct WongParker(pub MovingBed);

/// q* = 5 p (√θ − 0.7 √θ_c), with the share p of the surface grains that move.
///
/// ```toml
/// [bed-load.engelund-fredsoe]
/// grain_diameter = "0.36 mm"
/// ```
#[plugin(BedLoadEntry, "engelund-fredsoe", "bed load of Engelund and Fredsøe, by the share of grains that move",
    source: "Engelund and Fredsøe 1976", cfg(not(test)))]
pub struct EngelundFredsoe(pub MovingBed);

/// q* = 0.053 T^2.1/D*^0.3, T = (θ − θ_c)/θ_c,flat, of sand from 0.2 to 2 mm.
///
/// ```toml
/// [bed-load.van-rijn]
/// grain_diameter = "0.5 mm"
/// ```
#[plugin(BedLoadEntry, "van-rijn", "bed load of van Rijn, 0.053 T^2.1/D*^0.3",
    source: "van Rijn 1984, Part I, Eq. 22", cfg(not(test)))]
pub struct VanRijn(pub MovingBed);

/// A law's plugin, with its rate.
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

bed_load!(MeyerPeterMuller, |theta, critical, _: &Grains| {
    laws::meyer_peter_muller(theta, critical)
});
bed_load!(WongParker, |theta, critical, _: &Grains| {
    laws::wong_parker(theta, critical)
});
bed_load!(EngelundFredsoe, |theta, critical, _: &Grains| {
    laws::engelund_fredsoe(theta, critical)
});
bed_load!(VanRijn, laws::van_rijn);
