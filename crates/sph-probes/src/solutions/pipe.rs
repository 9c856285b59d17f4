//! Developed flows in pipes: round and rectangular.

use sph_core::{Axis, Vect, plugin, rectangular_duct};

use crate::flow::point::point;
use crate::{Solution, SolutionEntry, solutions::along};

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

#[cfg(test)]
mod tests {
    use super::*;

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
}
