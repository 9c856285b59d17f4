//! Laws whose viscosity depends on the strain rate alone, without a yield stress.

use crate::{Inputs, Needs, Rheology, plugin};

/// A law whose viscosity depends on nothing but the strain rate.
pub trait GeneralisedNewtonian: Send + Sync + std::fmt::Debug {
    /// η at a strain rate, Pa s.
    fn at(&self, strain_rate: f64) -> f64;
    /// η if it is the same at all strain rates, Pa s.
    fn uniform(&self) -> Option<f64>;
    /// The largest η, Pa s.
    fn largest(&self) -> f64;
}

impl<T: GeneralisedNewtonian> Rheology for T {
    fn needs(&self) -> Needs {
        Needs {
            strain_rate: self.uniform().is_none(),
            pressure: false,
        }
    }
    fn uniform_viscosity(&self) -> Option<f64> {
        self.uniform()
    }
    fn viscosity(&self, inputs: &Inputs<'_>, viscosity: &mut [f64]) {
        for (k, eta) in viscosity.iter_mut().enumerate() {
            *eta = self.at(inputs.at(k).0);
        }
    }
    fn largest_viscosity(&self) -> f64 {
        self.largest()
    }
}

/// η = K γ̇^(n−1), held between a smallest and a largest viscosity.
///
/// n < 1 thins with shear and has no largest viscosity of its own, n > 1 thickens and has none
/// either: the bound is part of the law.
///
/// Source: Ostwald 1925, de Waele 1923.
///
/// ```toml
/// [phase.paint.rheology.power-law]
/// consistency = 2.0
/// exponent = 0.6
/// largest_viscosity = "50 Pa s"
/// ```
#[plugin(crate::RheologyEntry, "power-law", "viscosity as a power of the strain rate, bounded", source: "Ostwald 1925")]
pub struct PowerLaw {
    /// Consistency K.
    #[parameter(unit: "Pa s^n", min: 0.0, source: "Ostwald 1925")]
    pub consistency: f64,
    /// Exponent n; 1 is a Newtonian fluid.
    #[parameter(unit: "1", above: 0.0, source: "Ostwald 1925")]
    pub exponent: f64,
    /// Bound of the viscosity from below.
    #[parameter(default, unit: "Pa s", min: 0.0, source: "ours")]
    pub smallest_viscosity: f64,
    /// Bound of the viscosity from above.
    #[parameter(unit: "Pa s", above: 0.0, source: "ours")]
    pub largest_viscosity: f64,
}

impl GeneralisedNewtonian for PowerLaw {
    fn at(&self, strain_rate: f64) -> f64 {
        let power = match self.exponent {
            1.0 => 1.0,
            n => strain_rate.powf(n - 1.0),
        };
        // 0 · ∞ is no number: a fluid without consistency has no viscosity at rest either.
        let eta = match self.consistency {
            0.0 => 0.0,
            k => k * power,
        };
        eta.max(self.smallest_viscosity).min(self.largest_viscosity)
    }
    fn uniform(&self) -> Option<f64> {
        let newtonian = self.exponent == 1.0 || self.consistency == 0.0;
        newtonian.then(|| self.at(1.0))
    }
    fn largest(&self) -> f64 {
        self.uniform().unwrap_or(self.largest_viscosity)
    }
}

/// η = η_∞ + (η_0 − η_∞)/(1 + (λγ̇)^m), between η_0 at rest and η_∞ at high strain rates.
///
/// Source: Cross 1965.
///
/// ```toml
/// [phase.polymer.rheology.cross]
/// rest_viscosity = "10 Pa s"
/// infinite_viscosity = "0.1 Pa s"
/// relaxation_time = "2 s"
/// exponent = 0.8
/// ```
#[plugin(crate::RheologyEntry, "cross", "from one viscosity at rest to another at high strain rates",
    source: "Cross 1965")]
pub struct Cross {
    /// Viscosity η_0 at rest.
    #[parameter(unit: "Pa s", min: 0.0, source: "Cross 1965")]
    pub rest_viscosity: f64,
    /// Viscosity η_∞ at high strain rates.
    #[parameter(default, unit: "Pa s", min: 0.0, source: "Cross 1965")]
    pub infinite_viscosity: f64,
    /// Time λ: half the way at γ̇ = 1/λ.
    #[parameter(unit: "s", min: 0.0, source: "Cross 1965")]
    pub relaxation_time: f64,
    /// Exponent m.
    #[parameter(unit: "1", above: 0.0, source: "Cross 1965")]
    pub exponent: f64,
}

impl GeneralisedNewtonian for Cross {
    fn at(&self, strain_rate: f64) -> f64 {
        let share = 1.0 / (1.0 + (self.relaxation_time * strain_rate).powf(self.exponent));
        self.rest_viscosity * share + self.infinite_viscosity * (1.0 - share)
    }
    fn uniform(&self) -> Option<f64> {
        (self.rest_viscosity == self.infinite_viscosity).then_some(self.rest_viscosity)
    }
    fn largest(&self) -> f64 {
        self.rest_viscosity.max(self.infinite_viscosity)
    }
}

/// η = η_∞ + (η_0 − η_∞) [1 + (λγ̇)^a]^((n−1)/a), between η_0 at rest and η_∞ at high strain rates.
///
/// Source: Carreau 1972 (a = 2), Yasuda et al. 1981 (any a).
///
/// ```toml
/// [phase.blood.rheology.carreau]
/// rest_viscosity = "56 mPa s"
/// infinite_viscosity = "3.45 mPa s"
/// relaxation_time = "3.313 s"
/// exponent = 0.3568
/// ```
#[plugin(crate::RheologyEntry, "carreau", "plateau at rest, then a power of the strain rate, then another plateau",
    source: "Carreau 1972")]
pub struct Carreau {
    /// Viscosity η_0 at rest.
    #[parameter(unit: "Pa s", min: 0.0, source: "Carreau 1972")]
    pub rest_viscosity: f64,
    /// Viscosity η_∞ at high strain rates.
    #[parameter(default, unit: "Pa s", min: 0.0, source: "Carreau 1972")]
    pub infinite_viscosity: f64,
    /// Time λ: thinning starts at γ̇ = 1/λ.
    #[parameter(unit: "s", min: 0.0, source: "Carreau 1972")]
    pub relaxation_time: f64,
    /// Exponent n of the power law in between.
    #[parameter(unit: "1", above: 0.0, max: 1.0, source: "Carreau 1972")]
    pub exponent: f64,
    /// Sharpness of the plateau's end, a.
    #[parameter(default: 2.0, unit: "1", above: 0.0, source: "Yasuda et al. 1981")]
    pub sharpness: f64,
}

impl GeneralisedNewtonian for Carreau {
    fn at(&self, strain_rate: f64) -> f64 {
        let a = self.sharpness;
        let base = 1.0 + (self.relaxation_time * strain_rate).powf(a);
        let share = base.powf((self.exponent - 1.0) / a);
        self.rest_viscosity * share + self.infinite_viscosity * (1.0 - share)
    }
    fn uniform(&self) -> Option<f64> {
        let newtonian = self.exponent == 1.0 || self.rest_viscosity == self.infinite_viscosity;
        newtonian.then_some(self.rest_viscosity)
    }
    fn largest(&self) -> f64 {
        self.rest_viscosity.max(self.infinite_viscosity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stress_is_a_power_between_the_bounds() {
        for n in [0.3, 0.6, 1.0, 1.7] {
            let law = PowerLaw {
                consistency: 2.0,
                exponent: n,
                smallest_viscosity: 1e-3,
                largest_viscosity: 50.0,
            };
            let stress = |rate: f64| law.at(rate) * rate;
            let slope = (stress(2.0) / stress(1.0)).log2();
            assert!((slope - n).abs() < 1e-14, "{n}: {slope}");
            let ends = [law.at(0.0), law.at(1e12)];
            assert!(ends.iter().all(|e| (1e-3..=50.0).contains(e)), "{ends:?}");
        }
    }

    #[test]
    fn ends_middle_and_slope_are_right() {
        let law = Cross {
            rest_viscosity: 10.0,
            infinite_viscosity: 0.1,
            relaxation_time: 2.0,
            exponent: 0.8,
        };
        assert_eq!(law.at(0.0), 10.0);
        assert!((law.at(0.5) - 5.05).abs() < 1e-14);
        let slope = ((law.at(2e9) - 0.1) / (law.at(1e9) - 0.1)).log2();
        assert!((slope + 0.8).abs() < 1e-6, "{slope}");
        assert!((law.at(1e300) - 0.1).abs() < 1e-14);
    }

    #[test]
    fn plateau_and_power_are_right() {
        let law = Carreau {
            rest_viscosity: 56e-3,
            infinite_viscosity: 0.0,
            relaxation_time: 3.313,
            exponent: 0.3568,
            sharpness: 2.0,
        };
        assert_eq!(law.at(0.0), 56e-3);
        let slope = (law.at(2e6) / law.at(1e6)).log2();
        assert!((slope - (0.3568 - 1.0)).abs() < 1e-12, "{slope}");
        let half = 56e-3 * 2.0_f64.powf((0.3568 - 1.0) / 2.0);
        assert!((law.at(1.0 / 3.313) / half - 1.0).abs() < 1e-14);
    }
}
