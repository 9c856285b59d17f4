//! The lid-driven cavity, Re = 100, with 20² particles.

use crate::shipped::{Finished, finished};

/// Steady from 8 s on: 0.08 L²/ν.
const SHORT: [&str; 1] = [
    "numerics.spacing=0.05 run.end=12 reference.u.window=[8, 12] reference.v.window=[8, 12] \
     reference.ghia.window=[8, 12]",
];

/// RMS error of u that central differences of second order have with 20² cells.
const CENTRAL_DIFFERENCES: f64 = 0.0162;

fn cavity(more: &[&str]) -> Finished {
    finished("cavity", &[&SHORT[..], more].concat())
}

/// Half again what a second-order grid of as many points has, whatever the start; and no more than without shifting.
#[test]
fn the_cavity_is_within_0_024_from_a_lattice_and_from_disorder_and_better_with_shifting() {
    let bound = 1.5 * CENTRAL_DIFFERENCES;
    let lattice = cavity(&[]).error("u", bound, 0.0179);
    cavity(&["numerics.jitter=0.09"]).error("u", bound, 0.0172);
    let without = cavity(&["shifting={}"]).error("u", 1.0, 0.0266);
    assert!(lattice <= without, "{lattice}, without shifting {without}");
}

/// The density changes with the pressure, ρU²/c² = 1 % per ρU², of which corners have a few; it does not drift.
#[test]
fn the_cavity_keeps_its_densities_within_5_per_cent_with_every_wall() {
    let walls = [
        "walls.usaw.vertices=false",
        "walls.usaw.vertices=true",
        "walls={dummy-particles={}}",
    ];
    for wall in walls {
        let series = cavity(&[wall]).series();
        let of = |name: &str| series.column(name).iter().copied();
        let least = of("least_density_ratio").fold(1.0, f64::min);
        let largest = of("largest_density_ratio").fold(1.0, f64::max);
        assert!(
            least > 0.95 && largest < 1.05,
            "{wall}: {least} to {largest}"
        );
    }
}
