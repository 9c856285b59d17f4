//! Symmetries of the equations that the discrete system must keep: Galilean and mirror. Right angles are turned in `walls`,
//! units are changed in `scales`.
//!
//! Taylor–Green vortices on a shaken lattice, a hundred steps of a fixed Δt.

use sph_core::{Vect, fields};
use sph_particles::setup::Assembled;

use crate::invariants::{States, fly, shipped, states};

const STEPS: usize = 100;
/// Δt of sound: 0.4 h / c = 0.0048 s for h = 0.12 m and c = 10 m/s.
const DT: f64 = 0.004;

fn vortices(overrides: &[&str]) -> Assembled<2> {
    let base = ["numerics.spacing=0.04", "numerics.jitter=0.2"];
    let all: Vec<&str> = base.iter().chain(overrides).copied().collect();
    shipped("taylor-green-2d", &all)
}

/// Moves the initial state; the lists are built anew.
fn transformed(
    mut parts: Assembled<2>,
    position: impl Fn(&Vect<2>) -> Vect<2>,
    velocity: impl Fn(&Vect<2>) -> Vect<2>,
) -> Assembled<2> {
    let free = &mut parts.flow.world.free;
    for x in free.get_mut(fields::POSITION).unwrap() {
        *x = position(x);
    }
    for u in free.get_mut(fields::VELOCITY).unwrap() {
        *u = velocity(u);
    }
    parts.flow.world.rebuild_lists().unwrap();
    parts
}

/// Positions and velocities after the steps, by the particles' numbers.
fn flown(mut parts: Assembled<2>) -> States {
    fly(&mut parts, STEPS, Some(DT));
    states(&parts)
}

/// Largest difference of velocities, m/s, after `back` has undone the transformation.
fn apart(
    plain: &[(Vect<2>, Vect<2>)],
    other: &[(Vect<2>, Vect<2>)],
    back: impl Fn(&Vect<2>) -> Vect<2>,
) -> f64 {
    assert_eq!(plain.len(), other.len());
    let pairs = plain.iter().zip(other);
    pairs.fold(0.0, |most: f64, (a, b)| most.max((a.1 - back(&b.1)).norm()))
}

/// Rounding of 1e-16 at speeds of 1 to 10 m/s, a pressure stiffness c² = 100 that turns it into
/// accelerations, and a hundred steps that may double it a few times: 7e-15 to 9e-15 was measured after fifty.
const ROUNDING: f64 = 1e-12;

#[test]
fn the_flow_does_something() {
    let end = flown(vortices(&[]));
    let start = states(&vortices(&[]));
    let moved = apart(&start, &end, |u| *u);
    assert!(moved > 0.1, "velocities change by {moved} m/s");
}

#[test]
fn a_uniform_velocity_on_top_changes_nothing_else() {
    let wind = Vect::<2>::new(3.7, -1.9);
    let plain = flown(vortices(&[]));
    let carried = flown(transformed(vortices(&[]), |x| *x, |u| u + wind));
    let most = apart(&plain, &carried, |u| u - wind);
    assert!(most < ROUNDING, "{most:e} m/s");
}

#[test]
fn the_mirror_image_flows_as_the_mirror_image() {
    let flip = |u: &Vect<2>| Vect::<2>::new(-u[0], u[1]);
    let plain = flown(vortices(&[]));
    let image = flown(transformed(
        vortices(&[]),
        |x| Vect::<2>::new(1.0 - x[0], x[1]),
        flip,
    ));
    let most = apart(&plain, &image, flip);
    assert!(most < ROUNDING, "{most:e} m/s");
}
