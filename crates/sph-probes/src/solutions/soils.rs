//! Layers of grains: their steady flow down a plane, and their consolidation.

use std::f64::consts::{FRAC_PI_2, PI};

use sph_core::{Vect, plugin};

use crate::solutions::{along, decaying};
use crate::{Solution, SolutionEntry};

/// u(z) = 2I/(3d) √(φ g cos θ) [H^(3/2) − (H − z)^(3/2)] along the first axis, and
/// p(z) = [exp(K φρ_g g cos θ (H − z)) − 1]/K.
///
/// The inertial number is the same at every height, I = I_0 (tan θ − μ_s)/(μ_2 − tan θ), and so is
/// the share of space φ = φ_max − (φ_max − φ_min) I. A layer that is H_0 deep at rest, with
/// φ = φ_max, dilates to H = H_0 φ_max/φ. Rigid grains, K = 0, have the pressure φρ_g g cos θ (H − z).
///
/// Symbols: z height above the plane (m), θ inclination, d grain diameter (m), ρ_g grain density, K
/// compressibility of the grains (1/Pa). Limits: where tan θ ≤ μ_s nothing flows; where tan θ ≥ μ_2
/// there is no steady flow, and no velocity and pressure to compare with. K is not felt by H or u.
///
/// Source: Minatti & Paris 2015, Eq. 56 (printed with exponents 2 for 3/2); dilation and the
/// pressure of compressible grains are ours, after its Eq. 8 and 41.
///
/// ```toml
/// [reference.profile]
/// field = "velocity"
/// solution = "bagnold"
/// norm = "l2"
/// [reference.profile.parameters]
/// inclination = "25 deg"
/// depth = 0.1
/// static_friction = 0.3819
/// limiting_friction = 0.6435
/// reference_inertial_number = 0.279
/// grain_diameter = "5 mm"
/// grain_density = 800
/// ```
#[plugin(SolutionEntry [2, 3], "bagnold", "steady flow of grains down a plane, friction by the inertial number",
    source: "Minatti & Paris 2015, Eq. 56")]
pub struct Bagnold {
    /// Inclination θ of the plane.
    #[parameter(unit: "rad", above: 0.0, below: 1.57)]
    pub inclination: f64,
    /// Depth H_0 of the layer at rest.
    #[parameter(unit: "m", above: 0.0)]
    pub depth: f64,
    /// Friction coefficient μ_s of slow flow.
    #[parameter(unit: "1", above: 0.0)]
    pub static_friction: f64,
    /// Friction coefficient μ_2 of fast flow.
    #[parameter(unit: "1", above: 0.0)]
    pub limiting_friction: f64,
    /// Inertial number I_0 half way between the two.
    #[parameter(unit: "1", above: 0.0)]
    pub reference_inertial_number: f64,
    /// Grain diameter d.
    #[parameter(unit: "m", above: 0.0)]
    pub grain_diameter: f64,
    /// Density ρ_g of the grains themselves.
    #[parameter(unit: "kg/m³", above: 0.0)]
    pub grain_density: f64,
    /// Share of space φ_max that the grains fill at rest.
    #[parameter(default: 0.6, unit: "1", above: 0.0, max: 1.0)]
    pub largest_fraction: f64,
    /// Share of space φ_min at an inertial number of one; φ_max where nothing dilates.
    #[parameter(default: 0.5, unit: "1", min: 0.0, max: 1.0)]
    pub smallest_fraction: f64,
    /// Compressibility K of the grains; they are rigid if left out.
    #[parameter(default, unit: "1/Pa", min: 0.0)]
    pub compressibility: f64,
    /// Magnitude g of gravity.
    #[parameter(default: 9.81, unit: "m/s²", above: 0.0)]
    pub gravity: f64,
    /// Ordinate of the plane.
    #[parameter(default, unit: "m")]
    pub bottom: f64,
}

/// Constants over the height.
struct Steady {
    /// I.
    inertial_number: f64,
    /// φ.
    fraction: f64,
    /// H, m.
    depth: f64,
    /// g cos θ, m/s².
    pressing: f64,
}

impl Bagnold {
    fn steady(&self) -> Option<Steady> {
        let friction = self.inclination.tan();
        if friction >= self.limiting_friction {
            return None;
        }
        let over = (friction - self.static_friction).max(0.0);
        let inertial_number =
            self.reference_inertial_number * over / (self.limiting_friction - friction);
        let range = self.largest_fraction - self.smallest_fraction;
        let fraction = self.largest_fraction - range * inertial_number;
        (fraction > 0.0).then(|| Steady {
            inertial_number,
            fraction,
            depth: self.depth * self.largest_fraction / fraction,
            pressing: self.gravity * self.inclination.cos(),
        })
    }
}

impl<const D: usize> Solution<D> for Bagnold {
    fn velocity(&self, position: &Vect<D>, _time: f64) -> Option<Vect<D>> {
        let steady = self.steady()?;
        let over = (steady.depth + self.bottom - position[D - 1]).max(0.0);
        let scale = (steady.fraction * steady.pressing).sqrt() / self.grain_diameter;
        let powers = steady.depth.powf(1.5) - over.powf(1.5);
        along(0, 2.0 / 3.0 * steady.inertial_number * scale * powers)
    }

    fn pressure(&self, position: &Vect<D>, _time: f64) -> Option<f64> {
        let steady = self.steady()?;
        let over = (steady.depth + self.bottom - position[D - 1]).max(0.0);
        let rigid = steady.fraction * self.grain_density * steady.pressing * over;
        Some(match self.compressibility > 0.0 {
            true => (self.compressibility * rigid).exp_m1() / self.compressibility,
            false => rigid,
        })
    }
}

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
        let places = (0..20_000).map(|m| FRAC_PI_2 + PI * f64::from(m));
        let terms = places.map(|m| (2.0 / m * (m * z).sin(), (-m * m * progress).exp()));
        self.load * decaying(0.0, terms)
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

    fn sheet(change: impl Fn(&mut Bagnold)) -> Bagnold {
        let mut sheet = Bagnold {
            inclination: 25_f64.to_radians(),
            depth: 0.1,
            static_friction: 20.9_f64.to_radians().tan(),
            limiting_friction: 32.76_f64.to_radians().tan(),
            reference_inertial_number: 0.279,
            grain_diameter: 5e-3,
            grain_density: 800.0,
            largest_fraction: 0.6,
            smallest_fraction: 0.5,
            compressibility: 0.0,
            gravity: 9.81,
            bottom: 0.3,
        };
        change(&mut sheet);
        sheet
    }

    fn at(flow: &Bagnold, z: f64) -> [f64; 2] {
        let place = Vect::from([7.0, z]);
        let u = Solution::<2>::velocity(flow, &place, 0.0).expect("a velocity");
        let p = Solution::<2>::pressure(flow, &place, 0.0).expect("a pressure");
        assert_eq!(u.y, 0.0);
        [u.x, p]
    }

    /// Numbers computed independently.
    #[test]
    fn the_printed_case_is_met() {
        let flow = sheet(|_| {});
        let steady = flow.steady().expect("a steady flow");
        assert!((steady.inertial_number - 0.132987).abs() < 1e-6);
        assert!((steady.fraction - 0.586701).abs() < 1e-6);
        let depth = steady.depth;
        assert!((depth - 0.10227).abs() < 1e-5);
        for (z, u) in [(0.1, 0.1936), (0.25, 0.4642), (0.5, 0.8562), (1.0, 1.3244)] {
            let found = at(&flow, 0.3 + z * depth)[0];
            assert!((found - u).abs() < 6e-5, "{z}: {found}");
        }
        assert!((at(&flow, 0.3)[1] - 426.76).abs() < 0.01 && at(&flow, 0.3)[0].abs() < 1e-12);
        assert_eq!(at(&flow, 9.0)[1], 0.0);
        // A layer that does not dilate is as deep as it was at rest.
        let rigid = sheet(|flow| flow.smallest_fraction = 0.6);
        assert_eq!(rigid.steady().map(|s| s.depth), Some(0.1));
    }

    /// Friction and weight balance at every height, with the inertial number of the definition.
    #[test]
    fn the_stress_balances_the_weight() {
        let flow = sheet(|_| {});
        let (h, z) = (1e-6, 0.34);
        let rate = (at(&flow, z + h)[0] - at(&flow, z - h)[0]) / (2.0 * h);
        let pressure = at(&flow, z)[1];
        let number = rate * flow.grain_diameter * (flow.grain_density / pressure).sqrt();
        let range = flow.limiting_friction - flow.static_friction;
        let part = number / (number + flow.reference_inertial_number);
        let friction = flow.static_friction + range * part;
        let balance = friction / flow.inclination.tan();
        assert!((balance - 1.0).abs() < 1e-8, "{friction}");
        // dp/dz = −φρ_s g cos θ with ρ_s = ρ_g (1 + Kp).
        let soft = sheet(|flow| flow.compressibility = 1e-4);
        let slope = (at(&soft, z + h)[1] - at(&soft, z - h)[1]) / (2.0 * h);
        let steady = soft.steady().expect("a steady flow");
        let density = steady.fraction * 800.0 * (1.0 + 1e-4 * at(&soft, z)[1]);
        assert!((slope / (-density * steady.pressing) - 1.0).abs() < 1e-7);
    }

    #[test]
    fn too_flat_a_plane_holds_and_too_steep_a_one_has_no_steady_flow() {
        let flat = sheet(|flow| flow.inclination = 0.3);
        assert_eq!(at(&flat, 0.35)[0], 0.0);
        let steep = sheet(|flow| flow.inclination = 0.6);
        assert_eq!(Solution::<3>::velocity(&steep, &Vect::zeros(), 0.0), None);
        assert_eq!(Solution::<3>::pressure(&steep, &Vect::zeros(), 0.0), None);
    }

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
            let off = found / 100.0 - share;
            assert!(off.abs() < 1e-6, "{z} {number}: {found}");
        }
    }
}
