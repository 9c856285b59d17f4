//! Energy that dampers and walls make of flows that should lose it.

use crate::Field;

/// Two streams of unlike densities past each other, at any ratio: the damper only takes, and nothing gains.
#[test]
fn the_acoustic_damper_takes_energy_at_any_ratio_of_densities() {
    for ratio in [1.0, 10.0, 100.0, 1000.0] {
        for strength in [0.5, 2.0] {
            let field = Field::new();
            let series = field.ran("damper-ratio", &format!(
                    "--threads 1 --set phase.w.density={ratio} --set phase.w.rheology.newtonian.viscosity={ratio} \
                     --set damping.acoustic.strength={strength} --set run.end=0.1"
                ));
            let of = |name: &str| series.column(name);
            let damper = of("b.damper");
            for k in 1..series.rows() {
                assert!(damper[k] <= damper[k - 1], "{ratio}: row {k}");
            }
            let whole = |k: usize| of("b.kinetic")[k] + of("b.internal")[k];
            let most = (0..series.rows()).map(whole).fold(0.0, f64::max);
            assert!(most <= whole(0) * (1.0 + 1e-6), "{ratio}: {most} J");
        }
    }
}

/// A lattice beside walls without a relaxation, which scenes of water at rest have by default.
const LATTICE: &str = "--threads 1 --set numerics.relax.steps=0";

/// A narrow tank and a U-tube that start at rest stay there, to a hundredth and a fifteenth of √(gH).
#[test]
fn narrow_water_at_rest_stays_at_rest() {
    for (name, most) in [("narrow-tank-100", 0.1), ("utube-at-rest", 0.2)] {
        let field = Field::new();
        field.ran(name, "--threads 1");
        let speed = field.series().largest("largest_speed");
        println!("{name}: {speed} m/s");
        assert!(speed < most, "{name}: {speed} m/s");
    }
}

/// From rest to 10 m/s, the level 7 % up: walls make the energy, and the run says so.
#[test]
fn a_narrow_tank_that_explodes_from_a_lattice_has_no_result() {
    let field = Field::new();
    let done = field
        .run("narrow-tank-100", &format!("{LATTICE} --set run.end=0.3"))
        .ended(1);
    let summary = field.summary();
    assert_eq!(summary["status"], "failed");
    done.says("without a drive");
}

/// Water at rest in a U-tube of 8 rows, from a lattice, moves with 1 m/s: walls make 2 % of what would move, and the run tells. The
/// damper that the advice names leaves a seventh of √(gH) = 3.1 m/s at the most.
#[test]
fn a_tube_at_rest_that_moves_warns_and_the_advice_helps() {
    let field = Field::new();
    field.ran("utube-at-rest", LATTICE);
    let summary = field.summary();
    let warned =
        |summary: &serde_json::Value| summary["warnings"].to_string().contains("without a drive");
    assert!(warned(&summary));
    assert!(summary["advice"].to_string().contains("[damping.acoustic]"));
    let field = Field::new();
    let damped = format!("{LATTICE} --set damping.acoustic={{}}");
    field.ran("utube-at-rest", &damped);
    let most = field.series().largest("largest_speed");
    assert!(!warned(&field.summary()) && most < 3.1 / 7.0, "{most} m/s");
}
