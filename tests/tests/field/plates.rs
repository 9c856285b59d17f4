//! Thin plates, free ends of walls, and bodies under water.

use sph_tests::{Says, near, one_line};

use crate::Field;

/// The number behind a name in `summary.json`.
fn number(field: &Field, path: &str) -> f64 {
    let summary = field.summary();
    let found = summary.pointer(&format!("/{path}"));
    let number = found.and_then(serde_json::Value::as_f64);
    number.unwrap_or_else(|| panic!("{path}: {found:?}"))
}

/// A run that got to its end without a step back, with all mass in the books.
fn done(field: &Field, input: &str, more: &str) {
    field.ran(input, more);
    assert_eq!(field.summary()["status"], "done");
    assert_eq!(number(field, "steps_rolled_back"), 0.0);
    let missing = number(field, "drift/mass");
    assert!(missing.abs() < 1e-12, "{missing:e} of the mass is missing");
}

/// What a check that ends with a code says, in one line.
fn checked(field: &Field, input: &str, more: &str, code: i32) -> String {
    let outcome = field.check(input, more);
    let text = [outcome.out, outcome.err].concat();
    assert_eq!(outcome.code, Some(code), "{text}");
    one_line(&text)
}

/// A wave behind a lifted gate throws water over the end of the tank.
#[test]
fn a_splash_at_the_upper_end_of_a_tank_ends_nothing() {
    let field = Field::new();
    done(&field, "lift-gate", "");
    // The water falls 0.3 m with c = 35 m/s: gH/c² = 0.2 %, and a stroke of the front has some (2√(gH)/c)² = 1 %.
    let [least, largest] = [0, 1].map(|k| number(&field, &format!("density_range/{k}")));
    assert!(least > 0.95 && largest < 1.05, "{least} to {largest}");
}

/// Water runs off a plate without a wall behind its end. Nobody is faster than the front of a dam break on the bed that already
/// runs, u + 2√(gH), after a free fall to the lower end of the domain.
#[test]
fn a_sheet_that_leaves_a_plate_falls_freely() {
    let field = Field::new();
    done(&field, "plate-end", "");
    let front = 1.5 + 2.0 * (9.81f64 * 0.1).sqrt();
    let most = (front * front + 2.0 * 9.81 * 1.3).sqrt();
    let fastest = field.series().largest("largest_speed");
    assert!(fastest < most, "{fastest} m/s of {most}");
    // The plate gives no energy.
    let rise = number(&field, "drift/energy_rise");
    assert!(rise < 0.01, "energy rises by {rise}");
    // Behind the end water is as dense as it was: the fall has no pressure.
    let least = number(&field, "density_range/0");
    assert!(least > 0.97, "{least}");
}

/// A block pushes more water out of a tank than there is room for: it stands over both rims and falls outside.
#[test]
fn water_runs_over_both_rims_of_a_full_tank() {
    let field = Field::new();
    done(&field, "full-tank", "");
    assert!(number(&field, "escaped") > 0.0, "nobody is outside");
    let [least, largest] = [0, 1].map(|k| number(&field, &format!("density_range/{k}")));
    // The column of 0.4 m is 0.6 % denser at its foot; nothing moves faster than 1/20 of the speed of sound.
    assert!(least > 0.97 && largest < 1.03, "{least} to {largest}");
}

/// In space, over the edges of a box, and out of the domain.
#[test]
fn water_runs_over_the_rim_of_a_box_and_is_counted_where_it_leaves() {
    let field = Field::new();
    done(&field, "rim-3d", "");
    assert!(number(&field, "left/domain.water/particles") > 0.0);
}

/// The message names the wall, and the spacing that it tells will do.
#[test]
fn plates_that_hide_nothing_are_refused_with_the_spacing_that_would_do() {
    for (input, wall) in [("thin-cup", "wall.cup"), ("thin-baffle-3d", "wall.baffle")] {
        let field = Field::new();
        let text = checked(&field, input, "", 2);
        text.says(&format!("{wall} | would feel each other"));
        let told = text.split("numerics.spacing` ").nth(1).expect("a spacing");
        let spacing: f64 = told.split(' ').next().unwrap().parse().expect("a number");
        for (spacing, code) in [(1.2 * spacing, 2), (spacing, 0)] {
            let set = format!("--set numerics.spacing={spacing}");
            checked(&field, input, &set, code);
        }
    }
}

/// Where no water is on the other side a thin plate is nobody's trouble.
#[test]
fn a_thin_plate_with_water_on_one_side_is_not_refused() {
    let field = Field::new();
    let dry = "--set body.outside.box=[[0.0,0.0],[0.4,0.03]]";
    let text = checked(&field, "thin-cup", dry, 0);
    text.says("would feel each other");
}

/// The mesh of a box is its own mirror image, and so is the flow around it: what is left is rounding.
#[test]
fn a_symmetric_scene_with_a_floating_box_stays_symmetric() {
    let field = Field::new();
    done(&field, "moored-four", "--set run.end=0.6");
    for name in ["box.x", "box.y", "box.rx", "box.ry", "box.rz"] {
        let off = field.series().largest_size(name);
        assert!(off < 1e-6, "{name} is {off:e}");
    }
    let moved = field.series().largest_size("box.z");
    assert!(moved > 1e-3, "the box heaves");
}

/// Water of a finite speed of sound is denser at depth z by gz/c², and a body there feels as much more buoyancy.
#[test]
fn buoyancy_grows_with_the_density_of_the_water_around() {
    let buoyancy = |c: f64| {
        let field = Field::new();
        let held = "--set wall.disc.mover.rigid-body.start=9 --set damping.rayleigh.rate=20 --set run.end=0.8 \
                    --set damping.rayleigh.until=0.8";
        let set = format!("{held} --set phase.water.speed_of_sound={c}");
        done(&field, "neutral-disc", &set);
        field.series().last("force.y")
    };
    let (slow, fast) = (30.0, 60.0);
    let weight = 1000.0 * 9.81 * 18.0 * 0.15 * 0.15 * (std::f64::consts::TAU / 36.0).sin();
    let [of_slow, of_fast] = [slow, fast].map(|c| buoyancy(c) / weight - 1.0);
    let told = |c: f64| 9.81 * 0.5 / (c * c);
    let (measured, expected) = (of_slow - of_fast, told(slow) - told(fast));
    // The mean depth of the water is known to half a spacing of 0.5 m, and the force to a part of what both runs share.
    near(measured, expected, 0.1, "difference of the buoyancies");
    // What is left is the error of the discretisation, one part in a hundred of a radius of six spacings.
    assert!((of_fast - told(fast)).abs() < 0.01, "{of_fast:e}");
}
