//! Bodies of fluid at rest, in rotation, and drawn out.

use std::f64::consts::PI;

use sph_core::{Vect, plugin};

use crate::flow::point::point;
use crate::{Solution, SolutionEntry};

/// p = ρ g (z_s − z) below the surface z_s, and no motion.
///
/// Source: Ghaïtanellis 2017, Eq. 1.32.
#[plugin(SolutionEntry [2, 3], "hydrostatic", "a fluid at rest under gravity", source: "Ghaïtanellis 2017, Eq. 1.32")]
pub struct Hydrostatic {
    /// Density ρ.
    #[parameter(unit: "kg/m³", above: 0.0)]
    pub density: f64,
    /// Magnitude g of gravity, which points down the last axis.
    #[parameter(unit: "m/s²")]
    pub gravity: f64,
    /// Ordinate z_s of the free surface.
    #[parameter(unit: "m")]
    pub surface: f64,
}

impl<const D: usize> Solution<D> for Hydrostatic {
    fn velocity(&self, _position: &Vect<D>, _time: f64) -> Option<Vect<D>> {
        Some(Vect::zeros())
    }
    fn pressure(&self, position: &Vect<D>, _time: f64) -> Option<f64> {
        Some(self.density * self.gravity * (self.surface - position[D - 1]))
    }
}

/// u = ω × (r − c), p = p_c + ½ ρ ω² s² with s the distance from the axis; without gravity.
///
/// The axis is the normal of the plane in two dimensions and z in three.
///
/// Source: Batchelor 1967, §4.1.
///
/// ```toml
/// [body.water.initial.rigid-rotation]
/// angular_velocity = 6.2832
/// centre = [0.5, 0.5]
/// ```
#[plugin(SolutionEntry [2, 3], "rigid-rotation", "a fluid that turns like a solid", source: "Batchelor 1967, §4.1")]
pub struct RigidRotation {
    /// Angular velocity ω, counter-clockwise.
    #[parameter(unit: "rad/s")]
    pub angular_velocity: f64,
    /// A point c on the axis; the origin if left out.
    #[parameter(default, unit: "m")]
    pub centre: Vec<f64>,
    /// Density ρ, for the pressure.
    #[parameter(default, unit: "kg/m³")]
    pub density: f64,
    /// Pressure p_c on the axis.
    #[parameter(default, unit: "Pa")]
    pub central_pressure: f64,
}

impl<const D: usize> Solution<D> for RigidRotation {
    fn velocity(&self, position: &Vect<D>, _time: f64) -> Option<Vect<D>> {
        let arm = position - point::<D>(&self.centre);
        let mut velocity = Vect::zeros();
        velocity[0] = -self.angular_velocity * arm[1];
        velocity[1] = self.angular_velocity * arm[0];
        Some(velocity)
    }

    fn pressure(&self, position: &Vect<D>, _time: f64) -> Option<f64> {
        let arm = position - point::<D>(&self.centre);
        let speed2 = self.angular_velocity.powi(2) * (arm[0] * arm[0] + arm[1] * arm[1]);
        Some(self.central_pressure + 0.5 * self.density * speed2)
    }

    fn energy_rate(&self) -> Option<f64> {
        Some(0.0)
    }
}

/// u = ω y, v = −ω x about the centre, and the pressure that solves ∇²p = 2 ρ ω² with p = 0 on the
/// sides: the start of a square of fluid with a free surface, turning clockwise.
///
/// p = −ρ Σ_m Σ_n 32 ω²/(m n π²) / [(mπ/L)² + (nπ/L)²] sin(mπx/L) sin(nπy/L) over odd m and n, x and y from the lower
/// corner. It is evaluated summed over n, p = −ρω² x (L−x) + (8 ρω² L²/π³) Σ_m sin(mπx/L)/m³ ·
/// cosh(mπ(y−L/2)/L)/cosh(mπ/2), which is the same and falls exponentially with m. It is a tension everywhere, largest
/// in the middle: −0.1473 ρω²L².
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

/// A disc of fluid without friction, gravity and surroundings that starts with u = (−A₀x, A₀y): it stays an ellipse with the
/// semi-axes a along x and b = R²/a, u = (−Ax, Ay), p = ½ρ (A² − A′) a² (1 − x²/a² − y²/b²).
///
/// The pressure vanishes on the ellipse if A′ = A² (a² − b²)/(a² + b²); with a′ = −aA the kinetic energy
/// ¼ m A² ½(a² + b²) is constant, so that A = A₀ R √(2/(a² + b²)), and one equation is left, a′ = −aA(a).
///
/// Source: Monaghan 1994, J. Comput. Phys. 110, 399–406, §5.1; the closed form of A is ours.
///
/// ```toml
/// [body.drop.initial.elliptical-drop]
/// rate = 100.0
/// radius = 1.0
/// density = 1000.0
/// ```
#[plugin(SolutionEntry [2], "elliptical-drop", "a drop that is drawn out to an ellipse", source: "Monaghan 1994, §5.1")]
pub struct EllipticalDrop {
    /// Rate A₀ at which it is drawn out at the start.
    #[parameter(unit: "1/s", above: 0.0)]
    pub rate: f64,
    /// Radius R of the disc.
    #[parameter(unit: "m", above: 0.0)]
    pub radius: f64,
    /// Density ρ.
    #[parameter(unit: "kg/m³", above: 0.0)]
    pub density: f64,
}

impl EllipticalDrop {
    /// A with the semi-axis a over R.
    fn stretching(&self, a: f64) -> f64 {
        self.rate * (2.0 / (a * a + 1.0 / (a * a))).sqrt()
    }

    /// The semi-axis a over R at a time: classical Runge–Kutta of ln a in steps of A₀Δt ≤ 0.02, to 1e-9.
    pub fn semi_axis(&self, time: f64) -> f64 {
        let steps = (self.rate * time / 0.02).ceil().max(1.0);
        let dt = time / steps;
        let slope = |l: f64| -self.stretching(l.exp());
        let mut l = 0.0_f64;
        for _ in 0..steps as usize {
            let k1 = slope(l);
            let k2 = slope(l + 0.5 * dt * k1);
            let k3 = slope(l + 0.5 * dt * k2);
            let k4 = slope(l + dt * k3);
            l += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        }
        l.exp()
    }
}

impl<const D: usize> Solution<D> for EllipticalDrop {
    fn velocity(&self, position: &Vect<D>, time: f64) -> Option<Vect<D>> {
        let rate = self.stretching(self.semi_axis(time));
        let mut velocity = Vect::zeros();
        velocity[0] = -rate * position[0];
        velocity[1] = rate * position[1];
        Some(velocity)
    }

    fn pressure(&self, position: &Vect<D>, time: f64) -> Option<f64> {
        let a = self.semi_axis(time);
        let (a2, b2) = (a * a, 1.0 / (a * a));
        // (A² − A′)/2 · a² R² = A² b²/(a² + b²) · a² R², and ab = R².
        let middle = self.stretching(a).powi(2) * self.radius.powi(2) / (a2 + b2);
        let scaled = |k: usize| (position[k] / self.radius).powi(2);
        let inside = 1.0 - scaled(0) / a2 - scaled(1) / b2;
        Some(self.density * middle * inside.max(0.0))
    }

    fn energy_rate(&self) -> Option<f64> {
        Some(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a square patch, from its centre.
    fn pressure(x: f64, y: f64) -> f64 {
        let patch = RotatingSquare {
            angular_velocity: 2.0,
            side: 0.5,
            centre: vec![1.0, -1.0],
            density: 10.0,
        };
        let at = Vect::from([1.0 + x, -1.0 + y]);
        patch.pressure(&at, 0.0).unwrap_or(f64::NAN)
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

    const DROP: EllipticalDrop = EllipticalDrop {
        rate: 100.0,
        radius: 1.0,
        density: 1000.0,
    };

    /// Monaghan's equation A′ = A² (a⁴ − 1)/(a⁴ + 1), integrated by others.
    #[test]
    fn the_semi_axes_are_those_of_the_table() {
        for (t, a, rate) in [
            (0.001, 0.905136, 99.017948),
            (0.0076, 0.514266, 70.310892),
            (0.01, 0.439461, 61.021577),
        ] {
            let found = DROP.semi_axis(t);
            assert!((found - a).abs() < 1e-6, "{found} for {a}");
            assert!((DROP.stretching(found) - rate).abs() < 1e-4);
        }
    }

    /// Euler's equation, ρ (∂u/∂t + u·∇u) = −∇p, by differences.
    #[test]
    fn it_solves_the_equation_of_euler() {
        let (t, step) = (0.004, 1e-6);
        for x in [Vect::from([0.3, 0.5]), Vect::from([-0.2, 1.1])] {
            let u = |x: &Vect<2>, t: f64| Solution::<2>::velocity(&DROP, x, t).expect("velocity");
            let p = |x: &Vect<2>| Solution::<2>::pressure(&DROP, x, t).expect("pressure");
            let change = (u(&x, t + step) - u(&x, t - step)) / (2.0 * step);
            let carried = u(&(x + u(&x, t) * step), t) - u(&(x - u(&x, t) * step), t);
            let acceleration = change + carried / (2.0 * step);
            for k in 0..2 {
                let mut side = Vect::<2>::zeros();
                side[k] = 1e-5;
                let slope = (p(&(x + side)) - p(&(x - side))) / 2e-5;
                let left = slope + DROP.density * acceleration[k];
                assert!(left.abs() < 1e-4 * slope.abs(), "{left} of {slope}");
            }
        }
    }
}
