//! The box of a scene: from the scene, or around its walls and bodies.

use sph_core::Vect;
use sph_neighbours::Domain;
use sph_scene::{Region, Scene};

use crate::failure::error::SolverError;
use crate::setup::shapes::Drawn;

/// Extent of all bodies along gravity, m.
pub fn height<const D: usize>(scene: &Scene, regions: &[Region<D>]) -> f64 {
    let gravity = scene.gravity::<D>();
    let Some(down) = gravity.try_normalize(0.0) else {
        return 0.0;
    };
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for region in regions {
        let (lower, upper) = region.base.bounds();
        for corner in 0..1 << D {
            let along: f64 = (0..D)
                .map(|k| {
                    down[k]
                        * if corner >> k & 1 == 0 {
                            lower[k]
                        } else {
                            upper[k]
                        }
                })
                .sum();
            low = low.min(along);
            high = high.max(along);
        }
    }
    (high - low).max(0.0)
}

/// The scene's domain, or a box round walls and bodies with room to move.
pub fn domain_of<const D: usize>(scene: &Scene, drawn: &Drawn<D>) -> Domain<D> {
    let mut lower = Vect::<D>::repeat(f64::INFINITY);
    let mut upper = Vect::<D>::repeat(f64::NEG_INFINITY);
    let mut include = |x: &[f64]| {
        for k in 0..D.min(x.len()) {
            lower[k] = lower[k].min(x[k]);
            upper[k] = upper[k].max(x[k]);
        }
    };
    for region in &drawn.regions {
        let (low, high) = region.base.bounds();
        include(&low);
        include(&high);
    }
    if let Some((low, high)) = &drawn.bounds {
        include(low);
        include(high);
    }
    // Splashes rise over an open tank; without walls the flow may go far.
    let room = match scene.wall.is_empty() {
        true => 10.0,
        false => 2.0,
    };
    let margin = Vect::repeat(room * (upper - lower).max());
    let mut domain = Domain::open(lower - margin, upper + margin);
    if let Some([low, high]) = &scene.numerics.domain {
        domain = Domain::open(Vect::from_column_slice(low), Vect::from_column_slice(high));
    }
    for (axis, bounds) in scene.numerics.periodic.bounds::<D>().iter().enumerate() {
        if let Some([low, high]) = bounds {
            domain.lower[axis] = *low;
            domain.upper[axis] = *high;
            domain.periodic[axis] = true;
        }
    }
    domain
}

/// A period must be so long that no particle sees another one twice.
pub fn check_periods<const D: usize>(domain: &Domain<D>, reach: f64) -> Result<(), SolverError> {
    for axis in (0..D).filter(|&a| domain.periodic[a]) {
        if domain.length(axis) < 2.0 * reach {
            let name = ["x", "y", "z"][axis];
            return Err(SolverError::at(
                format!("numerics.periodic.{name}"),
                format!(
                    "the period of {} m is shorter than two supports with their skin: at least {:.6} m",
                    domain.length(axis),
                    2.0 * reach
                ),
            ));
        }
    }
    Ok(())
}
