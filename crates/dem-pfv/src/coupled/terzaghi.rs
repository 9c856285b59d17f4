//! Consolidation in one dimension.

use std::f64::consts::PI;

/// Exact consolidation of an elastic layer under a sudden load, drained at one face: dp/dt = C_v d²p/dz².
///
/// T_v = C_v t / L², L the longest way to a drained face; a layer drained at both faces is two of half its height.
/// Source: Terzaghi 1923; Catalano 2012, Eqs. (4.29) to (4.31).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Terzaghi {
    /// C_v = K E_oed, m²/s.
    pub coefficient: f64,
    /// L, m.
    pub drainage: f64,
}

impl Terzaghi {
    /// Time factor T_v of a time, s.
    pub fn factor(&self, time: f64) -> f64 {
        self.coefficient * time / (self.drainage * self.drainage)
    }

    /// Time (s) of a time factor T_v.
    pub fn time(&self, factor: f64) -> f64 {
        factor * self.drainage * self.drainage / self.coefficient
    }

    /// p/Δσ at the distance `z` (m) from the drained face: Σ (2/M) sin(M z/L) exp(−M² T_v), M = π (2m + 1)/2.
    pub fn pressure(&self, z: f64, time: f64) -> f64 {
        let z = z / self.drainage;
        series(self.factor(time), |m| 2.0 / m * (m * z).sin()).clamp(0.0, 1.0)
    }

    /// Degree of consolidation U = 1 − Σ (2/M²) exp(−M² T_v), the settlement over the final one.
    pub fn consolidation(&self, time: f64) -> f64 {
        1.0 - series(self.factor(time), |m| 2.0 / (m * m))
    }
}

/// Σ f(M) exp(−M² T) until terms are below rounding, or 10⁵ of them.
fn series(factor: f64, term: impl Fn(f64) -> f64) -> f64 {
    if factor <= 0.0 {
        return 1.0;
    }
    let modes = (0..100_000).map(|m| 0.5 * PI * f64::from(2 * m + 1));
    let kept = modes.take_while(|m| m * m * factor < 40.0);
    kept.map(|m| term(m) * (-m * m * factor).exp()).sum()
}
