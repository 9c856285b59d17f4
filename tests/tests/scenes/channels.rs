//! Poiseuille and Couette flow between semi-analytical walls, from rest to the steady profile.

use crate::shipped::{finished, second_order, whole};

#[test]
fn poiseuille_converges_from_0_18_to_0_048_per_cent() {
    let coarse = finished("poiseuille-2d", &["numerics.spacing=0.0625"]);
    let coarse = coarse.error("profile", second_order(16.0), 0.00179);
    let fine = finished("poiseuille-2d", &["numerics.spacing=0.03125"]);
    let fine = fine.error("profile", second_order(32.0), 0.000475);
    assert!(fine < 0.3 * coarse, "{coarse} to {fine}");
}

#[test]
fn couette_is_met_to_0_0074_per_cent() {
    // A linear velocity is exact at rest; rows that slide past each other feel 0.009 % more than a lattice does.
    let rows_that_slide = 0.9e-4;
    whole("couette-2d").error("profile", rows_that_slide, 0.0000738);
}

/// Two fluids, 25 rows, by an operator of the whole stress: what rows that slide feel is 1.3 % beyond a lattice at rest,
/// and the velocity misses as much, unless the operator is scaled for them.
#[test]
fn operators_scaled_for_sliding_rows_are_three_times_nearer_in_a_layered_channel() {
    let with = |on_lattice: &str| {
        let scale = format!("viscous-operator.monaghan-gingold.on_lattice=\"{on_lattice}\"");
        let size = [
            "numerics.spacing=0.04",
            "numerics.periodic.x=[0,0.64]",
            "wall.bottom.polyline=[[0,-0.5],[0.64,-0.5]]",
            "wall.top.polyline=[[0.64,0.5],[0,0.5]]",
            "body.heavy.box=[[0,-0.5],[0.64,0.5]]",
            "body.light.box=[[0,-0.5],[0.64,0.5]]",
            "implicit-viscosity.backward-euler={}",
            "integrator.symplectic-euler.courant=1.2",
            &scale,
        ];
        finished("bifluid-poiseuille-re1p25", &size)
    };
    // Twelve rows to each fluid, and the 1.3 % that sliding rows feel.
    let lattice = with("exact").error("profile", 0.013 + second_order(12.5), 0.0164);
    let rows = with("rows").error("profile", second_order(12.5), 0.0045);
    assert!(3.0 * rows < lattice, "{rows}, {lattice} on a lattice");
}

/// In a steady channel friction takes from the fluid all that its driving gives, 8 m/s², but for what rows that slide past
/// each other make it swing, and pressure takes no more than a millionth. The slowest transient has fallen to e^(−π²νt/H²) = 4·10⁻⁷.
#[test]
fn accelerations_by_class_of_terms_balance_the_driving() {
    let probe = |name: &str| {
        format!(
            "probe.{name}={{kind=\"statistic\",field=\"{name}_acceleration.x\",weight=\"mass\"}}"
        )
    };
    let (friction, pressure) = (probe("viscous"), probe("pressure"));
    let set = ["numerics.spacing=0.0625", &friction, &pressure];
    let run = finished("poiseuille-2d", &set);
    let (lost, pressed) = (run.last("viscous") / -8.0 - 1.0, run.last("pressure"));
    println!("{lost:e} of the driving is left, {pressed:e} m/s² by pressure");
    assert!(lost.abs() < 0.9e-4, "{lost:e}");
    assert!(pressed.abs() < 8e-6, "{pressed:e}");
}

/// Finer particles in the upper part make the error of the whole smaller: 0.00047 without them.
#[test]
fn a_parabola_passes_a_zone_of_finer_particles() {
    let sets = ["numerics.spacing=0.03125 zone.upper.box=[[0.0,0.6],[0.625,1.2]]"];
    finished("poiseuille-2d", &sets).error("profile", 0.00047, 0.00038);
}
