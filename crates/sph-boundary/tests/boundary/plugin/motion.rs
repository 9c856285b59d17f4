//! Walls that move: where they are, how fast, and that γ is that of a wall drawn there.

use std::sync::Arc;

use sph_boundary::{Bend, Course, Polyline, RigidMotion, Rotation};
use sph_core::Vect;

use crate::bench::{Bench, Random, fixed_line, wide};

/// A tilted block of 2 × 1 around the origin; h = 1. The fluid is outside.
fn block() -> Polyline {
    let corners = vec![[-1.0, -0.5], [-1.0, 0.5], [1.0, 0.5], [1.0, -0.5]];
    Polyline::closed("block", corners)
}

fn motion() -> RigidMotion {
    RigidMotion {
        rotation: Some(Rotation {
            centre: [0.2, 0.1],
            axis: [0.0; 3],
            course: Course::Steady { speed: 0.7 },
        }),
        start: 0.5,
        stop: 3.0,
        ..RigidMotion::steady([0.3, -0.2])
    }
}

/// Particles all round, where the block never comes.
fn around() -> Vec<Vect<2>> {
    let mut random = Random::new(3);
    let places =
        (0..400).map(|_| Vect::<2>::new(random.between(-4.0, 4.0), random.between(-4.0, 4.0)));
    places.filter(|x| x.norm() > 2.2).collect()
}

fn moving(name: &str, time: f64) -> Bench<2> {
    let mut spec = fixed_line(block());
    spec.motion = motion();
    let mut bench = Bench::new(name, &[spec], 0.5, wide(), around());
    bench.move_to(time);
    bench
}

fn drawn_there(name: &str, time: f64) -> Bench<2> {
    let map = motion().pose(time).map();
    let mut moved = block();
    moved.points = moved.points.iter().map(|p| map(*p)).collect();
    Bench::new(name, &[fixed_line(moved)], 0.5, wide(), around())
}

fn farthest(a: &[Vect<2>], b: &[Vect<2>]) -> f64 {
    assert_eq!(a.len(), b.len());
    let apart = a.iter().zip(b).map(|(a, b)| (a - b).norm());
    apart.fold(0.0, f64::max)
}

#[test]
fn a_moved_wall_is_the_wall_drawn_there_gamma_to_1e_13() {
    for time in [0.0, 0.4, 1.1, 3.0, 7.0] {
        let (moved, drawn) = (moving("usaw", time), drawn_there("usaw", time));
        let (a, b) = (&moved.world.walls, &drawn.world.walls);
        // Positions of a few metres, rotated once: some 1e-15.
        assert!(farthest(&a.points.position, &b.points.position) < 1e-14);
        assert!(farthest(&a.elements.centre, &b.elements.centre) < 1e-14);
        assert!(farthest(&a.elements.normal, &b.elements.normal) < 1e-14);
        assert_eq!(moved.positions(), drawn.positions(), "the particles stayed");
        let pairs = moved.gamma().iter().zip(drawn.gamma());
        let worst = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-13, "t = {time}: γ differs by {worst:e}");
        let near = moved.gamma().iter().filter(|g| **g < 0.999).count();
        assert!(near > 10, "t = {time}: only {near} particles see the wall");
    }
}

#[test]
fn dummies_of_a_moved_wall_moved_with_it() {
    for time in [0.4, 1.1, 7.0] {
        let moved = moving("dummy-particles", time);
        let rest = moving("dummy-particles", 0.0);
        let map = motion().pose(time).map();
        let positions = rest.world.walls.points.position.iter();
        let expected: Vec<Vect<2>> = positions.map(|x| map([x[0], x[1]]).into()).collect();
        assert!(farthest(&moved.world.walls.points.position, &expected) < 1e-14);
    }
}

#[test]
fn the_velocity_of_a_moving_wall_is_the_rate_of_its_position() {
    let step = 1e-5;
    for name in ["usaw", "dummy-particles"] {
        for time in [0.2, 1.1, 5.0] {
            let bench = moving(name, time);
            let (before, after) = (moving(name, time - step), moving(name, time + step));
            let points = &bench.world.walls.points;
            for v in 0..points.position.len() {
                let at = |b: &Bench<2>| b.world.walls.points.position[v];
                let rate = (at(&after) - at(&before)) / (2.0 * step);
                // Truncation ω³ r Δt²/6 ≈ 1e-11, rounding 1e-15/1e-5.
                let error = (rate - points.velocity[v]).norm();
                assert!(error < 1e-9, "{name}, t = {time}: {error:e}");
            }
            let elements = &bench.world.walls.elements;
            for s in 0..elements.centre.len() {
                let at = |b: &Bench<2>| b.world.walls.elements.centre[s];
                let rate = (at(&after) - at(&before)) / (2.0 * step);
                let error = (rate - elements.velocity[s]).norm();
                assert!(error < 1e-9, "{name}, t = {time}: element {error:e}");
            }
        }
    }
}

#[test]
fn a_belt_has_the_velocity_of_its_surface_and_stays() {
    let mut spec = fixed_line(block());
    spec.surface_velocity = Vect::<2>::new(1.5, 0.0);
    let mut bench = Bench::new("usaw", &[spec], 0.5, wide(), around());
    let before = bench.world.walls.points.position.clone();
    bench.move_to(2.0);
    let walls = &bench.world.walls;
    assert_eq!(walls.points.position, before);
    let belt = Vect::<2>::new(1.5, 0.0);
    assert!(walls.points.velocity.iter().all(|u| *u == belt));
    assert!(walls.elements.velocity.iter().all(|u| *u == belt));
}

/// The block sheared upwards: its left end rises, its right end sinks.
fn bent() -> RigidMotion {
    RigidMotion {
        bend: Some(Arc::new(Bend {
            places: vec![-1.0, 1.0],
            lifts: [0.06, -0.04].map(|speed| Course::Steady { speed }).into(),
        })),
        ..RigidMotion::default()
    }
}

fn bending(name: &str, time: f64) -> Bench<2> {
    let mut spec = fixed_line(block());
    spec.motion = bent();
    let mut bench = Bench::new(name, &[spec], 0.5, wide(), around());
    bench.move_to(time);
    bench
}

#[test]
fn a_bent_wall_is_the_wall_drawn_so_with_its_angles_and_lengths() {
    for time in [0.0, 0.7, 1.9] {
        let mut shape = block();
        let lift = |x: f64| time * (0.01 - 0.05 * x);
        shape.points.iter_mut().for_each(|p| p[1] += lift(p[0]));
        let drawn = Bench::new("usaw", &[fixed_line(shape)], 0.5, wide(), around());
        let moved = bending("usaw", time);
        let (a, b) = (&moved.world.walls, &drawn.world.walls);
        assert!(farthest(&a.points.position, &b.points.position) < 1e-14);
        assert!(farthest(&a.elements.centre, &b.elements.centre) < 1e-14);
        assert!(farthest(&a.elements.normal, &b.elements.normal) < 1e-14);
        let worst = |a: &[f64], b: &[f64]| {
            let apart = a.iter().zip(b).map(|(a, b)| (a - b).abs());
            apart.fold(0.0, f64::max)
        };
        let lengths = worst(&a.elements.measure, &b.elements.measure);
        let shares = worst(&a.points.share, &b.points.share);
        let gammas = worst(moved.gamma(), drawn.gamma());
        let all = [lengths, shares, gammas];
        assert!(
            all.iter().all(|d| *d < 1e-13),
            "t = {time}: lengths, shares, γ off by {all:?}"
        );
    }
}

#[test]
fn the_velocity_of_a_bending_wall_is_the_rate_of_its_position() {
    let step = 1e-3;
    for name in ["usaw", "dummy-particles"] {
        let at = |time: f64| bending(name, time).world.walls;
        let (before, here, after) = (at(1.0 - step), at(1.0), at(1.0 + step));
        let places = before.points.position.iter().zip(&after.points.position);
        for ((a, b), velocity) in places.zip(&here.points.velocity) {
            // Lifts are linear in time: nothing but rounding, 1e-15/1e-3.
            let error = ((b - a) / (2.0 * step) - velocity).norm();
            assert!(error < 1e-11, "{name}: {error:e}");
        }
    }
}
