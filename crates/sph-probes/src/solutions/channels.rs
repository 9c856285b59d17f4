//! Developed and starting flows in channels and pipes.

use std::f64::consts::PI;

use sph_core::{Axis, Vect, plugin, rectangular_duct};

use crate::flow::point::point;
use crate::solutions::{along, decaying};
use crate::{Solution, SolutionEntry};

/// u = U η/H + Σ_n 2U/(nπ) (−1)ⁿ sin(nπη/H) exp(−n²π²νt/H²): the upper wall starts at t = 0.
///
/// Source: Morris et al. 1997, Eq. 20.
#[plugin(SolutionEntry [2, 3], "couette", "channel flow dragged by its upper wall, started from rest",
    source: "Morris et al. 1997, Eq. 20")]
pub struct Couette {
    /// Velocity U of the upper wall along x.
    #[parameter(unit: "m/s")]
    pub wall_velocity: f64,
    /// Kinematic viscosity ν.
    #[parameter(unit: "m²/s", above: 0.0)]
    pub kinematic_viscosity: f64,
    /// Height H of the channel.
    #[parameter(unit: "m", above: 0.0)]
    pub height: f64,
    /// Ordinate of the lower wall.
    #[parameter(default, unit: "m")]
    pub bottom: f64,
}

impl<const D: usize> Solution<D> for Couette {
    fn velocity(&self, position: &Vect<D>, time: f64) -> Option<Vect<D>> {
        let eta = (position[D - 1] - self.bottom) / self.height;
        let rate = PI * PI * self.kinematic_viscosity * time / (self.height * self.height);
        let terms = (1..400).map(|n| {
            let k = f64::from(n);
            let sign = if n % 2 == 0 { 1.0 } else { -1.0 };
            let amplitude = 2.0 * self.wall_velocity / (k * PI) * sign * (k * PI * eta).sin();
            (amplitude, (-k * k * rate).exp())
        });
        along(0, decaying(self.wall_velocity * eta, terms))
    }
}

/// u = a/(2ν) η(H−η) − Σ_n 4aH²/(νπ³(2n+1)³) sin(πη(2n+1)/H) exp(−(2n+1)²π²νt/H²), with η the
/// distance from the lower wall.
///
/// Source: Morris et al. 1997, Eq. 21.
#[plugin(SolutionEntry [2, 3], "poiseuille", "plane channel flow driven by a body force, started from rest",
    source: "Morris et al. 1997, Eq. 21")]
pub struct Poiseuille {
    /// Driving acceleration a along x.
    #[parameter(unit: "m/s²")]
    pub acceleration: f64,
    /// Kinematic viscosity ν.
    #[parameter(unit: "m²/s", above: 0.0)]
    pub kinematic_viscosity: f64,
    /// Height H of the channel.
    #[parameter(unit: "m", above: 0.0)]
    pub height: f64,
    /// Ordinate of the lower wall.
    #[parameter(default, unit: "m")]
    pub bottom: f64,
}

impl<const D: usize> Solution<D> for Poiseuille {
    fn velocity(&self, position: &Vect<D>, time: f64) -> Option<Vect<D>> {
        let (a, nu, height) = (self.acceleration, self.kinematic_viscosity, self.height);
        let eta = position[D - 1] - self.bottom;
        let terms = (0..200).map(|n| {
            let k = f64::from(2 * n + 1);
            let amplitude = 4.0 * a * height * height / (nu * PI.powi(3) * k.powi(3));
            let decay = (-k * k * PI * PI * nu * time / (height * height)).exp();
            (-amplitude * (PI * eta * k / height).sin(), decay)
        });
        along(0, decaying(0.5 * a / nu * eta * (height - eta), terms))
    }
}

/// u = a (R² − r²)/(4ν) along the axis of a pipe, driven by the body acceleration a.
///
/// The last transient falls as exp(−5.783 νt/R²): after νt = 1.5 R² it is below 2·10⁻⁴. In two
/// dimensions `axis` is x or y and the flow that between planes, a (R² − r²)/(2ν).
///
/// Source: Hagen 1839, Poiseuille 1840; see Batchelor 1967, Eq. 4.2.5.
///
/// ```toml
/// [reference.profile]
/// field = "velocity"
/// solution = "hagen-poiseuille"
/// norm = "l2"
/// [reference.profile.parameters]
/// axis = "x"
/// centre = [0.0, 0.0, 0.0]
/// radius = 0.5
/// acceleration = 1.0
/// kinematic_viscosity = 0.1
/// ```
#[plugin(SolutionEntry [2, 3], "hagen-poiseuille", "developed flow in a round pipe",
    source: "Batchelor 1967, Eq. 4.2.5")]
pub struct HagenPoiseuille {
    /// Direction of the pipe.
    #[parameter(default)]
    pub axis: Axis,
    /// A point on its axis.
    #[parameter(default, unit: "m")]
    pub centre: Vec<f64>,
    /// Radius R.
    #[parameter(unit: "m", above: 0.0)]
    pub radius: f64,
    /// Body acceleration a along the axis.
    #[parameter(unit: "m/s²")]
    pub acceleration: f64,
    /// Kinematic viscosity ν.
    #[parameter(unit: "m²/s", above: 0.0)]
    pub kinematic_viscosity: f64,
}

impl<const D: usize> Solution<D> for HagenPoiseuille {
    fn velocity(&self, position: &Vect<D>, _time: f64) -> Option<Vect<D>> {
        let axis = (self.axis as usize).min(D - 1);
        let mut across = position - point::<D>(&self.centre);
        across[axis] = 0.0;
        let share = if D == 2 { 2.0 } else { 4.0 };
        let parabola = self.radius * self.radius - across.norm_squared();
        let speed = self.acceleration * parabola / (share * self.kinematic_viscosity);
        along(axis, speed)
    }
}

/// Developed laminar flow along a rectangular duct, driven by the body acceleration a or a fall of the pressure ρ a per
/// length: u = a φ(y, z)/ν with φ a series of cosines.
///
/// Source: White 2006, Viscous Fluid Flow, Eq. 3-48.
///
/// ```toml
/// [reference.profile]
/// field = "velocity"
/// solution = "duct-poiseuille"
/// norm = "l2"
/// [reference.profile.parameters]
/// axis = "x"
/// centre = [0.0, 0.5, 0.5]
/// sides = [1.0, 1.0]
/// acceleration = 1.0
/// kinematic_viscosity = 0.1
/// ```
#[plugin(SolutionEntry [3], "duct-poiseuille", "developed flow in a rectangular duct", source: "White 2006, Eq. 3-48")]
pub struct DuctPoiseuille {
    /// Direction of the duct.
    #[parameter(default)]
    pub axis: Axis,
    /// A point on its axis.
    #[parameter(default, unit: "m")]
    pub centre: Vec<f64>,
    /// Lengths of its sides along the two other axes, in their order.
    #[parameter(unit: "m")]
    pub sides: [f64; 2],
    /// Body acceleration a along the axis.
    #[parameter(unit: "m/s²")]
    pub acceleration: f64,
    /// Kinematic viscosity ν.
    #[parameter(unit: "m²/s", above: 0.0)]
    pub kinematic_viscosity: f64,
}

impl Solution<3> for DuctPoiseuille {
    fn velocity(&self, position: &Vect<3>, _time: f64) -> Option<Vect<3>> {
        let axis = self.axis as usize;
        let from = position - point::<3>(&self.centre);
        let mut across = (0..3).filter(|k| *k != axis).map(|k| from[k]);
        let across = [across.next()?, across.next()?];
        let phi = rectangular_duct(across, self.sides.map(|side| 0.5 * side));
        along(axis, self.acceleration * phi / self.kinematic_viscosity)
    }
}

/// u⁺ = α² − y⁺² + A (α + y⁺) below the interface, ω [(1−α)² − y⁺²] + λωA (y⁺ − (1−α)) above it,
/// with A = [(1−α)² ω − α²] / [(1−α) λω + α].
///
/// y⁺ = y/L counts from the interface, u⁺ = u/ũ with ũ = g L²/(2 ν₁); λ = ρ₁/ρ₂, ω = ν₁/ν₂,
/// ν = η/ρ; fluid 1 is the lower one, −αL ≤ y ≤ 0, fluid 2 lies in 0 ≤ y ≤ (1−α)L. The flow is
/// steady, which it is after t ≈ L²/ν₁ from rest; beyond the walls the parabolas go on.
///
/// Source: Ghaïtanellis 2017, Eq. 5.1–5.5.
///
/// ```toml
/// [reference.profile]
/// field = "velocity"
/// solution = "bifluid-poiseuille"
/// norm = "l2"
/// [reference.profile.parameters]
/// alpha = 0.5
/// length = 1.0
/// densities = [4000, 1000]
/// viscosities = [1.6, 0.1]
/// acceleration = 4e-7
/// ```
#[plugin(SolutionEntry [2, 3], "bifluid-poiseuille", "steady channel flow of two layered fluids",
    source: "Ghaïtanellis 2017, Eq. 5.1–5.5")]
pub struct BifluidPoiseuille {
    /// Share α of the height that the lower fluid fills.
    #[parameter(unit: "1", above: 0.0, below: 1.0)]
    pub alpha: f64,
    /// Height L of the channel.
    #[parameter(unit: "m", above: 0.0)]
    pub length: f64,
    /// Densities ρ₁ below and ρ₂ above.
    #[schemars(inner(range(min = 0.0)))]
    #[parameter(unit: "kg/m³")]
    pub densities: [f64; 2],
    /// Dynamic viscosities η₁ below and η₂ above.
    #[schemars(inner(range(min = 0.0)))]
    #[parameter(unit: "Pa s")]
    pub viscosities: [f64; 2],
    /// Driving acceleration g along x.
    #[parameter(unit: "m/s²")]
    pub acceleration: f64,
    /// Ordinate of the interface.
    #[parameter(default, unit: "m")]
    pub interface: f64,
}

impl BifluidPoiseuille {
    /// u⁺ at y⁺.
    fn scaled(&self, y: f64) -> f64 {
        let lambda = self.densities[0] / self.densities[1];
        let omega = self.viscosities[0] / self.viscosities[1] / lambda;
        let (alpha, above) = (self.alpha, 1.0 - self.alpha);
        let a = (above * above * omega - alpha * alpha) / (above * lambda * omega + alpha);
        match y <= 0.0 {
            true => alpha * alpha - y * y + a * (alpha + y),
            false => omega * (above * above - y * y) + lambda * omega * a * (y - above),
        }
    }
}

impl<const D: usize> Solution<D> for BifluidPoiseuille {
    fn velocity(&self, position: &Vect<D>, _time: f64) -> Option<Vect<D>> {
        let kinematic = self.viscosities[0] / self.densities[0];
        let scale = self.acceleration * self.length * self.length / (2.0 * kinematic);
        let y = (position[D - 1] - self.interface) / self.length;
        along(0, scale * self.scaled(y))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_starts_at_rest_and_becomes_a_parabola() {
        let flow = Poiseuille {
            acceleration: 0.8,
            kinematic_viscosity: 0.1,
            height: 1.0,
            bottom: 0.0,
        };
        let at = |y: f64, t: f64| flow.velocity(&Vect::from([0.0, y]), t).unwrap().x;
        assert!(at(0.3, 0.0).abs() < 1e-6, "u(t=0) = {:e}", at(0.3, 0.0));
        assert!((at(0.5, 1e3) - 1.0).abs() < 1e-14);
        assert!(at(0.0, 1.0).abs() < 1e-14 && at(1.0, 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_laplacian_of_the_profile_balances_the_acceleration() {
        let pipe = HagenPoiseuille {
            axis: Axis::Z,
            centre: vec![0.1, -0.2, 5.0],
            radius: 0.5,
            acceleration: 3.0,
            kinematic_viscosity: 0.7,
        };
        let u = |x: f64, y: f64| Solution::<3>::velocity(&pipe, &[x, y, 1.0].into(), 0.0);
        let (x, y, h) = (0.2, 0.05, 1e-3);
        let at = |dx: f64, dy: f64| u(x + dx, y + dy).unwrap().z;
        let around = at(h, 0.0) + at(-h, 0.0) + at(0.0, h) + at(0.0, -h);
        let laplacian = (around - 4.0 * at(0.0, 0.0)) / (h * h);
        assert!((0.7 * laplacian + 3.0).abs() < 1e-6, "{laplacian}");
        assert!(at(0.4, -0.25).abs() < 1e-12, "at rest on the wall");
    }

    #[test]
    fn the_flow_is_along_the_axis_and_fastest_there() {
        let duct = DuctPoiseuille {
            axis: Axis::Y,
            centre: vec![0.5, 9.0, 0.25],
            sides: [1.0, 0.5],
            acceleration: 2.0,
            kinematic_viscosity: 0.1,
        };
        let at = |x: f64, z: f64| duct.velocity(&Vect::<3>::new(x, 0.0, z), 0.0);
        let middle = at(0.5, 0.25).unwrap_or_else(Vect::zeros);
        let wide = rectangular_duct([0.0; 2], [0.5, 0.25]);
        assert_eq!(middle, Vect::<3>::new(0.0, 20.0 * wide, 0.0));
        assert!(at(0.5, 0.4).unwrap_or_else(Vect::zeros)[1] < middle[1]);
        assert_eq!(at(1.0, 0.25), Some(Vect::zeros()));
    }

    #[test]
    fn the_printed_values_are_met() {
        let flow = BifluidPoiseuille {
            alpha: 0.5,
            length: 1.0,
            densities: [4000.0, 1000.0],
            viscosities: [1.6, 0.1],
            acceleration: 4e-7,
            interface: 0.0,
        };
        let places = [-0.4, -0.2, 0.0, 0.1, 3.0 / 17.0, 0.2, 0.3, 0.4];
        let speeds = [
            0.098824, 0.236471, 0.2941176, 0.395294, 0.4186851, 0.416471, 0.357647, 0.218824,
        ];
        for (y, u) in places.into_iter().zip(speeds) {
            assert!((flow.scaled(y) - u).abs() < 6e-7, "{y}: {}", flow.scaled(y));
        }
        let n = 1000;
        let middle = |k: i32| (f64::from(k) + 0.5) / f64::from(n) - 0.5;
        let mean: f64 = (0..n).map(|k| flow.scaled(middle(k))).sum::<f64>() / f64::from(n);
        // The integral is 0.2512255; a sum over coarse rows gives the 0.2512242 found elsewhere.
        assert!((mean - 0.251_225_5).abs() < 1e-6, "{mean}");
        // ũ = 5·10⁻⁴ m/s.
        let u = Solution::<2>::velocity(&flow, &Vect::from([3.0, 0.0]), 0.0).expect("a velocity");
        assert!((u.x - 5e-4 * 0.294_117_647).abs() < 1e-12 && u.y == 0.0);
    }

    #[test]
    fn stress_and_walls_are_right_for_unequal_layers() {
        let flow = BifluidPoiseuille {
            alpha: 0.3,
            viscosities: [0.02, 3.0],
            densities: [5.0, 800.0],
            interface: 0.7,
            length: 2.0,
            acceleration: 2.0,
        };
        let u = |y: f64| flow.velocity(&Vect::from([0.0, y]), 0.0).unwrap().x;
        let h = 1e-5;
        let size = u(0.6).abs();
        assert!((u(0.7 - 0.6) / size).abs() < 1e-9 && (u(0.7 + 1.4) / size).abs() < 1e-9);
        let below = 0.02 * (u(0.7) - u(0.7 - h)) / h;
        let above = 3.0 * (u(0.7 + h) - u(0.7)) / h;
        // One-sided differences err by η u″ h/2 = ρ g h/2 on either side.
        assert!((below - above).abs() < 1600.0 * h, "{below} {above}");
        let bend = 3.0 * (u(1.0 + 1e-3) - 2.0 * u(1.0) + u(1.0 - 1e-3)) / 1e-6;
        assert!((bend + 1600.0).abs() < 1e-2, "{bend}");
    }
}
