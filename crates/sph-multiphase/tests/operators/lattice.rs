//! Morris's operator on u_x = y² in the bulk of a lattice: the response is 2, nearly.

use sph_core::{Vect, fields};

use crate::evaluate::{acceleration, pressure, viscosity};
use crate::world::{at, lattice, open, set, set_velocity, world};

/// L{1, y²} in the middle of an open lattice with this ratio h/δr.
fn response<const D: usize>(n: usize, ratio: f64) -> f64 {
    let mut world = world(lattice::<D>(n), open(), 1.0 / n as f64, ratio);
    set_velocity(&mut world, |x| {
        let mut u = Vect::zeros();
        u[0] = x[1] * x[1];
        u
    });
    let middle = at(&world, Vect::repeat(0.5));
    let force = acceleration(&world, viscosity(1.0))[middle];
    let across: f64 = force.iter().skip(1).map(|f| f.abs()).sum();
    assert!(across < 1e-12, "only u_x was given: {force}");
    force[0]
}

#[test]
fn y_squared_gives_1948_1995_19984_19998_in_2d_and_1958_1999_in_3d() {
    for (value, printed, digits) in [
        (response::<2>(15, 1.3), 1.948, 3),
        (response::<2>(15, 1.5), 1.995, 3),
        (response::<2>(15, 2.0), 1.9984, 4),
        (response::<2>(15, 3.0), 1.9998, 4),
        (response::<3>(9, 1.3), 1.958, 3),
        (response::<3>(11, 2.0), 1.999, 3),
    ] {
        let half = 0.5000001 * 10f64.powi(-digits);
        let off = (value - printed).abs();
        assert!(off <= half, "{value} is not {printed}");
    }
}

/// −∇p/ρ of p = 1 + 0.3 y: the lattice is symmetric, so the level of p drops out.
#[test]
fn a_linear_pressure_accelerates_by_its_slope_to_1_per_cent_whatever_its_level() {
    let mut values = Vec::new();
    for level in [0.0, 1.0, 1000.0] {
        let mut world = world(lattice::<2>(15), open(), 1.0 / 15.0, 2.0);
        set(&mut world, fields::PRESSURE, |x| level + 0.3 * x[1]);
        values.push(acceleration(&world, pressure())[at(&world, Vect::repeat(0.5))][1]);
    }
    assert!((values[0] / -0.3 - 1.0).abs() < 0.01, "{values:?}");
    // The level is 1e4 times what is summed, times rounding.
    assert!((values[2] - values[0]).abs() < 1e-9, "{values:?}");
}
