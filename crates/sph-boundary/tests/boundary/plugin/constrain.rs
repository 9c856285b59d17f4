//! No lone particle gets through a wall, and nothing else is touched.

use sph_boundary::{Polyline, RigidMotion, thin_plate};
use sph_core::{Vect, fields};

use crate::bench::{Bench, Random, fixed_line, wide};

const SPACING: f64 = 0.5;
const SPEED: f64 = 10.0;
/// Steps in which the particle flies 1/17 to 3 spacings; a step of the solver is below 1/10.
const STEPS: [f64; 5] = [0.003, 0.01, 0.03, 0.07, 0.15];
const SHOTS: usize = 10_000;

/// Whether the way from a to b crosses the stretch from c to d.
fn crosses(a: Vect<2>, b: Vect<2>, c: Vect<2>, d: Vect<2>) -> bool {
    let side = |p: Vect<2>, q: Vect<2>, r: Vect<2>| (q - p).perp(&(r - p));
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

/// Shots from random places of a square, at least a quarter of a spacing from all walls.
fn shooters(wall: &Polyline, low: f64, high: f64, seed: u64) -> Bench<2> {
    let specs = [fixed_line(wall.clone())];
    let far = vec![Vect::repeat(50.0)];
    let probe = Bench::new("usaw", &specs, SPACING, wide(), far);
    let mut random = Random::new(seed);
    let mut places = Vec::new();
    while places.len() < SHOTS / STEPS.len() {
        let x = Vect::<2>::new(random.between(low, high), random.between(low, high));
        let close = probe.wall.clearance(&x, 0.25 * SPACING).is_some();
        if probe.wall.contains(&x) && !close {
            places.push(x);
        }
    }
    let mut bench = Bench::new("usaw", &specs, SPACING, wide(), places);
    let velocity = bench.world.free.get_mut(fields::VELOCITY).unwrap();
    for u in velocity {
        let angle = random.between(0.0, std::f64::consts::TAU);
        *u = SPEED * Vect::<2>::new(angle.cos(), angle.sin());
    }
    bench
}

/// Flies one way of four metres in steps; returns how many particles went through a wall.
fn lost(wall: &Polyline, low: f64, high: f64) -> Vec<(f64, usize)> {
    let edges: Vec<[Vect<2>; 2]> = wall.edges().map(|e| e.map(Vect::from)).collect();
    let mut losses = Vec::new();
    let mut turned = 0;
    for (k, dt) in STEPS.into_iter().enumerate() {
        let mut bench = shooters(wall, low, high, 11 + k as u64);
        let mut through = vec![false; SHOTS / STEPS.len()];
        for _ in 0..(4.0 / (SPEED * dt)).ceil() as usize {
            bench.wall.constrain(&mut bench.world, dt).unwrap();
            let velocity = bench.world.free.get(fields::VELOCITY).unwrap().to_vec();
            let before = bench.positions().to_vec();
            let positions = bench.world.free.get_mut(fields::POSITION).unwrap();
            for (x, u) in positions.iter_mut().zip(&velocity) {
                *x += u * dt;
            }
            for (i, x) in bench.positions().iter().enumerate() {
                let crossed = edges.iter().any(|[c, d]| crosses(before[i], *x, *c, *d));
                through[i] |= crossed || !bench.wall.contains(x);
            }
            bench.refresh_sorting(&mut through);
        }
        let slowed = bench.world.free.get(fields::VELOCITY).unwrap();
        turned += slowed.iter().filter(|u| u.norm() < 0.999 * SPEED).count();
        losses.push((dt, through.iter().filter(|t| **t).count()));
    }
    assert!(turned > SHOTS / 10, "only {turned} shots met a wall");
    losses
}

fn no_particle_is_lost(what: &str, wall: &Polyline, low: f64, high: f64) {
    let shots = SHOTS / STEPS.len();
    for (dt, lost) in lost(wall, low, high) {
        assert_eq!(lost, 0, "{what}: of {shots} shots with Δt = {dt} s");
    }
}

#[test]
fn ten_thousand_shots_at_a_flat_wall_stay_in_front_of_it() {
    let floor = Polyline::open("floor", vec![[-40.0, 0.0], [40.0, 0.0]]);
    no_particle_is_lost("flat wall", &floor, -2.0, 2.5);
}

#[test]
fn ten_thousand_shots_into_corners_stay_in_them() {
    let room = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    no_particle_is_lost("square", &Polyline::closed("room", room), 0.0, 4.0);
    let wedge = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 2.0]];
    let wedge = Polyline::closed("wedge", wedge);
    no_particle_is_lost("acute corner", &wedge, 0.0, 4.0);
    let octagon = (0..8).map(|k| {
        let angle = std::f64::consts::FRAC_PI_4 * f64::from(k);
        [2.0 * angle.cos(), 2.0 * angle.sin()]
    });
    let octagon = Polyline::closed("octagon", octagon.collect());
    no_particle_is_lost("obtuse corner", &octagon, -2.0, 2.0);
}

#[test]
fn ten_thousand_shots_at_a_re_entrant_corner_stay_outside() {
    let block = vec![[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]];
    no_particle_is_lost("block", &Polyline::closed("block", block), -3.0, 3.0);
    let blade = vec![[-1.0, -0.3], [0.0, 0.9], [1.0, -0.3]];
    no_particle_is_lost("blade", &Polyline::closed("blade", blade), -3.0, 3.0);
}

#[test]
fn ten_thousand_shots_at_a_thin_plate_stay_on_their_side() {
    for thickness in [0.0, 0.05] {
        let middle = [[-1.5, -0.5], [0.0, 0.2], [1.5, 0.2]];
        let plate = thin_plate("plate", &middle, thickness).unwrap();
        let what = format!("plate of {thickness} m");
        no_particle_is_lost(&what, &plate, -2.5, 2.5);
    }
}

/// One particle over a flat wall of both treatments.
fn over_the_floor(name: &str, height: f64, across: f64, velocity: Vect<2>) -> Bench<2> {
    let floor = Polyline::open("floor", vec![[-40.0, 0.0], [40.0, 0.0]]);
    let place = vec![Vect::<2>::new(across, height)];
    let mut bench = Bench::new(name, &[fixed_line(floor)], SPACING, wide(), place);
    bench.world.free.get_mut(fields::VELOCITY).unwrap()[0] = velocity;
    bench
}

fn velocity(bench: &Bench<2>) -> Vect<2> {
    bench.world.free.get(fields::VELOCITY).unwrap()[0]
}

#[test]
fn the_velocity_along_a_flat_wall_is_kept_wherever_the_particle_stands() {
    let mut random = Random::new(5);
    for name in ["usaw", "dummy-particles"] {
        for k in 0..1000 {
            // From the clearance itself upwards, over vertices and between them.
            let height = SPACING * (0.25 + 0.5 * (k % 10) as f64 / 10.0);
            let u = Vect::<2>::new(random.between(-SPEED, SPEED), random.between(-SPEED, 0.0));
            let mut bench = over_the_floor(name, height, random.next(), u);
            let dt = 0.1 * SPACING / SPEED * (1 + k % 20) as f64;
            bench.wall.constrain(&mut bench.world, dt).unwrap();
            let after = velocity(&bench);
            assert_eq!(after[0], u[0], "{name}: height {height}, u {u}, Δt {dt}");
            let lowest = ((0.25 * SPACING - height) / dt).min(0.0);
            let expected = u[1].max(lowest);
            // The impact is plastic: it ends at the clearance, to rounding of 10 m/s.
            let off = after[1] - expected;
            assert!(off.abs() < 1e-12, "{name}: {off} off {expected}");
        }
    }
}

#[test]
fn a_particle_at_rest_at_half_a_spacing_is_not_touched_by_a_bit() {
    for u in [
        Vect::zeros(),
        Vect::<2>::new(3.0, 0.0),
        Vect::<2>::new(1e-3, -1e-3),
        Vect::<2>::new(0.0, 5.0),
    ] {
        let mut bench = over_the_floor("usaw", 0.5 * SPACING, 0.1, u);
        bench.wall.constrain(&mut bench.world, 1e-3).unwrap();
        let after = velocity(&bench);
        assert_eq!(after.map(f64::to_bits), u.map(f64::to_bits));
    }
}

#[test]
fn a_wall_that_comes_takes_the_particle_along_at_its_own_speed() {
    let floor = Polyline::open("floor", vec![[-40.0, 0.0], [40.0, 0.0]]);
    let mut spec = fixed_line(floor);
    spec.motion = RigidMotion::steady([0.5, 2.0]);
    let place = vec![Vect::<2>::new(0.1, 0.25 * SPACING)];
    let mut bench = Bench::new("usaw", &[spec], SPACING, wide(), place);
    bench.wall.constrain(&mut bench.world, 1e-3).unwrap();
    // Its own tangential velocity stays; the normal one is the wall's.
    let u = velocity(&bench);
    assert!((u - Vect::<2>::new(0.0, 2.0)).norm() < 1e-14, "{u}");
}
