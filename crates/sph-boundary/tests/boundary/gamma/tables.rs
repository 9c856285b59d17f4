//! The reference values for Wendland C2 in the theory of semi-analytical walls, for d = 2.

use sph_boundary::{Contact, Renormalisation2d};

use crate::close;

fn wendland() -> Renormalisation2d {
    Renormalisation2d::new(sph_kernels::wendland_c2().shape(), 1.0).unwrap()
}

/// Half a unit of the last digit printed, with room for the next digit's rounding.
const NINE_DIGITS: f64 = 5.1e-10;
const TWELVE_DIGITS: f64 = 5.1e-13;

#[test]
fn infinite_flat_wall() {
    let table = [
        (0.0, 0.742723068, 0.5),
        (0.1, 0.729104185, 0.573814665),
        (0.25, 0.663981672, 0.678882653),
        (0.5, 0.483731398, 0.823496914),
        (0.75, 0.288634398, 0.919604015),
        (1.0, 0.136330599, 0.971490937),
        (1.25, 0.046451715, 0.993055813),
        (1.5, 0.009065153, 0.999129737),
        (1.75, 0.000474552, 0.999977894),
    ];
    for (d, gradient, gamma) in table {
        let seen = wendland().segment([-9.0, -d], [9.0, -d], [0.0, 1.0]);
        let inside = seen.contact == Contact::Inside;
        let theta = if inside { 0.5 } else { 1.0 };
        close(seen.kernel, gradient, NINE_DIGITS, d);
        close(theta - seen.gamma, gamma, NINE_DIGITS, d);
    }
}

#[test]
fn single_segments() {
    let table = [
        (0.5, -0.25, 0.25, 0.170350713966, 0.093202509690),
        (0.5, 0.25, 0.75, 0.116662162128, 0.037197635444),
        (0.5, 1.0, 2.5, 0.014303991253, 0.001000900110),
        (1.0, -0.25, 0.25, 0.050459312054, 0.012894127665),
        (1.5, -0.5, 1.0, 0.008085086641, 0.000802524740),
        (0.0, 0.25, 0.75, 0.176115668839, 0.0),
        (0.25, -2.5, 2.5, 0.663981671855, 0.321117347372),
    ];
    for (q0, y1, y2, gradient, gamma) in table {
        let seen = wendland().segment([y1, -q0], [y2, -q0], [0.0, 1.0]);
        close(seen.kernel, gradient, TWELVE_DIGITS, (q0, y1));
        close(seen.gamma, gamma, TWELVE_DIGITS, (q0, y1));
        let behind = wendland().segment([y1, q0], [y2, q0], [0.0, 1.0]);
        assert_eq!((behind.kernel, behind.gamma), (seen.kernel, -seen.gamma));
    }
}

#[test]
fn corners() {
    let arm = |point: [f64; 2], from: [f64; 2], to: [f64; 2], normal| {
        let seen = |v: [f64; 2]| [v[0] - point[0], v[1] - point[1]];
        wendland().segment(seen(from), seen(to), normal).gamma
    };
    let p = [0.4, 0.7];
    let right = 1.0
        - arm(p, [0.0, 9.0], [0.0, 0.0], [1.0, 0.0])
        - arm(p, [0.0, 0.0], [9.0, 0.0], [0.0, 1.0]);
    close(right, 0.69645881, 5.1e-9, "90° corner");
    let p = [-0.3, 0.6];
    let reentrant = 1.0
        - arm(p, [-9.0, 0.0], [0.0, 0.0], [0.0, 1.0])
        - arm(p, [0.0, 0.0], [0.0, -9.0], [1.0, 0.0]);
    close(reentrant, 0.90540692, 5.1e-9, "270° corner");
}
