//! Dissipation of Riemann problems between particles.

use nalgebra::Matrix2;
use sph_core::{Role, Vect, fields};
use sph_multiphase::dissipation::Riemann;
use sph_neighbours::World;

use crate::evaluate::{laws, offered, rates};
use crate::world::{Random, disorder, open, periodic, set, set_phase, set_velocity, world};

/// Forces of a dissipation, for a heavy phase 0 and a light phase 1.
fn forces<const D: usize>(world: &World<D>, limiter: f64, linear: bool) -> Vec<Vect<D>> {
    let phases = (&laws(&[(1000.0, 20.0), (1.2, 30.0)]), true);
    let offer = offered(&mut Riemann { limiter, linear }, phases, world);
    let acceleration = rates(world, &offer.terms).0;
    let mass = world.free.get(fields::MASS).unwrap();
    let force = |(a, m): (&Vect<D>, &f64)| a * *m;
    acceleration.iter().zip(mass).map(force).collect()
}

fn power<const D: usize>(world: &World<D>, forces: &[Vect<D>]) -> f64 {
    let velocity = world.free.get(fields::VELOCITY).unwrap();
    forces.iter().zip(velocity).map(|(f, u)| f.dot(u)).sum()
}

/// Disordered particles of two phases that move at random, up to a speed.
fn agitated<const D: usize>(n: usize, speed: f64) -> World<D> {
    let mut cloud = world(disorder::<D>(n, 0.3, 4), periodic(), 1.0 / n as f64, 2.0);
    let cell = (n as f64).powi(-(D as i32));
    let density = |x: &Vect<D>| if x[0] < 0.5 { 1000.0 } else { 1.2 };
    set(&mut cloud, fields::DENSITY, density);
    set(&mut cloud, fields::MASS, |x| cell * density(x));
    set_phase(&mut cloud, |x| u32::from(x[0] >= 0.5));
    let mut random = Random::new(8);
    set_velocity(&mut cloud, |_| {
        Vect::from_fn(|_, _| random.between(-speed, speed))
    });
    cloud
}

fn momentum_is_kept_and_energy_taken<const D: usize>(n: usize) {
    let cloud = agitated::<D>(n, 3.0);
    let forces = forces(&cloud, 3.0, false);
    let (sum, all) = forces.iter().fold((Vect::zeros(), 0.0), |(sum, all), f| {
        (sum + f, all + f.norm())
    });
    assert!(sum.norm() < 1e-14 * all, "{} of {all} N", sum.norm());
    let power = power(&cloud, &forces);
    assert!(power < 0.0, "{power} W");
}

#[test]
fn riemann_dissipation_keeps_momentum_and_takes_energy() {
    momentum_is_kept_and_energy_taken::<2>(16);
    momentum_is_kept_and_energy_taken::<3>(8);
}

/// Of third order in the speed below c/η, of second beyond.
#[test]
fn the_limiter_leaves_slow_motion_alone() {
    let taken = |speed: f64, limiter: f64| {
        let cloud = agitated::<2>(16, speed);
        power(&cloud, &forces(&cloud, limiter, false))
    };
    for (limiter, order) in [(3.0, 3), (1e9, 2)] {
        let ratio = taken(0.1, limiter) / taken(0.05, limiter);
        let wanted = f64::from(1 << order);
        assert!((ratio / wanted - 1.0).abs() < 1e-9, "{ratio} for {wanted}");
    }
}

/// Two particles of 1000 kg/m³ that close at 0.5 m/s: p = ½ ρ c u (η u/c) = 375 Pa. None that part.
#[test]
fn two_particles_feel_the_pressure_of_their_riemann_problem() {
    let places = vec![Vect::<2>::new(0.0, 0.0), Vect::<2>::new(0.1, 0.0)];
    let mut pair = world(places, open(), 0.1, 2.0);
    set(&mut pair, fields::DENSITY, |_| 1000.0);
    set_phase(&mut pair, |_| 0);
    let slope = pair.kernel.at(0.1).1 * 0.1;
    for (towards, pressure) in [(1.0, 375.0), (-1.0, 0.0)] {
        set_velocity(&mut pair, |x| {
            Vect::<2>::new(if x[0] > 0.0 { -0.5 * towards } else { 0.0 }, 0.0)
        });
        let (force, volume) = (forces(&pair, 3.0, false)[0][0], 0.01_f64);
        let wanted = 2.0 * volume * volume * pressure * slope;
        assert!(
            (force - wanted).abs() <= 1e-12 * wanted.abs(),
            "{force} N for {wanted}"
        );
    }
}

/// Strain and compression, as a velocity gradient says them, are no noise.
#[test]
fn a_linear_velocity_is_left_alone() {
    let slope = Matrix2::new(-3.0, 1.0, 2.0, -0.5);
    let places = disorder::<2>(12, 0.3, 4);
    let mut cloud = world(places, open(), 1.0 / 12.0, 2.0);
    set(&mut cloud, fields::DENSITY, |_| 1000.0);
    set_phase(&mut cloud, |_| 0);
    set_velocity(&mut cloud, |x| slope * x);
    cloud.free.add(fields::VELOCITY_GRADIENT, Role::Derived);
    (cloud.free.get_mut(fields::VELOCITY_GRADIENT).unwrap()).fill(slope);
    let largest = |linear| {
        let all = forces(&cloud, 3.0, linear).into_iter();
        all.map(|f| f.norm()).fold(0.0, f64::max)
    };
    let (left, literal) = (largest(true), largest(false));
    assert!(left < 1e-13 * literal, "{left} N, {literal} N without");
}
