//! Bodies, frames and tanks that move.

use crate::Field;
use sph_io::Table;
use sph_tests::Outcome;

fn done(outcome: Outcome) {
    assert_eq!(outcome.code, Some(0), "{}", outcome.err);
}

fn last(series: &Table, name: &str) -> f64 {
    *series
        .column(name)
        .and_then(<[f64]>::last)
        .expect("a number")
}

/// Courses of gravity that end with 1 m/s² along x.
const SIDEWAYS: [&str; 3] = [
    "--set numerics.gravity_over_time.table=[[0,0,0],[0.3,1,0]]",
    "--set numerics.gravity_over_time.file=quake.csv --set numerics.gravity_over_time.scale=2 \
     --set numerics.gravity_over_time.columns=[\"time\",\"ground\",\"vertical\"]",
    "--set numerics.frame.translate.along=[-1,0] --set numerics.frame.translate.ramp.speed=2 \
     --set numerics.frame.translate.ramp.over=2",
];

#[test]
fn the_ends_of_a_shaken_tank_differ_by_its_acceleration() {
    let field = Field::new();
    for course in SIDEWAYS {
        done(field.run("shaken", course));
        let series = field.series();
        let between = last(&series, "right") - last(&series, "left");
        // ρ a L over 30 spacings.
        let exact = 900.0 * 1.0 * 0.6;
        assert!(
            (between / exact - 1.0).abs() < 0.01,
            "{course}: {between} Pa for {exact} Pa"
        );
        // Gravity that changes has no potential: it drives, and the books know of it.
        let unlisted = last(&series, "books.unlisted");
        assert!(
            unlisted.abs() < 1e-9,
            "{course}: {unlisted} J nobody booked"
        );
    }
}

#[test]
fn a_tank_in_free_fall_has_one_pressure() {
    let field = Field::new();
    done(field.run(
        "shaken",
        "--set numerics.frame.translate.along=[0,-1] --set numerics.frame.translate.ramp.speed=14.715 \
         --set numerics.frame.translate.ramp.over=1.5 --set run.end=1.4",
    ));
    let series = field.series();
    let between = last(&series, "low") - last(&series, "high");
    // Of ρ g H = 2649 Pa before.
    assert!(between.abs() < 0.01 * 2649.0, "{between} Pa");
    assert!(last(&series, "largest_speed") < 1e-3);
}

#[test]
fn the_surface_tilts_by_the_acceleration_over_gravity() {
    let field = Field::new();
    for course in [SIDEWAYS[0], SIDEWAYS[2]] {
        done(field.run("sloshed", &format!("{course} --set run.end=1.8")));
        let series = field.series();
        let tilt = last(&series, "left") - last(&series, "right");
        let exact = 0.5 * 1.0 / 9.81;
        // Half a spacing at each end.
        assert!(
            (tilt + exact).abs() < 0.01,
            "{course}: {tilt} m for {exact} m"
        );
    }
}

#[test]
fn mistakes_of_gravity_over_time_are_told_with_their_line() {
    let field = Field::new();
    for (set, told) in [
        ("table=[[0,0,0],[0,1,0]]", "times must rise"),
        ("table=[[0,0]]", "a time and 2 entries"),
        ("sine.amplitude=[1]", "period"),
        ("file=ball.txt", "found 1 columns"),
        ("scale=2", "a course is missing"),
    ] {
        let set = format!("--set numerics.gravity_over_time.{set}");
        let outcome = field.check("shaken", &set);
        assert_ne!(outcome.code, Some(0), "{set}");
        assert!(outcome.err.contains(told), "{set}: {}", outcome.err);
    }
    let turned = "--set numerics.frame.angular_velocity=1 --set numerics.frame.centre=[0,0]";
    let outcome = field.check("shaken", turned);
    assert!(outcome.err.contains("only translates"), "{}", outcome.err);
}
