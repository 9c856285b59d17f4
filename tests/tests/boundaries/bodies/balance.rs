//! What the fluid gives a body it has no more.

use sph_core::Vect;
use sph_tests::{Bench, below, bench};

use crate::bodies::states;

/// A box that is shot through a fluid without borders, and turns.
const SHOT: &str = include_str!("shot.toml");

/// Momentum of the fluid and of the box, kg m/s.
fn momenta(bench: &Bench, folder: &str) -> [[f64; 2]; 2] {
    let [mass, velocity] = ["mass", "velocity"].map(|name| bench.state(folder).reals(name));
    let of = |k: usize| {
        let all = mass.iter().enumerate();
        all.map(|(i, m)| m * velocity[2 * i + k]).sum::<f64>()
    };
    let state = states::<2>(&bench.path(folder))[0];
    let body = 300.0 * 0.12;
    [
        std::array::from_fn(of),
        std::array::from_fn(|k| body * state.velocity[k]),
    ]
}

/// Of the box's momentum most goes into the fluid; the sum stays to rounding.
#[test]
fn fluid_and_body_together_keep_their_momentum_to_rounding() {
    for (name, changes) in [
        ("explicit", ""),
        ("dummies", " --set walls={\"dummy-particles\"={}}"),
    ] {
        let bench = bench!(SHOT);
        let run = "run scene.toml --quiet --out r --threads 1";
        bench.done(&format!("{run}{changes}"));
        let [fluid, body] = momenta(&bench, "r");
        let start = [36.0, 36.0 * 0.3];
        let given = (fluid[0] / start[0]).abs();
        assert!(given > 0.3, "{name}: the fluid took {given} of it");
        for k in 0..2 {
            let lost = (fluid[k] + body[k] - start[k]).abs() / start[0];
            below(lost, 1e-11, &format!("{name}: lost along axis {k}"));
        }
    }
}

/// A brick that is shot through a fluid without borders in space, and tumbles.
const BRICK: &str = include_str!("brick.toml");

#[test]
fn in_space_momentum_stays_to_rounding_as_well() {
    let bench = bench!(BRICK);
    bench.done("run scene.toml --quiet --out r --threads 1");
    let folder = bench.path("r");
    let [mass, velocity] = ["mass", "velocity"].map(|name| bench.state("r").reals(name));
    let state = states::<3>(&folder)[0];
    let body = 300.0 * 0.4 * 0.5 * 0.3;
    for (k, start) in [1.0, 0.3, -0.2].into_iter().enumerate() {
        let all = mass.iter().enumerate();
        let fluid: f64 = all.map(|(i, m)| m * velocity[3 * i + k]).sum();
        let lost = (fluid + body * (state.velocity[k] - start)).abs() / body;
        below(lost, 1e-11, &format!("lost along axis {k}"));
    }
    let speed = state.velocity[0];
    assert!(speed < 0.9, "the fluid took nothing: {speed}");
    let spin = Vect::<3>::from(state.angular_velocity).norm();
    assert!(spin < 0.95 * 5.25_f64.sqrt(), "{spin} rad/s are left");
}
