//! Bodies that meet walls and each other, away from the fluid.

use sph_tests::{below, bench, close, near};

use crate::bodies::states;

/// A puddle in the corner of a wide tank, and two boxes in the dry.
const DRY: &str = include_str!("dry.toml");

const ONE: &str = "--set wall.one.mover.rigid-body";
const TWO: &str = "--set wall.two.mover.rigid-body";

/// A fall of 0.49 m with e = 0.5: back to e² of the height, at its time √(2 h/g) (1 + e).
#[test]
fn a_box_that_falls_bounces_to_the_square_of_its_restitution() {
    let lifted = DRY.replace("[0.6, 0.01], [0.8, 0.21]", "[0.6, 0.51], [0.8, 0.71]");
    let bench = bench!(&lifted);
    bench.done(&format!(
        "run scene.toml --quiet --out r --threads 1 --set run.end=0.6 {ONE}.restitution=0.5"
    ));
    let series = bench.series("r");
    let (time, height) = (series.column("time"), series.column("one.y"));
    let down = height.iter().position(|y| *y < -0.48).expect("it falls");
    let (top, at) = (height.iter().zip(time).skip(down)).fold((-1.0, 0.0), |best, (y, t)| {
        if *y > best.0 { (*y, *t) } else { best }
    });
    // It meets the floor at a spacing, where it rests.
    let fall: f64 = 0.51 - 0.02;
    let left = ((top + fall) / fall).sqrt();
    close(left, 0.5, 0.02, "share of the velocity that is left");
    let expected = (2.0 * fall / 9.81).sqrt() * (1.0 + left);
    near(at, expected, 0.03, "s of the top");
    let turned = states::<2>(&bench.path("r"))[0].angular_velocity[2];
    assert!(turned.abs() < 1e-6, "it turns with {turned:e} rad/s");
}

/// v²/(2 μ g) with 1 m/s and μ = 0.4.
#[test]
fn a_box_that_slides_stops_where_friction_stops_it() {
    let bench = bench!(DRY);
    bench.done(&format!(
        "run scene.toml --quiet --out r --threads 1 {ONE}.friction=0.4 {ONE}.velocity=[1,0]"
    ));
    let state = states::<2>(&bench.path("r"))[0];
    let way = state.pose.translation[0] / (1.0 / (2.0 * 0.4 * 9.81));
    assert!((way - 1.0).abs() < 0.02, "it slides {way:.3} of the way");
    below(state.velocity.norm(), 0.005, "m/s that are left");
    let sunk = 0.01 - (0.01 + state.pose.translation[1]);
    assert!(sunk.abs() < 0.002, "it stands {sunk} m too deep");
}

/// One of 20 kg with 1 m/s into one of 60 kg at rest, e = 1: −0.5 m/s and 0.5 m/s.
#[test]
fn two_boxes_that_meet_keep_their_momentum_and_part_as_restitution_says() {
    let weightless = DRY.replace("gravity = [0.0, -9.81]\n", "");
    let weightless = weightless.replace("pressure = \"hydrostatic\"\n", "");
    let bench = bench!(&weightless);
    bench.done(&format!(
        "run scene.toml --quiet --out r --threads 1 --set run.end=1.1 \
         {ONE}.restitution=1 {TWO}.restitution=1 {ONE}.velocity=[1,0]"
    ));
    let states = states::<2>(&bench.path("r"));
    let [one, two] = [states[0].velocity[0], states[1].velocity[0]];
    let momentum = 20.0 * one + 60.0 * two;
    assert!((momentum / 20.0 - 1.0).abs() < 1e-12, "{momentum}");
    close(one, -0.5, 0.02, "m/s of the first");
    close(two, 0.5, 0.01, "m/s of the second");
}
