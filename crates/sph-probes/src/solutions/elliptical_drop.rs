//! A drop that is drawn out to an ellipse.

use sph_core::{Vect, plugin};

use crate::{Solution, SolutionEntry};

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
