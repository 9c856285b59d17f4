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

fn column<'a>(series: &'a Table, name: &str) -> &'a [f64] {
    series.column(name).expect("a column")
}

#[test]
fn a_body_alone_coasts_and_falls() {
    let field = Field::new();
    for (gravity, g) in [("[0,0,0]", 0.0), ("[0,0,-9.81]", 9.81)] {
        let end = "--set run.end=0.5 --set output.series_every=0.05 --set output.every=0.25";
        done(field.run(
            "free-flight",
            &format!("{end} --set numerics.gravity={gravity}"),
        ));
        let series = field.series();
        let [time, x, z] = ["time", "cube.x", "cube.z"].map(|name| column(&series, name));
        for k in 0..time.len() {
            let t = time[k];
            assert!((x[k] - t).abs() < 1e-12, "{} m at {t} s", x[k]);
            assert!(
                (z[k] + 0.5 * g * t * t).abs() < 1e-12,
                "{} m down at {t} s",
                z[k]
            );
        }
    }
}

#[test]
fn bodies_that_meet_without_fluid_keep_their_momentum_and_energy() {
    let field = Field::new();
    done(field.run("two-boxes", ""));
    let series = field.series();
    let [time, left, right] = ["time", "left.x", "right.x"].map(|name| column(&series, name));
    let (end, masses) = (time.len() - 1, [20.0, 40.0]);
    let speeds = [left, right].map(|x| (x[end] - x[end - 2]) / (time[end] - time[end - 2]));
    // An elastic blow: each leaves with 2 V − v, V that of the common centre, which is at rest here.
    for (speed, exact) in speeds.into_iter().zip([-1.0, 0.5]) {
        assert!((speed - exact).abs() < 0.02, "{speed} m/s for {exact} m/s");
    }
    let momentum = masses[0] * speeds[0] + masses[1] * speeds[1];
    assert!(momentum.abs() < 1e-9, "{momentum} kg m/s of 20");
}

#[test]
fn a_scene_without_bodies_of_fluid_and_movers_is_refused() {
    let field = Field::new();
    let outcome = field.check("shaken", "--set body={}");
    assert!(
        outcome.err.contains("a scene needs a body"),
        "{}",
        outcome.err
    );
}

/// Angle of a circular segment of the height and width of the drop, from the last third of the run.
fn angle_of_drop(field: &Field, more: &str) -> f64 {
    done(field.run("drop", more));
    let series = field.series();
    let mean = |name: &str| {
        let all = column(&series, name);
        let late = &all[2 * all.len() / 3..];
        late.iter().sum::<f64>() / late.len() as f64
    };
    // Particles stand half a spacing inside.
    let spacing = 0.3125e-3;
    let height = mean("water.highest") + 0.5 * spacing;
    let width = mean("waterx.highest") - mean("waterx.lowest") + spacing;
    // A drop that hangs over is as wide as its circle.
    let angle = match 2.0 * height < width {
        true => 2.0 * (2.0 * height / width).atan(),
        false => (1.0 - 2.0 * height / width).acos(),
    };
    angle.to_degrees()
}

/// Half a spacing of 8 rows in height and width is 5°.
const SHARPNESS: f64 = 5.0;

#[test]
fn a_drop_on_a_plate_takes_the_contact_angle() {
    let key = "--set interface.surface-tension.contact_angle";
    let wets = format!("{key}.phase=water {key}.angle=1.0472");
    let found = angle_of_drop(&Field::new(), &wets);
    assert!((found - 60.0).abs() < SHARPNESS, "{found} deg for 60 deg");
}

#[test]
fn a_wall_of_its_own_shuns_the_drop() {
    let key = "--set interface.surface-tension.contact_angle";
    // 60° through the oil are 120° through the water.
    let shuns = format!("{key}.phase=oil {key}.angle=2.5 {key}.walls.box=1.0472");
    let found = angle_of_drop(&Field::new(), &shuns);
    assert!((found - 120.0).abs() < SHARPNESS, "{found} deg for 120 deg");
}

#[test]
fn a_contact_angle_of_nothing_is_refused() {
    let field = Field::new();
    let key = "--set interface.surface-tension.contact_angle";
    for (more, told) in [
        (
            format!("{key}.phase=watr {key}.angle=1"),
            "did you mean `water`",
        ),
        (
            format!("{key}.phase=oil {key}.angle=1 {key}.walls.bx=1"),
            "did you mean `box`",
        ),
        (format!("{key}.phase=oil {key}.angle=4"), "at most"),
        (
            format!("{key}.phase=oil {key}.angle=1 --set walls.usaw.vertices=true"),
            "vertices = false",
        ),
    ] {
        let outcome = field.check("drop", &more);
        assert!(outcome.err.contains(told), "{more}: {}", outcome.err);
    }
}
