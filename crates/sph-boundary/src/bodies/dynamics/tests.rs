//! Against closed forms, and what must stay.

use super::*;
use crate::bodies::catenary::tests::CHAIN;

fn body(free: [bool; 6]) -> Dynamics {
    Dynamics {
        mass: 2.0,
        centre: Vector3::new(0.1, 0.2, 0.3),
        inertia: Matrix3::from_diagonal(&Vector3::new(1.0, 2.0, 2.5)),
        layer: Matrix6::zeros(),
        free,
        holds: Vec::new(),
        lines: Vec::new(),
        start: 0.0,
        prescribed: Vec::new(),
    }
}

fn at_rest<const D: usize>(body: &Dynamics) -> RigidState<D> {
    RigidState {
        centre: std::array::from_fn(|k| body.centre[k]),
        ..RigidState::default()
    }
}

/// About the middle axis the turn is unstable, so that the body tumbles over and over: ten times here.
#[test]
fn a_body_that_tumbles_keeps_its_angular_momentum_and_its_energy() {
    let body = body([true; 6]);
    let mut state = at_rest::<3>(&body);
    state.angular_velocity = [0.01, 5.0, 0.02];
    let of = |state: &RigidState<3>| {
        let (turn, omega) = (rotation(state), Vector3::from(state.angular_velocity));
        let momentum = turn * body.inertia * turn.transpose() * omega;
        (momentum, 0.5 * momentum.dot(&omega), turn)
    };
    let (momentum, energy, _) = of(&state);
    let (mut over, mut before) = (0, 1.0);
    for _ in 0..60_000 {
        state = body.next(&state, &Load::of_gravity(Vect::zeros()), 0.0, 1e-3);
        let up = of(&state).2.column(1).y;
        over += u32::from(up * before < 0.0);
        before = up;
    }
    let (now, left, turn) = of(&state);
    assert!(over >= 5, "{over} times");
    let lost = (now - momentum).norm() / momentum.norm();
    assert!(lost < 1e-11, "angular momentum: {lost:e}");
    let drift = (left / energy - 1.0).abs();
    assert!(drift < 1e-5, "energy: {drift:e}");
    let skew = (turn.transpose() * turn - Matrix3::identity()).norm();
    assert!(skew < 1e-10, "R is a rotation to {skew:e}");
}

#[test]
fn locked_directions_rest_and_free_ones_follow_newton_and_euler() {
    let body = body([true, false, false, false, false, true]);
    let load = Load::<2> {
        force: Vect::<2>::new(3.0, 4.0),
        moment: [0.0, 0.0, 7.0],
        ..Load::of_gravity(Vect::<2>::new(1.0, -9.81))
    };
    let state = body.next(&at_rest(&body), &load, 0.0, 0.1);
    assert!((state.velocity[0] - 0.1 * (1.5 + 1.0)).abs() < 1e-15);
    assert_eq!(state.velocity[1], 0.0);
    // 7 − (0.1·4 − 0.2·3) about the centre.
    let about = 0.1 * (7.0 - 0.1 * 4.0 + 0.2 * 3.0) / 2.5;
    assert!((state.angular_velocity[2] - about).abs() < 1e-15);
    let early = Dynamics {
        start: 0.05,
        ..body.clone()
    };
    assert_eq!(early.next(&at_rest(&body), &load, 0.0, 0.1), at_rest(&body));
}

/// Free, held at what it has, driven up and free again: with F/m = 2 m/s² and steps that divide the times.
#[test]
fn a_body_is_free_and_prescribed_in_turns() {
    let turns = |from: f64, to: f64, course: Vec<Vec<f64>>| Prescribed { from, to, course };
    let up = vec![vec![2.0, 0.0, 1.0, 0.0], vec![3.0, 0.0, 3.0, 0.0]];
    let body = Dynamics {
        prescribed: vec![turns(1.0, 2.0, Vec::new()), turns(2.0, 3.0, up)],
        ..body([true; 6])
    };
    let load = Load::<2>::of_gravity(Vect::<2>::new(2.0, 0.0));
    let (dt, mut state) = (1.0 / 64.0, at_rest::<2>(&body));
    let mut seen = Vec::new();
    for step in 0..4 * 64 {
        state = body.next(&state, &load, f64::from(step) * dt, dt);
        if step % 64 == 63 {
            seen.push([state.velocity[0], state.velocity[1], state.acceleration[1]]);
        }
    }
    let expected = [
        [2.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [0.0, 3.0, 2.0],
        [2.0, 3.0, 0.0],
    ];
    for (seen, expected) in seen.into_iter().zip(expected) {
        let off = Vector3::from(seen) - Vector3::from(expected);
        assert!(off.amax() < 1e-12, "{seen:?}, not {expected:?}");
    }
    // Half a step beyond the mean of 1 and 3 m/s over the second that is driven, then a second at 3 m/s.
    let way = 2.0 + dt + 3.0;
    assert!((state.pose.translation[1] - way).abs() < 1e-12);
}

/// From a place beside its own it is back there after a period, in 20 000 steps; with steps of ten periods it stays bounded.
fn has_period(body: &Dynamics, period: f64, way: f64, most: f64) {
    let none = Load::<2>::of_gravity(Vect::zeros());
    let mut state = at_rest(body);
    state.pose.translation[0] = way;
    let steps = 20_000;
    for _ in 0..steps {
        state = body.next(&state, &none, 0.0, period / f64::from(steps));
    }
    let [x, _] = state.pose.translation;
    assert!((x / way - 1.0).abs() < most, "after a period at {x}");
    state.pose.translation[0] = 0.1;
    for _ in 0..200 {
        state = body.next(&state, &none, 0.0, 10.0 * period);
        let [x, _] = state.pose.translation;
        assert!(x.abs() <= 0.1, "at {x}");
    }
}

/// m = 2, k = 8: a period of π s.
#[test]
fn springs_have_their_period_and_never_bound_the_step() {
    let held = Dynamics {
        holds: vec![(Freedom::X, 8.0, 0.0)],
        ..body([true; 6])
    };
    has_period(&held, std::f64::consts::PI, 0.1, 1e-3);
}

/// F = F₀ − A ã, the force of a fluid at rest with the acceleration ã in its wall pressures. With the layer A* ≥ A
/// the body comes to F₀/(M + A) whatever its mass; without, every body lighter than A is thrown about.
#[test]
fn no_body_is_too_light_for_the_layer_and_without_it_those_below_the_added_mass_are() {
    let swings = |mass: f64, added: f64, layer: f64| {
        let body = Dynamics {
            mass,
            layer: Matrix6::identity() * layer,
            ..body([true, true, false, false, false, false])
        };
        let mut state = at_rest::<2>(&body);
        for _ in 0..20_000 {
            let felt = state.acceleration[0];
            let mut load = Load::of_gravity(Vect::zeros());
            load.force[0] = 1.0 - added * felt;
            state = body.next(&state, &load, 0.0, 1e-4);
        }
        state.acceleration[0] * (mass + added)
    };
    for mass in [100.0, 1.0, 0.1, 0.01] {
        for added in [0.0, 0.3, 1.0] {
            let end = swings(mass, added, 1.0);
            assert!((end - 1.0).abs() < 1e-3, "M = {mass}, A = {added}: {end}");
        }
    }
    assert!((swings(1.1, 1.0, 0.0) - 1.0).abs() < 1e-3);
    assert!(!swings(0.9, 1.0, 0.0).is_finite() || swings(0.9, 1.0, 0.0).abs() > 10.0);
}

/// m = 2 on two equal chains, one to either side: its period is 2π √(m/2k), k the horizontal stiffness of one.
#[test]
fn chains_have_their_period_and_never_bound_the_step() {
    let centre = Vector3::new(0.1, 0.2, 0.0);
    let chain = |way: f64| {
        let from = centre + Vector3::new(way, -0.6, 0.0);
        Mooring::chain(from, centre, CHAIN, Vector3::y())
    };
    let moored = Dynamics {
        centre,
        lines: vec![chain(-1.8), chain(1.8)],
        ..body([true, false, false, false, false, false])
    };
    let stiffness = 2.0 * CHAIN.hang(1.8, 0.6).stiffness[0][0];
    let period = std::f64::consts::TAU * (moored.mass / stiffness).sqrt();
    // The stiffness changes by a thousandth over the way.
    has_period(&moored, period, 1e-4, 2e-3);
}
