//! A square patch of fluid that starts turning.

use std::f64::consts::PI;

use sph_core::{Vect, plugin};

use crate::flow::point::point;
use crate::{Solution, SolutionEntry};

/// u = ω y, v = −ω x about the centre, and the pressure that solves ∇²p = 2 ρ ω² with p = 0 on the
/// sides: the start of a square of fluid with a free surface, turning clockwise.
///
/// p = −ρ Σ_m Σ_n 32 ω²/(m n π²) / [(mπ/L)² + (nπ/L)²] sin(mπx/L) sin(nπy/L) over odd m and n,
/// x and y from the lower corner. It is evaluated summed over n,
/// p = −ρω² x (L−x) + (8 ρω² L²/π³) Σ_m sin(mπx/L)/m³ · cosh(mπ(y−L/2)/L)/cosh(mπ/2),
/// which is the same and falls exponentially with m. It is a tension everywhere, largest in the
/// middle: −0.1473 ρω²L².
///
/// Source: Colagrossi 2005; Le Touzé et al. 2013, §4.
///
/// ```toml
/// [body.patch.initial.rotating-square]
/// angular_velocity = 1.0
/// side = 1.0
/// density = 1000.0
/// ```
#[plugin(SolutionEntry [2], "rotating-square", "the start of a turning square patch of fluid",
    source: "Colagrossi 2005; Le Touzé et al. 2013")]
pub struct RotatingSquare {
    /// Angular velocity ω, clockwise.
    #[parameter(unit: "rad/s")]
    pub angular_velocity: f64,
    /// Side L of the square.
    #[parameter(unit: "m", above: 0.0)]
    pub side: f64,
    /// Centre of the square; the origin if left out.
    #[parameter(default, unit: "m")]
    pub centre: Vec<f64>,
    /// Density ρ.
    #[parameter(unit: "kg/m³", above: 0.0)]
    pub density: f64,
}

/// Odd terms of the series; the first one left out is below e^(−400·distance from a side/L).
const TERMS: u32 = 64;

impl Solution<2> for RotatingSquare {
    fn velocity(&self, position: &Vect<2>, _time: f64) -> Option<Vect<2>> {
        let arm = position - point::<2>(&self.centre);
        Some(Vect::from([arm[1], -arm[0]]) * self.angular_velocity)
    }

    fn pressure(&self, position: &Vect<2>, _time: f64) -> Option<f64> {
        let arm = (position - point::<2>(&self.centre)) / self.side;
        // The pressure beyond the free surface is none.
        if arm.iter().any(|c| c.abs() >= 0.5) {
            return Some(0.0);
        }
        let (x, y) = (arm[0] + 0.5, arm[1]);
        let term = |k: u32| {
            let m = f64::from(2 * k + 1) * PI;
            // cosh(m y)/cosh(m/2) without overflow.
            let away = (m * (y.abs() - 0.5)).exp();
            let ratio = away * (1.0 + (-2.0 * m * y.abs()).exp()) / (1.0 + (-m).exp());
            (m * x).sin() / m.powi(3) * ratio
        };
        let series: f64 = (0..TERMS).map(term).sum();
        let scale = self.density * (self.angular_velocity * self.side).powi(2);
        Some(scale * (8.0 * series - x * (1.0 - x)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn patch() -> RotatingSquare {
        RotatingSquare {
            angular_velocity: 2.0,
            side: 0.5,
            centre: vec![1.0, -1.0],
            density: 10.0,
        }
    }

    fn pressure(x: f64, y: f64) -> f64 {
        let at = Vect::from([1.0 + x, -1.0 + y]);
        patch().pressure(&at, 0.0).unwrap_or(f64::NAN)
    }

    #[test]
    fn it_is_the_double_series() {
        let double = |x: f64, y: f64| {
            let (x, y) = ((x / 0.5 + 0.5) * PI, (y / 0.5 + 0.5) * PI);
            let mut sum = 0.0;
            for m in (1..400).step_by(2).map(f64::from) {
                for n in (1..400).step_by(2).map(f64::from) {
                    sum += (m * x).sin() * (n * y).sin() / (m * n * (m * m + n * n));
                }
            }
            -10.0 * 4.0 * 0.25 * 32.0 / PI.powi(4) * sum
        };
        for (x, y) in [(0.0, 0.0), (0.1, -0.2), (0.2, 0.05)] {
            let (p, q) = (pressure(x, y), double(x, y));
            assert!((p - q).abs() < 1e-5 * 10.0, "{x} {y}: {p} {q}");
        }
        // The largest tension of ∇²p = 2ρω² in a square is 0.147343 ρω²L².
        assert!((pressure(0.0, 0.0) + 1.473_43).abs() < 1e-5);
    }

    #[test]
    fn the_laplacian_balances_the_rotation_and_the_sides_are_free() {
        let h = 1e-3;
        let (x, y) = (0.07, -0.12);
        let around = pressure(x + h, y) + pressure(x - h, y) + pressure(x, y + h);
        let laplacian = (around + pressure(x, y - h) - 4.0 * pressure(x, y)) / (h * h);
        assert!((laplacian - 80.0).abs() < 1e-2, "{laplacian}");
        for at in [(0.249_999, 0.1), (0.1, 0.249_999), (-0.25, 0.0), (0.3, 0.3)] {
            assert!(pressure(at.0, at.1).abs() < 1e-3, "{at:?}");
        }
    }
}
