//! Walls and bodies that are fast, heavy or on their way out.

use crate::Field;
use sph_tests::{Says, Series, close};

/// Velocity over the last two intervals of the series, m/s.
fn speed(series: &Series, name: &str) -> f64 {
    let (time, way) = (series.column("time"), series.column(name));
    let end = time.len() - 1;
    (way[end] - way[end - 2]) / (time[end] - time[end - 2])
}

fn done(field: &Field, input: &str, more: &str) {
    field.ran(input, &format!("--threads 1 {more}"));
}

fn assert_refused(field: &Field, more: &str, line: &str) {
    let outcome = field.check("wall-jump", more);
    assert_ne!(outcome.code, Some(0), "{more}");
    let told = outcome.err.contains(line) && outcome.err.contains("speed_of_sound");
    assert!(told, "{more}: {}", outcome.err);
}

#[test]
fn a_table_that_jumps_is_refused_with_its_line() {
    let field = Field::new();
    // A metre in 1e-12, 2 and 20 ms, with a speed of sound of 30 m/s; a jump back.
    let key = "wall.t.motion.translate.table";
    assert_refused(&field, "", "wall-jump.toml:18");
    for course in [
        "[[0,0],[0.004,0],[0.006,1],[1,1]]",
        "[[0,0],[0.002,0],[0.0099,1],[1,1]]",
        "[[0,1],[0.005,1],[0.0051,-1],[1,1]]",
    ] {
        assert_refused(&field, &format!("--set {key}={course}"), key);
    }
    let slow = "--set wall.t.motion.translate.table=[[0,0],[0.5,0.1],[1,1]]";
    assert_eq!(field.check("wall-jump", slow).code, Some(0));
}

#[test]
fn a_prescribed_body_faster_than_sound_is_refused() {
    let field = Field::new();
    let key = "wall.a.mover.rigid-body.prescribed";
    let fast = format!("--set {key}=[{{from=0,to=0.01,course=[[0,0,0,0],[0.01,30,0,0]]}}]");
    let outcome = field.check("bullet-wall", &fast);
    assert_ne!(outcome.code, Some(0));
    outcome.says("faster than sound");
}

/// The plate stands still: −e v, whatever the speed; five times that of sound here.
#[test]
fn no_body_passes_a_plate() {
    let field = Field::new();
    for (v, e) in [(100.0, 0.5), (100.0, 1.0), (-100.0, 0.5), (40.0, 0.8)] {
        // From the other side the plate is before it at the same distance.
        let plate = if v > 0.0 { 0.5 } else { -2.1 };
        let set = format!(
            "--set wall.a.mover.rigid-body.velocity=[{v},0] --set wall.a.mover.rigid-body.restitution={e} \
             --set wall.b.polyline=[[{plate},-0.5],[{plate},1.5]]"
        );
        done(&field, "bullet-wall", &set);
        let left = speed(&field.series(), "A.x") / -v;
        assert!((left - e).abs() < 0.02, "{v} m/s: {left} for {e}");
    }
}

/// u = (m v ± e m' v)/(m + m') of a body of 160 kg and one of a ratio to that, or with the lighter one as heavy.
#[test]
fn bodies_that_meet_keep_momentum_and_energy_at_any_speed_and_ratio() {
    let field = Field::new();
    for (v, e, ratio) in [
        (100.0, 1.0, 1.0),
        (100.0, 0.5, 1.0),
        (100.0, 1.0, 100.0),
        (100.0, 0.5, 0.01),
        (15.0, 1.0, 1e4),
        (15.0, 0.5, 1e-4),
    ] {
        let unit = 1000.0 * f64::max(0.01 / ratio, 1.0);
        let density = unit * ratio;
        let mut set = format!(
            "--set wall.a.mover.rigid-body.velocity=[{v},0] --set wall.a.mover.rigid-body.restitution={e} \
             --set wall.a.mover.rigid-body.density={unit} --set wall.b.mover.rigid-body.restitution={e} \
             --set wall.b.mover.rigid-body.density={density}"
        );
        if v < 50.0 {
            set += " --set run.end=0.12 --set output.series_every=0.005";
        }
        done(&field, "bullet-body", &set);
        let series = field.series();
        let [a, b] = ["A.x", "B.x"].map(|name| speed(&series, name) / v);
        let (mean, apart): (f64, f64) = (1.0 / (1.0 + ratio), e / (1.0 + ratio));
        let [left, right] = [mean - ratio * apart, mean + apart];
        let told = format!("{v} m/s, e = {e}, 1 : {ratio}: {a} and {b} for {left} and {right}");
        let scale = mean.max(1.0);
        close(a + ratio * b, 1.0, 1e-9 * (1.0 + ratio), &told);
        assert!((b - a - e).abs() < 0.02, "restitution: {told}");
        close(a, left, 0.02 * scale, &told);
        close(b, right, 0.02, &told);
    }
}

/// Each surface keeps its half spacing to the next, less a tenth of the spacing.
#[test]
fn heavy_bodies_stand_on_light_ones() {
    let field = Field::new();
    for [low, high] in [
        [1e3, 1e3],
        [100.0, 1e4],
        [1e4, 100.0],
        [10.0, 1e5],
        [1e5, 10.0],
    ] {
        let set = format!(
            "--set wall.a.mover.rigid-body.density={low} --set wall.b.mover.rigid-body.density={high} \
             --set run.end=0.5"
        );
        done(&field, "heavy-on-light", &set);
        let series = field.series();
        let [a, b] = series.columns(["A.y", "B.y"]);
        for (a, b) in a.iter().zip(b) {
            let missing = f64::max(-a, a - b);
            assert!(missing < 0.1 * 0.05, "{low} under {high}: {missing} m");
        }
    }
}

/// A contact gives back e² of the energy, whatever stands between the body and the floor; no surface goes
/// through another.
#[test]
fn a_heavy_body_that_falls_on_a_light_one_bounces_as_restitution_says() {
    let field = Field::new();
    // Drawn 0.525 m over the light one; surfaces meet at a spacing.
    let fall = 0.525 - 0.05;
    for (density, e) in [(100.0, 0.0), (1e3, 0.5), (1e5, 1.0)] {
        let set = format!(
            "--set wall.b.box=[[0.0,0.85],[0.4,1.15]] --set probe.B.at=[0.2,1.0] --set run.end=0.7 \
             --set wall.b.mover.rigid-body.density={density} --set wall.b.mover.rigid-body.restitution={e} \
             --set wall.a.mover.rigid-body.restitution={e} --set output.series_every=0.002"
        );
        done(&field, "heavy-on-light", &set);
        let series = field.series();
        let [time, a, b] = series.columns(["time", "A.y", "B.y"]);
        // √(2 h/g) is 0.311 s, and it is up again before 0.7 s.
        let landed = time.iter().position(|t| *t > 0.34).expect("it lands");
        let top = b[landed..]
            .iter()
            .fold(f64::NEG_INFINITY, |top, y| top.max(*y));
        let left = ((top + fall) / fall).max(0.0).sqrt();
        assert!((left - e).abs() < 0.02, "{density}: {left} for {e}");
        for (a, b) in a.iter().zip(b) {
            let missing = f64::max(-a, a - b - fall);
            assert!(missing < 0.5 * 0.05, "{density}: {missing} m are missing");
        }
    }
}

#[test]
fn a_body_that_leaves_the_domain_has_no_result() {
    let field = Field::new();
    let aside = "--threads 1 --set wall.b.box=[[0.5,5.0],[0.9,5.4]]";
    let domain = |right: f64| format!("{aside} --set numerics.domain=[[-20,-20],[{right},20]]");
    // From -1 … -0.6 to 2 … 2.4 m.
    for ranks in ["", " --ranks 2"] {
        let outcome = field.run("bullet-body", &(domain(1.5) + ranks));
        assert_ne!(outcome.code, Some(0));
        let told = "the body `a` has left the domain";
        outcome.says(told);
        assert_eq!(field.summary()["status"], "failed");
    }
    field.ran("bullet-body", &domain(2.1));
    let summary = field.summary();
    summary["warnings"].says("`a` reaches out of the domain");
    summary["advice"].says("numerics.domain");
}

/// In the first step, which knows nothing of the fall: ½ g Δt² = 1e5 (0.4 · 0.04/40)² is 16 mm of 20 mm.
#[test]
fn a_body_that_goes_too_far_in_a_step_is_told_of() {
    let field = Field::new();
    let more = "--set numerics.gravity=[0,-2e5] --set run.end=0.002 \
                --set output.series_every=0.001 --set output.every=0.002 --set output.picture=[]";
    field.ran("two-boxes", more);
    let summary = field.summary();
    assert_eq!(summary["steps_rolled_back"], 1);
    let said = |key: &str| summary[key].to_string();
    let warned = said("warnings");
    warned.says("half a spacing | `left`");
    assert!(said("advice").contains("run.safety"), "{}", said("advice"));
    let fallen = field.series().last("left.y");
    assert!((fallen / -0.4 - 1.0).abs() < 1e-9, "{fallen} m for -0.4 m");
}
