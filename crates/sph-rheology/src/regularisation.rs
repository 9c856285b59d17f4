//! Regularisations of a yield stress at rest.

use crate::parameters;
/// The plastic part τ_y/γ̇ of the viscosity, made finite at γ̇ = 0.
///
/// With μ the viscous part of the viscosity (Pa s), which is added to what this gives:
///
/// | choice | plastic part | at rest |
/// |---|---|---|
/// | `papanastasiou` | τ_y (1 − e^(−mγ̇))/γ̇ | τ_y m |
/// | `bi-viscosity` | min(τ_y/γ̇, η_max − μ) | η_max − μ |
/// | `bercovier-engelman` | τ_y/√(γ̇² + ε²) | τ_y/ε |
/// | `ratio` | τ_y/√(γ̇² + ε²) with ε = τ_y/((α − 1)μ) | (α − 1)μ |
///
/// Below yield the material creeps: γ̇ ≈ −ln(1 − τ/τ_y)/m with `papanastasiou`. `ratio` and
/// `bi-viscosity` jump from their largest value to nothing where τ_y reaches zero.
///
/// Sources: Papanastasiou 1987 and Tanner & Milthorpe 1983, in Ghaïtanellis 2017, Eq. 4.9–4.15 (its
/// bi-viscosity changes sides at γ̇ = τ_y/η_max, where it jumps by μ; here both sides meet, at
/// τ_y/(η_max − μ)); Bercovier & Engelman 1980; Krimi et al. 2018, Eq. 10–13.
///
/// ```toml
/// regularisation.papanastasiou = { stress_growth = "10 s" }
/// ```
#[parameters]
#[derive(PartialEq)]
#[cfg_attr(feature = "plugins", derive(serde::Serialize))]
pub enum Regularisation {
    /// The stress grows to the yield stress like 1 − e^(−mγ̇).
    Papanastasiou {
        /// Stress growth time m.
        #[parameter(unit: "s", above: 0.0, source: "Ghaïtanellis 2017, Eq. 4.13–4.15")]
        stress_growth: f64,
    },
    /// A very viscous fluid below yield.
    BiViscosity {
        /// Viscosity η_max below yield, the viscous part included.
        #[parameter(unit: "Pa s", above: 0.0, source: "Ghaïtanellis 2017, Eq. 4.9–4.12")]
        largest_viscosity: f64,
    },
    /// The strain rate never counts less than ε.
    BercovierEngelman {
        /// Strain rate ε.
        #[parameter(unit: "1/s", above: 0.0, source: "Bercovier & Engelman 1980")]
        strain_rate: f64,
    },
    /// The viscosity at rest is a multiple of the viscous part, whatever the yield stress.
    Ratio {
        /// Largest viscosity over the viscous part, α.
        #[parameter(unit: "1", min: 1.0, source: "Krimi et al. 2018, Eq. 10–13")]
        ratio: f64,
    },
}

impl Regularisation {
    /// The plastic part of the viscosity, Pa s, with the viscous part `viscous`: finite, and zero
    /// where the yield stress is not positive.
    pub fn plastic(&self, yield_stress: f64, strain_rate: f64, viscous: f64) -> f64 {
        if yield_stress <= 0.0 {
            return 0.0;
        }
        match *self {
            Self::Papanastasiou { stress_growth: m } => {
                yield_stress * m * saturation(m * strain_rate)
            }
            Self::BiViscosity { largest_viscosity } => {
                (yield_stress / strain_rate).min((largest_viscosity - viscous).max(0.0))
            }
            Self::BercovierEngelman { strain_rate: e } => yield_stress / strain_rate.hypot(e),
            Self::Ratio { ratio } => {
                let most = viscous * (ratio - 1.0);
                most * (yield_stress / yield_stress.hypot(most * strain_rate))
            }
        }
    }

    /// The largest plastic part for yield stresses up to `yield_stress`, Pa s; infinite only for
    /// an infinite yield stress.
    pub fn largest_plastic(&self, yield_stress: f64, viscous: f64) -> f64 {
        match *self {
            _ if yield_stress <= 0.0 => 0.0,
            Self::Papanastasiou { stress_growth: m } => yield_stress * m,
            Self::BiViscosity { largest_viscosity } => (largest_viscosity - viscous).max(0.0),
            Self::BercovierEngelman { strain_rate: e } => yield_stress / e,
            Self::Ratio { ratio } => viscous * (ratio - 1.0),
        }
    }
}

/// (1 − e^(−x))/x for x ≥ 0, 1 at x = 0.
pub(crate) fn saturation(x: f64) -> f64 {
    match x {
        x if x < 1e-8 => 1.0 - 0.5 * x,
        x => -(-x).exp_m1() / x,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn saturation_is_smooth_through_zero() {
        assert_eq!(saturation(0.0), 1.0);
        assert_eq!(saturation(f64::INFINITY), 0.0);
        for x in [1e-12, 1e-9, 9.99e-9, 1.001e-8, 1e-6, 1e-3] {
            let series = 1.0 - x / 2.0 + x * x / 6.0 - x * x * x / 24.0;
            assert!((saturation(x) - series).abs() < 1e-13, "{x}");
        }
    }

    #[test]
    fn all_become_the_ideal_stress_at_high_rates_and_their_largest_at_rest() {
        let all = [
            Regularisation::Papanastasiou { stress_growth: 3.0 },
            Regularisation::BiViscosity {
                largest_viscosity: 80.0,
            },
            Regularisation::BercovierEngelman { strain_rate: 0.1 },
            Regularisation::Ratio { ratio: 40.0 },
        ];
        for choice in all {
            let (stress, viscous) = (25.0, 2.0);
            let rest = choice.plastic(stress, 0.0, viscous);
            let largest = choice.largest_plastic(stress, viscous);
            assert!((rest / largest - 1.0).abs() < 1e-15, "{choice:?}");
            let ideal = choice.plastic(stress, 1e6, viscous) * 1e6;
            assert!((ideal / stress - 1.0).abs() < 1e-9, "{choice:?}: {ideal}");
            // Shear stress grows with the rate.
            let stress_at = |k: i32| {
                let rate = 1e-3 * 1.1_f64.powi(k);
                (viscous + choice.plastic(stress, rate, viscous)) * rate
            };
            assert!(
                (0..150).all(|k| stress_at(k + 1) > stress_at(k)),
                "{choice:?}"
            );
            assert_eq!(choice.plastic(0.0, 0.0, viscous), 0.0);
        }
    }
}
