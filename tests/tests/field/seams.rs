//! Borders: of periodic boxes, and between ranks.

use crate::Field;
use sph_tests::near;

/// Where the body is in a series, with all that the probe tells.
fn courses(field: &Field, input: &str, more: &str) -> [Vec<f64>; 3] {
    let series = field.ran(input, &format!("--threads 1 {more}"));
    series
        .columns(["A.x", "A.y", "A.angle"])
        .map(<[f64]>::to_vec)
}

/// A box drawn at a place, with its probe.
fn at(x: f64, y: [f64; 2]) -> String {
    format!(
        "--set wall.a.box=[[{},{}],[{},{}]] --set probe.A.at=[{x},{}]",
        x - 0.2,
        y[0],
        x + 0.2,
        y[1],
        0.5 * (y[0] + y[1])
    )
}

/// The largest difference of two courses, m or rad.
fn apart(a: &[Vec<f64>; 3], b: &[Vec<f64>; 3]) -> f64 {
    let pairs = a.iter().flatten().zip(b.iter().flatten());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// A periodic box has no border: what is moved along it takes the same course, to rounding that grows with time.
#[test]
fn a_body_does_not_feel_a_periodic_border() {
    let field = Field::new();
    let end = "--set run.end=0.5 --set output.every=0.5 --set output.series_every=0.05";
    for (input, more) in [
        // It floats at rest, and a lighter one that turns is let go.
        ("seam-body-drawn", ""),
        (
            "seam-body-drawn",
            "--set wall.a.mover.rigid-body.density=200 --set wall.a.mover.rigid-body.angular_velocity=[1]",
        ),
        (
            "seam-body-drawn",
            "--set walls={dummy-particles={}} --set wall.a.mover.rigid-body.angular_velocity=[1]",
        ),
        // It drifts along with 3 m/s: across the border once, and round it several times.
        ("seam-body", ""),
        (
            "seam-body",
            "--set wall.a.mover.rigid-body.velocity=[12,0] --set body.w.velocity=[12,0]",
        ),
    ] {
        let more = format!("{end} {more}");
        let there = courses(&field, input, &format!("{} {more}", at(1.0, [0.6, 0.9])));
        for x in [0.0, 0.5, 2.0] {
            let here = courses(&field, input, &format!("{} {more}", at(x, [0.6, 0.9])));
            let most = apart(&there, &here);
            assert!(most < 1e-6, "{input} {more}: {most:e} apart at {x} m");
        }
    }
}

/// In space, across all borders at once.
#[test]
fn a_cube_does_not_feel_periodic_borders() {
    let field = Field::new();
    let run = |x: f64| {
        let [low, high] = [x - 0.3, x + 0.3];
        let more = format!(
            "--threads 1 --set wall.a.box=[[{low},{low},{low}],[{high},{high},{high}]] --set probe.A.at=[{x},{x},{x}]"
        );
        let series = field.ran("seam-cube", &more);
        ["A.x", "A.y", "A.z", "A.rx", "A.ry", "A.rz"].map(|name| series.last(name))
    };
    let (there, here) = (run(1.0), run(0.0));
    assert!(there[3] > 0.02, "it turns: {there:?}");
    for (a, b) in there.iter().zip(here) {
        assert!((a - b).abs() < 1e-9, "{there:?} and {here:?}");
    }
}

/// Two boxes that meet across the border do what they do in the middle.
#[test]
fn bodies_meet_across_a_periodic_border() {
    let field = Field::new();
    let other = |x: f64| {
        format!(
            "--set wall.b.box=[[{},1.4],[{},1.6]] --set wall.b.fluid=outside \
             --set wall.b.mover.rigid-body.density=800 --set wall.b.mover.rigid-body.restitution=1 \
             --set wall.a.mover.rigid-body.restitution=1",
            x - 0.1,
            x + 0.1
        )
    };
    let more = "--set numerics.gravity=[0,0] --set body.w.pressure=zero --set body.w.box=[[0,0],[2,0.3]] \
                --set body.w.velocity=[0,0] --set run.end=0.4 --set output.every=0.4";
    let run = |x: f64, of: f64| {
        courses(
            &field,
            "seam-body",
            &format!("{} {} {more}", at(x, [1.3, 1.6]), other(of)),
        )
    };
    let there = run(0.8, 1.25);
    let turned = there[2].last().expect("a row").abs();
    assert!(turned > 1e-3, "it is hit off its centre: {turned} rad");
    for (x, of) in [(1.8, 0.25), (1.6, 2.05)] {
        let here = run(x, of);
        let most = apart(&there, &here);
        assert!(most < 1e-9, "{most:e} m or rad apart at {x} m");
    }
}

/// A block of wall that is towed with the water at its speed does not stir it.
#[test]
fn a_wall_goes_through_a_periodic_border() {
    let field = Field::new();
    let towed = "--set wall.a.mover={} --set wall.a.motion.translate.along=[1,0] \
                 --set wall.a.motion.translate.speed=3 --set run.end=0.5 --set output.every=0.5";
    let stirred = |x: f64, walls: &str| {
        courses(
            &field,
            "seam-body",
            &format!("{} {towed} {walls}", at(x, [0.6, 0.9])),
        );
        field.summary()["kinetic_energy"]
            .as_f64()
            .expect("a number")
    };
    for walls in ["", "--set walls={dummy-particles={}}"] {
        let there = stirred(1.0, walls);
        for x in [0.0, 0.7] {
            let here = stirred(x, walls);
            near(here, there, 1e-6, &format!("{walls}: J at {x} m"));
        }
    }
}

/// Blows of particles, contact, a line, a hold and the fluid on two bodies.
#[test]
fn bodies_take_the_same_course_on_any_number_of_ranks() {
    let field = Field::new();
    let ran = |ranks: u32| {
        let set = format!("--threads 1 --ranks {ranks} --set run.end=0.3");
        field.ran("ranks-bodies", &set);
        field.state("r")
    };
    let one = ran(1);
    for ranks in [2, 3, 4, 9] {
        one.assert_same(&ran(ranks), &format!("1 and {ranks} ranks"));
    }
}
