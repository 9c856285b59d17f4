//! Developed flow in a rectangular duct.

use sph_core::{Axis, Vect, plugin, rectangular_duct};

use crate::flow::point::point;
use crate::{Solution, SolutionEntry, solutions::along};

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
