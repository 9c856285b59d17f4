//! Vortices in periodic boxes, and standing waves in elastic materials: a bending plate and shear.

use std::f64::consts::TAU;

use sph_core::{Vect, plugin};

use crate::{Solution, SolutionEntry, solutions::along};

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

/// u = U f(x)/f(L) cos(ωt) across the plate, with kL = 1.875 and ω² = EH²k⁴/(12ρ(1 − ν²)).
///
/// f(x) = (cos kL + cosh kL)(cosh kx − cos kx) + (sin kL − sinh kL)(sinh kx − sin kx)
///
/// Symbols: U speed of the tip (m/s); L length (m); H thickness (m); E Young's modulus (Pa); ν Poisson's
/// ratio; ρ density (kg/m³); x the first coordinate from `root` on, where the plate is clamped. The velocity is
/// that of the last coordinate; before `root` it is zero. For a thin plate, kH ≪ 1, and small deflections.
///
/// Source: Landau & Lifshitz 1970, §25; Gray et al. 2001, §5.2.
#[plugin(SolutionEntry [2, 3], "cantilever", "first bending mode of a plate clamped at one end",
    source: "Landau & Lifshitz 1970, §25")]
pub struct Cantilever {
    /// Speed of the tip U.
    #[parameter(unit: "m/s")]
    pub speed: f64,
    /// Start of the plate at its clamp.
    #[parameter(default, unit: "m")]
    pub root: f64,
    /// Length L beyond the clamp.
    #[parameter(unit: "m", above: 0.0)]
    pub length: f64,
    /// Thickness H.
    #[parameter(unit: "m", above: 0.0)]
    pub thickness: f64,
    /// Young's modulus E.
    #[parameter(unit: "Pa", above: 0.0, quantity: "modulus")]
    pub young_modulus: f64,
    /// Poisson's ratio ν.
    #[parameter(unit: "1", above: -1.0, max: 0.5)]
    pub poisson_ratio: f64,
    /// Density ρ.
    #[parameter(unit: "kg/m³", above: 0.0)]
    pub density: f64,
}

/// First positive root of 1 + cos s cosh s = 0.
const FIRST_ROOT: f64 = 1.875_104_068_711_961;

impl Cantilever {
    /// Angular frequency ω, 1/s.
    fn frequency(&self) -> f64 {
        let k = FIRST_ROOT / self.length;
        let plate = self.young_modulus / (12.0 * self.density * (1.0 - self.poisson_ratio.powi(2)));
        self.thickness * k * k * plate.sqrt()
    }

    /// f(x)/f(L) at s = kx.
    fn shape(s: f64) -> f64 {
        let (sin, cos) = FIRST_ROOT.sin_cos();
        let f = |s: f64| {
            (cos + FIRST_ROOT.cosh()) * (s.cosh() - s.cos())
                + (sin - FIRST_ROOT.sinh()) * (s.sinh() - s.sin())
        };
        f(s) / f(FIRST_ROOT)
    }
}

impl<const D: usize> Solution<D> for Cantilever {
    fn velocity(&self, position: &Vect<D>, time: f64) -> Option<Vect<D>> {
        let x = (position[0] - self.root).max(0.0);
        let shape = Self::shape(FIRST_ROOT * x / self.length);
        along(D - 1, self.speed * (self.frequency() * time).cos() * shape)
    }
}

/// u = U cos(ωt) sin(ky) along x with k = 2π/λ and ω = k√(𝒢/ρ).
///
/// Symbols: U largest velocity (m/s); λ wavelength (m); 𝒢 shear modulus (Pa); ρ density (kg/m³); y
/// the last coordinate. The displacement is U/ω sin(ωt) sin(ky); it must stay far below 1/k.
///
/// Source: Achenbach 1973, §1.5.
#[plugin(SolutionEntry [2, 3], "elastic-shear-wave", "standing shear wave in an elastic material",
    source: "Achenbach 1973, §1.5")]
pub struct ElasticShearWave {
    /// Largest velocity U.
    #[parameter(unit: "m/s")]
    pub speed: f64,
    /// Wavelength λ.
    #[parameter(unit: "m", above: 0.0)]
    pub wavelength: f64,
    /// Shear modulus 𝒢.
    #[parameter(unit: "Pa", above: 0.0, quantity: "modulus")]
    pub shear_modulus: f64,
    /// Density ρ.
    #[parameter(unit: "kg/m³", above: 0.0)]
    pub density: f64,
}

impl<const D: usize> Solution<D> for ElasticShearWave {
    fn velocity(&self, position: &Vect<D>, time: f64) -> Option<Vect<D>> {
        let k = TAU / self.wavelength;
        let frequency = k * (self.shear_modulus / self.density).sqrt();
        let shape = (k * position[D - 1]).sin();
        along(0, self.speed * (frequency * time).cos() * shape)
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

    #[test]
    fn the_mode_is_clamped_at_its_root_and_free_at_its_tip() {
        assert!((1.0 + FIRST_ROOT.cos() * FIRST_ROOT.cosh()).abs() < 1e-12);
        let f = Cantilever::shape;
        let d = 1e-3;
        let slope = |s: f64| (f(s + d) - f(s - d)) / (2.0 * d);
        let moment = |s: f64| (f(s + d) - 2.0 * f(s) + f(s - d)) / (d * d);
        let shear = (moment(FIRST_ROOT + d) - moment(FIRST_ROOT - d)) / (2.0 * d);
        assert!(f(0.0).abs() < 1e-12 && slope(0.0).abs() < 1e-6);
        assert!((f(FIRST_ROOT) - 1.0).abs() < 1e-12);
        // Blevins 1979, Table 8-1: the tip turns by 1.3765 times its deflection over the length.
        assert!((slope(FIRST_ROOT) * FIRST_ROOT - 1.3765).abs() < 1e-4);
        assert!(moment(FIRST_ROOT).abs() < 1e-6 && shear.abs() < 1e-4);
    }

    #[test]
    fn the_plate_swings_as_its_stiffness_says() {
        let plate = Cantilever {
            speed: 0.57,
            root: 0.1,
            length: 0.2,
            thickness: 0.02,
            young_modulus: 2e6,
            poisson_ratio: 0.3975,
            density: 1000.0,
        };
        assert!((plate.frequency() - 24.73).abs() < 0.01);
        let at = |x: f64, t: f64| plate.velocity(&Vect::from([x, 0.0]), t).unwrap().y;
        assert_eq!(at(0.05, 0.0), 0.0);
        assert!((at(0.3, 0.0) - 0.57).abs() < 1e-12);
        // ρ ∂²u/∂t² = −EH²/(12(1 − ν²)) ∂⁴u/∂x⁴ amid the plate.
        let (x, t, d) = (0.23, 0.01, 4e-3);
        let weights = [1.0, -4.0, 6.0, -4.0, 1.0];
        let terms = weights.iter().enumerate();
        let fourth = terms.map(|(k, w)| w * at(x + (k as f64 - 2.0) * d, t));
        let fourth = fourth.sum::<f64>() / d.powi(4);
        let second = (at(x, t + 1e-4) - 2.0 * at(x, t) + at(x, t - 1e-4)) / 1e-8;
        let stiffness = 2e6 * 4e-4 / (12.0 * (1.0 - 0.3975_f64.powi(2)));
        let (inertia, force) = (1000.0 * second, stiffness * fourth);
        assert!((inertia / force + 1.0).abs() < 1e-2, "{inertia} {force}");
    }

    #[test]
    fn acceleration_is_that_of_the_stress() {
        let wave = ElasticShearWave {
            speed: 0.3,
            wavelength: 2.0,
            shear_modulus: 5.0,
            density: 1.25,
        };
        let at = |t: f64| wave.velocity(&Vect::from([0.1, 0.3]), t).unwrap().x;
        // ρ d²u/dt² = 𝒢 d²u/dy² = −𝒢k²u.
        let (t, dt) = (0.37, 1e-4);
        let second = (at(t + dt) - 2.0 * at(t) + at(t - dt)) / (dt * dt);
        let k = TAU / 2.0;
        assert!((1.25 * second + 5.0 * k * k * at(t)).abs() < 1e-5);
    }
}
