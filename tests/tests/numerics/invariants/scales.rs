//! The same scene in other units of length, time and mass.

use proptest::prelude::*;
use sph_tests::{assembled, scene};

use crate::invariants::{States, fly, shipped, states};

/// A dam break in a box, in units of which a metre, a second and a kilogram have the given numbers.
fn dam_break(length: f64, time: f64, mass: f64) -> States {
    let speed = length / time;
    let density = mass / length.powi(2);
    let text = format!(
        "title = \"scaled\"
dimension = 2
run.end = {end:e}
[numerics]
spacing = {spacing:e}
gravity = [0.0, {gravity:e}]
[smoother.brezzi-pitkaranta]
strength = 0.04
[walls.usaw]
[wall.tank]
polyline = [[0.0, 0.0], [{width:e}, 0.0], [{width:e}, {width:e}], [0.0, {width:e}]]
closed = true
condition = \"free-slip\"
[wall.step]
box = [[{left:e}, {low:e}], [{right:e}, {high:e}]]
fluid = \"outside\"
[phase.water]
density = {density:e}
speed_of_sound = {sound:e}
[phase.water.rheology.newtonian]
viscosity = {viscosity:e}
[body.column]
phase = \"water\"
box = [[0.0, 0.0], [{column:e}, {deep:e}]]
pressure = \"hydrostatic\"
",
        end = 0.5 * time,
        spacing = 0.03125 * length,
        gravity = -10.0 * length / time.powi(2),
        width = 1.0 * length,
        left = 0.5 * length,
        right = 0.625 * length,
        low = 0.25 * length,
        high = 0.375 * length,
        density = 1000.0 * density,
        sound = 30.0 * speed,
        viscosity = 1.0 * density * length.powi(2) / time,
        column = 0.40625 * length,
        deep = 0.5 * length,
    );
    let mut parts = assembled(&scene(&text, &[]));
    fly(&mut parts, 100, None);
    let speed = 1.0 / speed;
    let back = states(&parts).into_iter();
    back.map(|(x, u)| (x / length, u * speed)).collect()
}

/// Largest difference of positions, m, and of velocities, m/s.
fn apart(a: &States, b: &States) -> [f64; 2] {
    assert_eq!(a.len(), b.len());
    let pairs = a.iter().zip(b);
    pairs.fold([0.0, 0.0], |[x, u]: [f64; 2], (a, b)| {
        [x.max((a.0 - b.0).norm()), u.max((a.1 - b.1).norm())]
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, failure_persistence: None, ..ProptestConfig::default() })]
    /// γ, kernel moments and the speed of sound have irrational factors, but none that depends on the scale.
    #[test]
    fn powers_of_two_give_the_same_bits(length in -20..=20, time in -12..=12, mass in -30..=30) {
        let plain = dam_break(1.0, 1.0, 1.0);
        prop_assert!(plain.len() > 150);
        let [length, time, mass] = [length, time, mass].map(|n| 2_f64.powi(n));
        let scaled = dam_break(length, time, mass);
        prop_assert_eq!(apart(&plain, &scaled), [0.0; 2]);
    }
}

#[test]
fn kilometres_millimetres_and_micrometres_give_the_same_flow() {
    let plain = dam_break(1.0, 1.0, 1.0);
    for [length, time, mass] in [
        [1e-3, 1.0, 1.0],
        [1e3, 1.0, 1e9],
        [1e6, 1e3, 1e6],
        [1e-6, 1e-3, 1e-18],
        [1e-6, 60.0, 1.0],
    ] {
        let [x, u] = apart(&plain, &dam_break(length, time, mass));
        // 7e-14 m/s was measured.
        assert!(x < 1e-9 && u < 1e-9, "{length} {time}: {x:e} {u:e}");
    }
}

/// Lengths and speeds of the vortices twice as large, in the same time.
#[test]
fn implicit_viscosity_gives_the_same_bits_at_twice_the_size() {
    let flown = |overrides: &[&str]| {
        let implicit = ["numerics.jitter=0.2 implicit-viscosity.backward-euler={}"];
        let all: Vec<&str> = implicit.iter().chain(overrides).copied().collect();
        let mut parts = shipped("taylor-green-2d", &all);
        fly(&mut parts, 20, None);
        states(&parts)
    };
    let plain = flown(&["numerics.spacing=0.0625"]);
    let doubled = flown(&[
        "numerics.spacing=0.125 numerics.periodic.x=[0.0, 2.0] numerics.periodic.y=[0.0, 2.0] \
         body.box.box=[[0.0, 0.0], [2.0, 2.0]] body.box.initial.taylor-green.speed=2.0 \
         body.box.initial.taylor-green.length=2.0 \
         body.box.initial.taylor-green.kinematic_viscosity=0.04 phase.fluid.speed_of_sound=20.0 \
         phase.fluid.rheology.newtonian.viscosity=0.04",
    ]);
    let halved = doubled.into_iter().map(|(x, u)| (x * 0.5, u * 0.5));
    assert_eq!(apart(&plain, &halved.collect()), [0.0; 2]);
}
