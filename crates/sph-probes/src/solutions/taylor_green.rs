//! The Taylor–Green vortex, in the plane and in space.

use std::f64::consts::TAU;

use sph_core::{Vect, plugin};

use crate::{Solution, SolutionEntry};

/// u = −U cos(kx) sin(ky) e^(bt), v = U sin(kx) cos(ky) e^(bt),
/// p = −ρU²/4 (cos 2kx + cos 2ky) e^(2bt) with k = 2π/L, b = −2νk².
///
/// Source: Taylor & Green 1937; the kinetic energy decays with 2b.
#[plugin(SolutionEntry [2], "taylor-green", "decaying periodic vortices", source: "Taylor & Green 1937")]
pub struct TaylorGreen {
    /// Largest velocity U at the start.
    #[parameter(unit: "m/s")]
    pub speed: f64,
    /// Period L of the vortices.
    #[parameter(unit: "m", above: 0.0)]
    pub length: f64,
    /// Kinematic viscosity ν.
    #[parameter(unit: "m²/s", min: 0.0)]
    pub kinematic_viscosity: f64,
    /// Density ρ.
    #[parameter(unit: "kg/m³", above: 0.0)]
    pub density: f64,
}

impl TaylorGreen {
    fn rate(&self) -> f64 {
        -2.0 * self.kinematic_viscosity * (TAU / self.length).powi(2)
    }
}

impl Solution<2> for TaylorGreen {
    fn velocity(&self, x: &Vect<2>, time: f64) -> Option<Vect<2>> {
        let k = TAU / self.length;
        let u = self.speed * (self.rate() * time).exp();
        Some(Vect::from([
            -u * (k * x[0]).cos() * (k * x[1]).sin(),
            u * (k * x[0]).sin() * (k * x[1]).cos(),
        ]))
    }

    fn pressure(&self, x: &Vect<2>, time: f64) -> Option<f64> {
        let k = TAU / self.length;
        let decay = (2.0 * self.rate() * time).exp();
        let scale = -0.25 * self.density * self.speed * self.speed * decay;
        Some(scale * ((2.0 * k * x[0]).cos() + (2.0 * k * x[1]).cos()))
    }

    fn energy_rate(&self) -> Option<f64> {
        Some(2.0 * self.rate())
    }
}

/// u = U sin(kx) cos(ky) cos(kz), v = −U cos(kx) sin(ky) cos(kz), w = 0,
/// p = ρU²/16 (cos 2kx + cos 2ky)(cos 2kz + 2) with k = 2π/L, at t = 0: vortices that stretch each other and decay in
/// turbulence. There is no closed form of later times.
///
/// Sources: Taylor & Green 1937; Brachet et al. 1983, Eq. 1.1.
#[plugin(SolutionEntry [3], "taylor-green-3d", "vortices in space that decay in turbulence: a start",
    source: "Taylor & Green 1937; Brachet et al. 1983")]
pub struct TaylorGreen3d {
    /// Largest velocity U.
    #[parameter(unit: "m/s")]
    pub speed: f64,
    /// Period L of the vortices.
    #[parameter(unit: "m", above: 0.0)]
    pub length: f64,
    /// Density ρ.
    #[parameter(unit: "kg/m³", above: 0.0)]
    pub density: f64,
}

impl Solution<3> for TaylorGreen3d {
    fn velocity(&self, x: &Vect<3>, time: f64) -> Option<Vect<3>> {
        let [x, y, z] = [0, 1, 2].map(|axis| TAU / self.length * x[axis]);
        let velocity = Vect::from([
            self.speed * x.sin() * y.cos() * z.cos(),
            -self.speed * x.cos() * y.sin() * z.cos(),
            0.0,
        ]);
        (time == 0.0).then_some(velocity)
    }

    fn pressure(&self, x: &Vect<3>, time: f64) -> Option<f64> {
        let [x, y, z] = [0, 1, 2].map(|axis| 2.0 * TAU / self.length * x[axis]);
        let scale = self.density * self.speed * self.speed / 16.0;
        (time == 0.0).then(|| scale * (x.cos() + y.cos()) * (z.cos() + 2.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ½ ⟨u²⟩ = U²/8, and the mean of Δp = −ρ ∂u_i/∂x_j ∂u_j/∂x_i: at one place by differences.
    #[test]
    fn its_pressure_holds_the_vortices() {
        let flow = TaylorGreen3d {
            speed: 2.0,
            length: TAU,
            density: 3.0,
        };
        let n = 16;
        let place = |i: usize| {
            let at = [i % n, i / n % n, i / (n * n)];
            Vect::from(at.map(|k| TAU * k as f64 / n as f64))
        };
        let all = (0..n * n * n).map(|i| flow.velocity(&place(i), 0.0).expect("a velocity"));
        let energy: f64 = all.map(|u| 0.5 * u.norm_squared()).sum::<f64>() / (n * n * n) as f64;
        assert!((energy - 0.5).abs() < 1e-12, "{energy}");
        let (x, h) = (Vect::from([0.3, 0.7, 1.1]), 1e-3);
        let shifted = |k: usize, s: f64| {
            let mut y = x;
            y[k] += s;
            y
        };
        let gradient = |k: usize| {
            let u = |s: f64| flow.velocity(&shifted(k, s), 0.0).expect("a velocity");
            (u(h) - u(-h)) / (2.0 * h)
        };
        let g = [0, 1, 2].map(gradient);
        let source: f64 = (0..9).map(|m| g[m / 3][m % 3] * g[m % 3][m / 3]).sum();
        let p = |k: usize, s: f64| flow.pressure(&shifted(k, s), 0.0).expect("a pressure");
        let second = |k: usize| (p(k, h) - 2.0 * p(k, 0.0) + p(k, -h)) / (h * h);
        let laplacian: f64 = (0..3).map(second).sum();
        assert!((laplacian / (-3.0 * source) - 1.0).abs() < 1e-4);
        assert!(flow.velocity(&x, 0.1).is_none());
    }
}
