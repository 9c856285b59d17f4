//! One-dimensional consolidation of a soil.

use std::f64::consts::{FRAC_PI_2, PI};

use sph_core::{Vect, plugin};

use crate::{Solution, SolutionEntry};

/// p_e = Σ_m 2q/M sin(Mz/H) exp(−M² c_v t/H²), M = (2m + 1) π/2: a layer on an impervious bottom, drained at its top and loaded
/// at t = 0.
///
/// Symbols: z depth below the top, c_v = k E/η.
///
/// Source: Terzaghi 1943.
#[plugin(SolutionEntry [2, 3], "terzaghi", "excess pore pressure of a layer that consolidates under a load",
    source: "Terzaghi 1943")]
pub struct Terzaghi {
    /// Load q at the top.
    #[parameter(unit: "Pa", above: 0.0)]
    pub load: f64,
    /// Coefficient c_v of consolidation.
    #[parameter(unit: "m²/s", above: 0.0)]
    pub consolidation: f64,
    /// Depth H of the layer.
    #[parameter(unit: "m", above: 0.0)]
    pub depth: f64,
    /// Ordinate of the bottom.
    #[parameter(default, unit: "m")]
    pub bottom: f64,
}

impl Terzaghi {
    /// p_e, Pa, at a height over the bottom, m, and a time, s.
    fn excess(&self, height: f64, time: f64) -> f64 {
        let z = (1.0 - height / self.depth).clamp(0.0, 1.0);
        let progress = self.consolidation * time / (self.depth * self.depth);
        let mut excess = 0.0;
        for m in 0..20_000 {
            let place = FRAC_PI_2 + PI * f64::from(m);
            let decay = (-place * place * progress).exp();
            if decay < 1e-18 {
                break;
            }
            excess += 2.0 / place * (place * z).sin() * decay;
        }
        self.load * excess
    }
}

impl<const D: usize> Solution<D> for Terzaghi {
    fn scalar(&self, field: &str, position: &Vect<D>, time: f64) -> Option<f64> {
        let height = position[D - 1] - self.bottom;
        (field == "excess_pore_pressure").then(|| self.excess(height, time))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_of_profiles_is_met() {
        let layer = Terzaghi {
            load: 100.0,
            consolidation: 0.5,
            depth: 2.0,
            bottom: 0.0,
        };
        // z/H, T_v, p/q of the closed formula.
        let table = [
            (0.05, 0.02, 0.197_413),
            (0.5, 0.1, 0.735_651),
            (0.25, 0.2, 0.302_084),
            (1.0, 0.5, 0.370_777),
            (0.7, 1.0, 0.096_208),
        ];
        for (z, number, share) in table {
            let found = layer.excess(2.0 * (1.0 - z), number * 4.0 / 0.5);
            assert!(
                (found / 100.0 - share).abs() < 1e-6,
                "{z} {number}: {found}"
            );
        }
    }
}
