//! Bodies, frames and tanks that move.

use sph_tests::{below, close, near};

use crate::Field;

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
        let series = field.ran("shaken", course);
        let between = series.last("right") - series.last("left");
        // ρ a L over 30 spacings.
        let exact = 900.0 * 1.0 * 0.6;
        near(between, exact, 0.01, &format!("{course}, Pa"));
        // Gravity that changes has no potential: it drives, and the books know of it.
        let unlisted = series.last("books.unlisted");
        below(unlisted, 1e-9, &format!("{course}: J unlisted"));
    }
}

#[test]
fn a_tank_in_free_fall_has_one_pressure() {
    let field = Field::new();
    let falls = "--set numerics.frame.translate.along=[0,-1] --set run.end=1.4 \
                 --set numerics.frame.translate.ramp.speed=14.715 --set numerics.frame.translate.ramp.over=1.5";
    let series = field.ran("shaken", falls);
    let between = series.last("low") - series.last("high");
    // Of ρ g H = 2649 Pa before.
    assert!(between.abs() < 0.01 * 2649.0, "{between} Pa");
    assert!(series.last("largest_speed") < 1e-3);
}

#[test]
fn the_surface_tilts_by_the_acceleration_over_gravity() {
    let field = Field::new();
    for course in [SIDEWAYS[0], SIDEWAYS[2]] {
        let series = field.ran("sloshed", &format!("{course} --set run.end=1.8"));
        let tilt = series.last("left") - series.last("right");
        // Half a spacing at each end.
        close(tilt, -0.5 * 1.0 / 9.81, 0.01, course);
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
        field.refuses("shaken", &set, told);
    }
    let turned = "--set numerics.frame.angular_velocity=1 --set numerics.frame.centre=[0,0]";
    field.check("shaken", turned).says("only translates");
}

#[test]
fn a_body_alone_coasts_and_falls() {
    let field = Field::new();
    for (gravity, g) in [("[0,0,0]", 0.0), ("[0,0,-9.81]", 9.81)] {
        let end = "--set run.end=0.5 --set output.series_every=0.05 --set output.every=0.25";
        let set = format!("{end} --set numerics.gravity={gravity}");
        let series = field.ran("free-flight", &set);
        let [time, x, z] = series.columns(["time", "cube.x", "cube.z"]);
        for k in 0..time.len() {
            let t = time[k];
            close(x[k], t, 1e-12, "m along");
            close(z[k], -0.5 * g * t * t, 1e-12, "m down");
        }
    }
}

#[test]
fn bodies_that_meet_without_fluid_keep_their_momentum_and_energy() {
    let field = Field::new();
    let series = field.ran("two-boxes", "");
    let [time, left, right] = series.columns(["time", "left.x", "right.x"]);
    let (end, masses) = (time.len() - 1, [20.0, 40.0]);
    let speeds = [left, right].map(|x| (x[end] - x[end - 2]) / (time[end] - time[end - 2]));
    // An elastic blow: each leaves with 2 V − v, V that of the common centre, which is at rest here.
    for (speed, exact) in speeds.into_iter().zip([-1.0, 0.5]) {
        close(speed, exact, 0.02, "m/s");
    }
    let momentum = masses[0] * speeds[0] + masses[1] * speeds[1];
    assert!(momentum.abs() < 1e-9, "{momentum} kg m/s of 20");
}

#[test]
fn a_scene_without_bodies_of_fluid_and_movers_is_refused() {
    let field = Field::new();
    let refused = field.check("shaken", "--set body={}");
    refused.says("a scene needs a body");
}

/// Angle of a circular segment of the height and width of the drop, from the last third of the run.
fn angle_of_drop(field: &Field, more: &str) -> f64 {
    let series = field.ran("drop", more);
    let mean = |name: &str| {
        let all = series.column(name);
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
    close(found, 60.0, SHARPNESS, "deg");
}

#[test]
fn a_wall_of_its_own_shuns_the_drop() {
    let key = "--set interface.surface-tension.contact_angle";
    // 60° through the oil are 120° through the water.
    let shuns = format!("{key}.phase=oil {key}.angle=2.5 {key}.walls.box=1.0472");
    let found = angle_of_drop(&Field::new(), &shuns);
    close(found, 120.0, SHARPNESS, "deg");
}

#[test]
fn a_contact_angle_of_nothing_is_refused() {
    let field = Field::new();
    let vertices = "phase=oil KEY.angle=1 --set walls.usaw.vertices=true";
    for (more, told) in [
        ("phase=watr KEY.angle=1", "did you mean `water`"),
        ("phase=oil KEY.angle=1 KEY.walls.bx=1", "did you mean `box`"),
        ("phase=oil KEY.angle=4", "at most"),
        (vertices, "vertices = false"),
    ] {
        let key = "--set interface.surface-tension.contact_angle";
        let set = format!("KEY.{more}").replace("KEY", key);
        field.check("drop", &set).says(told);
    }
}
