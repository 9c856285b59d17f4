//! No fast particle gets through a wall in space.

use std::f64::consts::TAU;

use sph_boundary::{Surface, WallSpec};
use sph_core::{Vect, fields};

use crate::bench::{Bench, Random, wide};
use crate::spatial_plugin::shapes::{block, prism, pyramid, tank, wall};

const SPACING: f64 = 0.5;
const SPEED: f64 = 10.0;
/// Steps in which a particle flies 1/5 and 3/5 spacings; a step of the solver is below 1/10.
const SHORT: [f64; 2] = [0.01, 0.03];
/// The same and three spacings.
const LONG: [f64; 3] = [0.01, 0.03, 0.15];
const SHOTS: usize = 400;

/// Whether the way from a to b crosses a triangle.
fn crosses(a: &Vect<3>, b: &Vect<3>, [p, q, r]: &[Vect<3>; 3]) -> bool {
    let normal = (q - p).cross(&(r - p));
    let (from, to) = (normal.dot(&(a - p)), normal.dot(&(b - p)));
    if from * to >= 0.0 {
        return false;
    }
    let at = a + (b - a) * (from / (from - to));
    let left = |p: &Vect<3>, q: &Vect<3>| normal.dot(&(q - p).cross(&(at - p))) > 0.0;
    left(p, q) && left(q, r) && left(r, p)
}

/// Flies three metres in steps from random places of a box, a third of the shots at `aims`;
/// returns how many went through the wall and how many it turned away.
fn flown(surface: &Surface, low: f64, high: f64, aims: &[Vect<3>], dt: f64) -> [usize; 2] {
    let walls = [WallSpec::at_rest(wall(surface.clone()))];
    let far = vec![Vect::repeat(50.0)];
    let probe = Bench::new("usaw", &walls, SPACING, wide(), far);
    let mut random = Random::new(11 + (1e4 * dt) as u64);
    let mut places: Vec<Vect<3>> = Vec::new();
    while places.len() < SHOTS {
        let x = random.point(low, high);
        let close = probe.wall.clearance(&x, 0.25 * SPACING).is_some();
        if probe.wall.contains(&x) && !close {
            places.push(x);
        }
    }
    let mut bench = Bench::new("usaw", &walls, SPACING, wide(), places);
    let positions = bench.positions().to_vec();
    let velocity = bench.world.free.get_mut(fields::VELOCITY).unwrap();
    for (k, (u, x)) in velocity.iter_mut().zip(&positions).enumerate() {
        let (angle, z) = (random.between(0.0, TAU), random.between(-1.0, 1.0));
        let across = (1.0 - z * z).sqrt();
        let any = Vect::from([across * angle.cos(), across * angle.sin(), z]);
        let towards = aims.get(k / 3 % aims.len().max(1)).filter(|_| k % 3 == 0);
        *u = towards.map_or(any, |aim| (aim - x).normalize()) * SPEED;
    }
    // Whoever is through carries a mark in a column, which is sorted with the particle.
    let corner = |c: u32| Vect::from(surface.points[c as usize]);
    let triangles: Vec<_> = surface.triangles.iter().map(|t| t.map(corner)).collect();
    for _ in 0..(3.0 / (SPEED * dt)).ceil() as usize {
        bench.wall.constrain(&mut bench.world, dt).unwrap();
        let velocity = bench.world.free.get(fields::VELOCITY).unwrap().to_vec();
        let before = bench.positions().to_vec();
        let positions = bench.world.free.get_mut(fields::POSITION).unwrap();
        for (x, u) in positions.iter_mut().zip(&velocity) {
            *x += u * dt;
        }
        let now = bench.positions().to_vec();
        let marks = bench.world.free.get_mut(fields::PRESSURE).unwrap();
        for (k, mark) in marks.iter_mut().enumerate() {
            let crossed = triangles.iter().any(|t| crosses(&before[k], &now[k], t));
            if crossed || !bench.wall.contains(&now[k]) {
                *mark = 1.0;
            }
        }
        bench.refresh();
    }
    let marks = bench.world.free.get(fields::PRESSURE).unwrap();
    let velocity = bench.world.free.get(fields::VELOCITY).unwrap();
    let turned = velocity.iter().filter(|u| u.norm() < 0.999 * SPEED);
    [marks.iter().filter(|m| **m > 0.0).count(), turned.count()]
}

fn no_particle_is_lost(
    what: &str,
    surface: &Surface,
    [low, high]: [f64; 2],
    aims: &[[f64; 3]],
    steps: &[f64],
) {
    let aims: Vec<_> = aims.iter().map(|a| Vect::from(*a)).collect();
    let (mut hits, mut lost_in_all) = (0, 0);
    for &dt in steps {
        let [lost, turned] = flown(surface, low, high, &aims, dt);
        println!("{what}: Δt = {dt} s: {lost} of {SHOTS} lost, {turned} turned");
        lost_in_all += lost;
        hits += turned;
    }
    assert_eq!(lost_in_all, 0, "{what}");
    assert!(hits > SHOTS * steps.len() / 5, "{what}: only {hits} hits");
}

#[test]
fn a_thousand_shots_into_the_corners_of_a_box_stay_in_it() {
    let corners = [[0.0; 3], [3.0; 3], [3.0, 0.0, 0.0], [0.0, 1.5, 3.0]];
    let room = tank([0.0; 3], [3.0; 3]);
    no_particle_is_lost("box", &room, [0.0, 3.0], &corners, &LONG);
}

#[test]
fn a_thousand_shots_at_a_pyramid_stay_outside() {
    // Its tip, an edge, a corner and an edge of its base, a face.
    let aims = [
        [0.0, 0.0, 1.2],
        [0.5, 0.5, 0.6],
        [1.0, 1.0, 0.0],
        [1.0, 0.2, 0.0],
        [0.5, 0.0, 0.6],
    ];
    no_particle_is_lost("pyramid", &pyramid(1.0, 1.2), [-2.0, 2.0], &aims, &LONG);
}

#[test]
fn a_thousand_shots_at_a_needle_stay_outside() {
    let aims = [[0.0, 0.0, 2.0], [0.1, 0.1, 1.0], [0.2, 0.2, 0.0]];
    no_particle_is_lost("needle", &pyramid(0.2, 2.0), [-1.5, 2.5], &aims, &LONG);
}

#[test]
fn a_thousand_shots_into_a_hollow_pyramid_stay_in_its_tip() {
    let aims = [[0.0, 0.0, 2.4], [0.6, 0.6, 1.8], [2.0, 2.0, 0.0]];
    let hollow = pyramid(2.0, 2.4).reversed();
    no_particle_is_lost("hollow pyramid", &hollow, [-2.0, 2.4], &aims, &SHORT);
}

#[test]
fn a_thousand_shots_at_thin_plates_stay_on_their_side() {
    let aims = [[0.0, 0.0, 0.0], [1.0, 0.3, 0.0], [1.0, 1.0, 0.0]];
    for thickness in [0.05, 0.001] {
        let half = 0.5 * thickness;
        let plate = block("plate", [-1.0, -1.0, -half], [1.0, 1.0, half]);
        let what = format!("plate of {thickness} m");
        no_particle_is_lost(&what, &plate, [-2.0, 2.0], &aims, &LONG);
    }
}

#[test]
fn a_thousand_shots_at_a_re_entrant_edge_and_an_acute_gap_stay_out_of_the_wall() {
    // A step, and over it a gap that closes at a fifth of a right angle.
    let outline = [
        [1.5, 1.5],
        [1.5, 0.0],
        [0.0, 0.0],
        [0.0, 3.0],
        [3.0, 2.0],
        [3.0, 1.5],
    ];
    let room = prism("room", &outline, [0.0, 3.0]).reversed();
    let aims = [
        [1.5, 1.5, 1.5],
        [3.0, 1.5, 1.5],
        [1.5, 0.0, 0.0],
        [0.0, 3.0, 3.0],
    ];
    no_particle_is_lost("room", &room, [0.0, 3.0], &aims, &SHORT);
}

#[test]
fn the_velocity_along_a_flat_wall_is_kept_wherever_the_particle_stands() {
    let mut random = Random::new(5);
    let slab = block("slab", [-3.0, -3.0, -2.0], [3.0, 3.0, 0.0]);
    for name in ["usaw", "dummy-particles"] {
        let height = |k: usize| SPACING * (0.25 + 0.05 * (k % 10) as f64);
        let place = |k: usize| Vect::from([0.013 * k as f64, 0.007 * k as f64, height(k)]);
        let places = (0..100).map(place).collect();
        let walls = [WallSpec::at_rest(wall(slab.clone()))];
        let mut bench = Bench::new(name, &walls, SPACING, wide(), places);
        for dt in [1.0, 3.0, 7.0, 20.0].map(|n| 0.1 * n * SPACING / SPEED) {
            let before = bench.world.free.get_mut(fields::VELOCITY).unwrap();
            for u in before.iter_mut() {
                *u = random.point(-SPEED, SPEED);
                u[2] = -u[2].abs();
            }
            let before = before.clone();
            bench.wall.constrain(&mut bench.world, dt).unwrap();
            let after = bench.world.free.get(fields::VELOCITY).unwrap();
            for ((u, now), x) in before.iter().zip(after).zip(bench.positions()) {
                let lowest = ((0.25 * SPACING - x[2]) / dt).min(0.0);
                let along = (now.xy() - u.xy()).norm();
                let across = (now[2] - u[2].max(lowest)).abs();
                assert!(along < 1e-12 && across < 1e-12, "{name}: {u} {now}");
            }
        }
    }
}
