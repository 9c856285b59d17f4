//! Zones in which velocities are damped.

use sph_core::{Axis, Vect, parameters};

/// A zone in which the damping grows with the square of the way into it, from nothing at `from` to all of it at `to` and beyond:
/// a rate that jumped would send waves back.
///
/// Source: Israeli & Orszag 1981, J. Comput. Phys. 41, 115–135 (smooth rates).
#[parameters]
#[derive(Copy, PartialEq)]
pub struct Zone {
    /// The axis along which it grows.
    #[parameter(default)]
    pub axis: Axis,
    /// Start of the zone.
    #[parameter(unit: "m")]
    pub from: f64,
    /// End of the growth; `to` may be less than `from`.
    #[parameter(unit: "m")]
    pub to: f64,
}

impl Zone {
    /// The share of the rate at a place, 0 to 1.
    pub fn share<const D: usize>(&self, x: &Vect<D>) -> f64 {
        let way = (x[self.axis as usize] - self.from) / (self.to - self.from);
        way.clamp(0.0, 1.0).powi(2)
    }
}
