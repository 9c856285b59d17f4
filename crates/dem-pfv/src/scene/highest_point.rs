//! The highest point of the grains.

use crate::grains::GrainSystem;

/// The highest point of a grain, m.
pub fn highest(system: &GrainSystem) -> f64 {
    let grains = &system.grains;
    let tops = grains.position.iter().zip(&grains.radius);
    tops.map(|(x, r)| x.z + r).fold(f64::NEG_INFINITY, f64::max)
}
