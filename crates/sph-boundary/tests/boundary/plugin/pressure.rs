//! The pressure that the fluid puts on the wall, and the volume it leaves there.

use sph_core::{Vect, fields};

use crate::bench::{Bench, over_a_flat_wall};

const GRAVITY: f64 = 9.81;
const DENSITY: f64 = 1000.0;

/// ρ g (H − y) with H = 5.
fn hydrostatic(x: &Vect<2>) -> f64 {
    DENSITY * GRAVITY * (5.0 - x[1])
}

/// Ten disordered rows under hydrostatic pressure.
fn tank(name: &str, offset: f64, gravity: f64) -> Bench<2> {
    let mut bench = over_a_flat_wall(name, 10, offset);
    let mut random = crate::bench::Random::new(7);
    for x in bench.world.free.get_mut(fields::POSITION).unwrap() {
        *x += random.point::<2>(-0.1, 0.1);
    }
    bench.refresh();
    bench.world.gravity = Vect::<2>::new(0.0, -gravity);
    bench.set(fields::DENSITY, |_| DENSITY);
    bench.set(fields::PRESSURE, hydrostatic);
    bench.wall.state(&mut bench.world).unwrap();
    bench
}

/// Largest relative error of the pressure on points, and on elements if there are any.
fn worst(bench: &Bench<2>) -> f64 {
    let walls = &bench.world.walls;
    let points = walls.points.position.iter().zip(&walls.points.pressure);
    let elements = walls.elements.centre.iter().zip(&walls.elements.pressure);
    let all = points.chain(elements);
    // Layers deeper than a support see no fluid at all.
    let seen = all.filter(|(_, p)| **p != 0.0);
    let error = |(x, p): (&Vect<2>, &f64)| (p / hydrostatic(x) - 1.0).abs();
    let errors: Vec<f64> = seen.map(error).collect();
    assert!(errors.len() >= 32, "{} places see the fluid", errors.len());
    errors.into_iter().fold(0.0, f64::max)
}

#[test]
fn a_hydrostatic_field_reaches_the_wall_exactly() {
    for (name, offset) in [("usaw", 0.0), ("dummy-particles", 0.5)] {
        let error = worst(&tank(name, offset, GRAVITY));
        // A mean of equal numbers: only rounding of about forty terms is left.
        assert!(error < 1e-14, "{name}: {error:e}");
    }
}

#[test]
fn without_gravity_in_the_mean_the_wall_is_ten_per_cent_off() {
    for (name, offset) in [("usaw", 0.0), ("dummy-particles", 0.5)] {
        let error = worst(&tank(name, offset, 0.0));
        // The fluid seen from the wall is on average half a smoothing length away, of H = 5 h.
        assert!(error > 0.1 && error < 0.5, "{name}: {error}");
    }
}

#[test]
fn a_driving_acceleration_leaves_the_wall_pressure_alone() {
    let still = tank("usaw", 0.0, GRAVITY);
    let mut driven = tank("usaw", 0.0, GRAVITY);
    driven.world.driving = Vect::<2>::new(3.0, -5.0);
    driven.wall.state(&mut driven.world).unwrap();
    let (a, b) = (&still.world.walls, &driven.world.walls);
    assert_eq!(a.points.pressure, b.points.pressure);
    assert_eq!(a.elements.pressure, b.elements.pressure);
}

#[test]
fn the_volume_at_the_wall_is_the_mean_of_the_fluid_and_a_cell_without_fluid() {
    let mut bench = over_a_flat_wall("usaw", 10, 0.0);
    bench.set(fields::VOLUME, |_| 0.3);
    bench.wall.state(&mut bench.world).unwrap();
    for v in &bench.world.walls.points.volume {
        assert!((v - 0.3).abs() < 1e-15, "{v}");
    }
    // No particle in reach of the floor: one whole cell and no pressure.
    let mut dry = over_a_flat_wall("usaw", 10, 0.0);
    let positions = dry.world.free.get_mut(fields::POSITION).unwrap();
    positions.iter_mut().for_each(|x| x[1] += 20.0);
    dry.refresh();
    dry.set(fields::PRESSURE, |_| 4.0);
    dry.wall.state(&mut dry.world).unwrap();
    assert_eq!(dry.world.walls.points.volume, vec![0.25; 16]);
    assert_eq!(dry.world.walls.points.pressure, vec![0.0; 16]);
    assert_eq!(dry.world.walls.elements.pressure, vec![0.0; 16]);
}

#[test]
fn dummies_mirror_the_velocity_of_the_fluid() {
    let mut bench = over_a_flat_wall("dummy-particles", 10, 0.5);
    let velocity = Vect::<2>::new(0.7, -0.2);
    let velocities = bench.world.free.get_mut(fields::VELOCITY).unwrap();
    velocities.fill(velocity);
    bench.wall.state(&mut bench.world).unwrap();
    let points = &bench.world.walls.points;
    for (x, u) in points.position.iter().zip(&points.viscous_velocity) {
        // 2 u_wall − mean(u_f), zero where no fluid is near (the last row, 2h deep and more).
        let seen = if x[1] > -1.5 { 1.0 } else { 0.0 };
        assert!((u + velocity * seen).norm() < 1e-15, "at {x}: {u}");
    }
}
