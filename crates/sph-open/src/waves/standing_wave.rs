//! A wave that swings between two walls.

use sph_core::{Vect, plugin};
use sph_probes::{Solution, SolutionEntry};

use crate::waves::orbits::depths;

/// Water without friction whose surface is z = d + a sin(ωt) cos(kx), k = 2π/L, ω² = gk tanh(kd); z is the last axis and 0 at
/// the floor:
/// u_x = −aω cos(ωt) sin(kx) cosh(kz)/sinh(kd), u_z = aω cos(ωt) cos(kx) sinh(kz)/sinh(kd),
/// p = ρg (d − z) + ρga sin(ωt) cos(kx) cosh(kz)/cosh(kd).
///
/// At the start the surface is flat and the water moves: no staircase of rows stands for a slope. A wave of finite height
/// differs from it by ka/2 of itself and less.
///
/// Source: Airy's linear theory; Dean & Dalrymple (1991), Water Wave Mechanics, §4.4.
///
/// ```toml
/// [body.water.initial.standing-wave]
/// amplitude = 0.05
/// wavelength = 2.0
/// depth = 1.0
/// gravity = 1.0
/// density = 1000.0
/// ```
#[plugin(SolutionEntry [2, 3], "standing-wave", "a wave that swings between two walls", source: "Airy's linear theory", cfg(not(test)))]
pub struct StandingWave {
    /// Amplitude a of the surface at x = 0.
    #[parameter(unit: "m", above: 0.0)]
    pub amplitude: f64,
    /// Length L.
    #[parameter(unit: "m", above: 0.0)]
    pub wavelength: f64,
    /// Depth d.
    #[parameter(unit: "m", above: 0.0)]
    pub depth: f64,
    /// Size g of gravity.
    #[parameter(unit: "m/s²", above: 0.0)]
    pub gravity: f64,
    /// Density ρ.
    #[parameter(unit: "kg/m³", above: 0.0)]
    pub density: f64,
}

impl StandingWave {
    /// k = 2π/L, 1/m.
    pub fn wavenumber(&self) -> f64 {
        std::f64::consts::TAU / self.wavelength
    }

    /// ω = √(gk tanh kd), 1/s.
    pub fn frequency(&self) -> f64 {
        let k = self.wavenumber();
        (self.gravity * k * (k * self.depth).tanh()).sqrt()
    }
}

impl<const D: usize> Solution<D> for StandingWave {
    fn velocity(&self, position: &Vect<D>, time: f64) -> Option<Vect<D>> {
        let (k, frequency) = (self.wavenumber(), self.frequency());
        let along = k * position[0];
        let [beside, up] = depths(k, position[D - 1] - self.depth, self.depth);
        let scale = self.amplitude * frequency * (frequency * time).cos();
        let mut velocity = Vect::zeros();
        velocity[0] = -scale * along.sin() * beside;
        velocity[D - 1] = scale * along.cos() * up;
        Some(velocity)
    }

    fn pressure(&self, position: &Vect<D>, time: f64) -> Option<f64> {
        let (k, above) = (self.wavenumber(), position[D - 1] - self.depth);
        let [beside, _] = depths(k, above, self.depth);
        let swing = self.amplitude * (self.frequency() * time).sin() * (k * position[0]).cos();
        let head = swing * beside * (k * self.depth).tanh() - above;
        Some(self.density * self.gravity * head)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WAVE: StandingWave = StandingWave {
        amplitude: 0.05,
        wavelength: 2.0,
        depth: 1.0,
        gravity: 1.0,
        density: 1000.0,
    };
    const STEP: f64 = 1e-5;

    fn velocity(x: &Vect<2>, time: f64) -> Vect<2> {
        Solution::<2>::velocity(&WAVE, x, time).expect("a velocity")
    }

    /// ρ ∂u/∂t = −∇p + ρg and ∇·u = 0, by differences; nothing crosses the floor and the sides.
    #[test]
    fn it_solves_the_linear_equations_of_euler() {
        let time = 0.7;
        for x in [Vect::from([0.3, 0.5]), Vect::from([-0.2, 0.9])] {
            let p = |x: Vect<2>| Solution::<2>::pressure(&WAVE, &x, time).expect("a pressure");
            let change = velocity(&x, time + STEP) - velocity(&x, time - STEP);
            let mut divergence = 0.0;
            for axis in 0..2 {
                let mut side = Vect::<2>::zeros();
                side[axis] = STEP;
                let weight = if axis == 1 { -WAVE.gravity } else { 0.0 };
                let pull = (p(x - side) - p(x + side)) / WAVE.density + 2.0 * STEP * weight;
                assert!((change[axis] - pull).abs() < 1e-6 * change.norm());
                divergence += (velocity(&(x + side), time) - velocity(&(x - side), time))[axis];
            }
            assert!(divergence.abs() < 1e-6 * STEP, "{divergence}");
        }
        assert!(velocity(&Vect::from([0.3, 0.0]), time)[1].abs() < 1e-15);
        assert!(velocity(&Vect::from([1.0, 0.4]), time)[0].abs() < 1e-15);
    }

    /// Ripples of a millimetre on a metre of water: kd = 6283, and cosh(kd) is no number.
    #[test]
    fn deep_water_does_not_overflow() {
        let ripple = StandingWave {
            wavelength: 1e-3,
            ..WAVE
        };
        let at = |z: f64| Solution::<2>::velocity(&ripple, &Vect::from([0.0, z]), 0.0);
        let top = at(1.0).expect("a velocity")[1];
        let expected = ripple.amplitude * ripple.frequency();
        assert!((top - expected).abs() < 1e-12 * expected, "{top}");
        assert_eq!(at(0.5), Some(Vect::zeros()));
    }

    /// ∂η/∂t = u_z at the surface, where p = ρg (d + η − z) to first order.
    #[test]
    fn the_surface_moves_with_the_water() {
        let (x, time) = (Vect::from([0.3, 1.0]), 0.7);
        let surface = |t: f64| {
            Solution::<2>::pressure(&WAVE, &x, t).expect("a pressure")
                / (WAVE.density * WAVE.gravity)
        };
        let rises = (surface(time + STEP) - surface(time - STEP)) / (2.0 * STEP);
        let goes = velocity(&x, time)[1];
        let error = (rises - goes).abs();
        assert!(error < 1e-6 * goes.abs(), "{rises} for {goes}");
    }
}
