//! Forces between phases: repulsion and surface tension.

use sph_contribution::{Contribution, Offer};
use sph_core::{Role, Vect, fields};
use sph_multiphase::{
    COLOUR_GRADIENT, DISPERSED_FRACTION, GrenierInterface, InterfaceFriction, MicroMixing,
    SurfaceStress, SurfaceTension,
};
use sph_neighbours::World;

use crate::evaluate::{laws, offered, rates};
use crate::world::{
    Random, at, disorder, lattice, longest, open, periodic, set, set_phase, set_velocity, world,
};

const TENSION: f64 = 0.07;

fn tension(tension: f64) -> SurfaceTension {
    SurfaceTension {
        tension,
        stress: SurfaceStress::Full,
        contact_angle: None,
    }
}

/// The offer of a model for a heavy phase 0 and a light phase 1.
fn offer<const D: usize>(world: &World<D>, model: &mut dyn Contribution<D>) -> Offer<D> {
    offered(model, (&laws(&[(1000.0, 30.0), (1.2, 30.0)]), true), world)
}

/// Densities, masses and phases by their places.
fn set_light<const D: usize>(world: &mut World<D>, light: impl Fn(&Vect<D>) -> bool) {
    let cell = world.spacing.powi(D as i32);
    let density = |x: &Vect<D>| if light(x) { 1.2 } else { 1000.0 };
    set(world, fields::DENSITY, density);
    set(world, fields::MASS, |x| cell * density(x));
    set_phase(world, |x| u32::from(light(x)));
}

fn all<const D: usize>() -> [(&'static str, Box<dyn Contribution<D>>); 4] {
    [
        ("micro-mixing", Box::new(MicroMixing::default())),
        ("grenier", Box::new(GrenierInterface::default())),
        ("surface-tension", Box::new(tension(TENSION))),
        (
            "artificial-viscosity",
            Box::new(InterfaceFriction::default()),
        ),
    ]
}

fn force<const D: usize>(world: &mut World<D>, model: &mut dyn Contribution<D>) -> Vec<Vect<D>> {
    world.free.add(COLOUR_GRADIENT, Role::Derived);
    scatter(world, model);
    let acceleration = rates(world, &offer(world, model).terms).0;
    let mass = world.free.get(fields::MASS).unwrap();
    let forces = acceleration.iter().zip(mass).map(|(a, m)| a * *m);
    forces.collect()
}

/// Runs what a model must know before the sweep.
fn scatter<const D: usize>(world: &mut World<D>, model: &mut dyn Contribution<D>) {
    world.free.add(DISPERSED_FRACTION, Role::Derived);
    for mut stage in offer(world, model).stages {
        stage.run(world).unwrap();
    }
}

fn momentum_is_kept<const D: usize>(n: usize, ratio: f64) {
    let mut cloud = world(disorder::<D>(n, 0.3, 1), periodic(), 1.0 / n as f64, ratio);
    let mut random = Random::new(2);
    let cell = (n as f64).powi(-(D as i32));
    let mut volume = || cell * random.between(0.8, 1.2);
    set(&mut cloud, fields::VOLUME, |_| volume());
    set(&mut cloud, fields::PRESSURE, |_| random.between(-3.0, 10.0));
    let mass = |x: &Vect<D>| cell * if x[0] < 0.5 { 1000.0 } else { 1.2 };
    set(&mut cloud, fields::MASS, mass);
    let middle = Vect::<D>::repeat(0.5);
    set_phase(&mut cloud, |x| u32::from((x - middle).norm() < 0.3));
    let wave = |x: &Vect<D>, k: usize| (7.0 * x[k] + x[(k + 1) % D]).sin();
    set_velocity(&mut cloud, |x| Vect::from_fn(|k, _| wave(x, k)));
    for (name, mut model) in all::<D>() {
        let forces = force(&mut cloud, &mut *model);
        let scale: f64 = forces.iter().map(|f| f.norm()).sum();
        let sum = forces.iter().sum::<Vect<D>>().norm();
        // Pairs cancel to rounding.
        assert!(
            scale > 0.0 && sum < 1e-13 * scale,
            "{name} in {D}D: {sum:e} of {scale:e}"
        );
    }
}

#[test]
fn they_conserve_momentum_to_1e_13_in_2d_and_3d() {
    momentum_is_kept::<2>(24, 2.0);
    momentum_is_kept::<3>(12, 1.3);
}

#[test]
fn one_phase_feels_nothing() {
    let mut cloud = world(disorder::<2>(20, 0.3, 1), periodic(), 0.05, 2.0);
    set(&mut cloud, fields::PRESSURE, |x| x[0] - 0.3);
    set_phase(&mut cloud, |_| 1);
    for (name, mut model) in all::<2>() {
        assert_eq!(longest(&force(&mut cloud, &mut *model)), 0.0, "{name}");
    }
}

/// Also at negative pressure.
#[test]
fn repulsions_push_phases_apart_and_leave_a_phase_alone() {
    for (sign, second) in [(1.0, 1), (-1.0, 1), (1.0, 0)] {
        let pair = vec![Vect::<2>::new(0.0, 0.0), Vect::<2>::new(0.05, 0.0)];
        let mut pair = world(pair, open(), 0.05, 2.0);
        set(&mut pair, fields::PRESSURE, |_| sign * 100.0);
        set_phase(&mut pair, |x| if x[0] > 0.01 { second } else { 0 });
        for (name, mut model) in all::<2>().into_iter().take(2) {
            let forces = force(&mut pair, &mut *model);
            match second {
                0 => assert_eq!(forces[0].norm(), 0.0, "{name}"),
                _ => assert!(
                    forces[0][0] < 0.0 && forces[1][0] > 0.0,
                    "{name}: {forces:?}"
                ),
            }
        }
    }
}

/// The force integrated along a radius is the pressure jump: Σ m a·e_r / (surface of radius r).
fn jump<const D: usize>(world: &mut World<D>, radius: f64) -> f64 {
    let middle = Vect::<D>::repeat(0.5);
    set_phase(world, |x| u32::from((x - middle).norm() < radius));
    let forces = force(world, &mut tension(TENSION));
    let positions = world.free.get(fields::POSITION).unwrap();
    let surface = |r: f64| match D {
        2 => std::f64::consts::TAU * r,
        _ => 2.0 * std::f64::consts::TAU * r * r,
    };
    let inward = positions.iter().zip(&forces).map(|(x, f)| {
        let r = (x - middle).norm();
        -f.dot(&(x - middle)) / r / surface(r)
    });
    inward.sum()
}

#[test]
fn a_round_drop_has_the_jump_of_laplace() {
    let n = 60;
    let mut plane = world(lattice::<2>(n), periodic(), 1.0 / n as f64, 2.0);
    let mut measured = Vec::new();
    for radius in [0.2, 0.3, 0.4] {
        measured.push(jump(&mut plane, radius) * radius / TENSION);
    }
    let n = 30;
    let mut space = world(lattice::<3>(n), periodic(), 1.0 / n as f64, 1.5);
    measured.push(jump(&mut space, 0.3) * 0.3 / (2.0 * TENSION));
    // Measured: 1.002, 0.996, 0.992; a staircase of cells is not a circle. In 3D 1.001.
    let met = measured.iter().all(|m| (m - 1.0).abs() < 0.01);
    assert!(met, "{measured:?}");
}

#[test]
fn a_flat_interface_is_at_rest_and_without_a_trace_has_a_pressure_of_its_own() {
    let n = 20;
    let mut layers = world(lattice::<2>(n), periodic(), 1.0 / n as f64, 2.0);
    set_phase(&mut layers, |x| u32::from(x[1] < 0.5));
    let full = longest(&force(&mut layers, &mut tension(TENSION)));
    let mut trace_free = SurfaceTension {
        stress: SurfaceStress::TraceFree,
        ..tension(TENSION)
    };
    let forces = force(&mut layers, &mut trace_free);
    let along = forces.iter().map(|f| f[0].abs()).fold(0.0, f64::max);
    let across = forces.iter().map(|f| f[1].abs()).fold(0.0, f64::max);
    // The isotropic part that is left out of the stress pushes across; nothing pushes along.
    assert!(full < 1e-12 * across, "{full:e} of {across:e}");
    assert!(along < 1e-12 * across, "{along:e} of {across:e}");
    let sum: f64 = forces.iter().map(|f| f[1]).sum();
    assert!(sum.abs() < 1e-12 * across * n as f64, "{sum:e}");
}

#[test]
fn the_capillary_limit_has_the_least_density() {
    let mut drop = world(lattice::<2>(10), periodic(), 0.1, 2.0);
    set(&mut drop, fields::DENSITY, |x| {
        if x[0] < 0.5 { 1000.0 } else { 4.0 }
    });
    let limiters = |strength: f64| offer(&drop, &mut tension(strength)).limiters;
    let dt = limiters(TENSION)[0].limit(&drop).unwrap().dt;
    let exact = 0.25 * (4.0 * 0.2_f64.powi(3) / (std::f64::consts::TAU * TENSION)).sqrt();
    assert!((dt / exact - 1.0).abs() < 1e-12, "{dt} {exact}");
    assert!(limiters(0.0).is_empty());
}

/// A lone light particle moves at 1 m/s through heavy ones at rest: it is stopped at the rate whose inverse
/// bounds the step.
#[test]
fn artificial_viscosity_stops_a_light_particle_at_the_rate_of_its_limit() {
    let n = 20;
    let mut cloud = world(lattice::<2>(n), periodic(), 1.0 / n as f64, 2.0);
    let middle = at(&cloud, Vect::repeat(0.5));
    let place = cloud.free.get(fields::POSITION).unwrap()[middle];
    set_light(&mut cloud, |x| *x == place);
    let mut model = InterfaceFriction::default();
    let offer = offer(&cloud, &mut model);
    let inverse_limit = 1.0 / offer.limiters[0].limit(&cloud).unwrap().dt;
    scatter(&mut cloud, &mut model);
    cloud.free.get_mut(fields::VELOCITY).unwrap()[middle][0] = 1.0;
    let slowed = -rates(&cloud, &offer.terms).0[middle][0];
    // α c̄ = 60 m/s, β at the closing half of the pairs less than 1 m/s; the limit has α + β.
    let alone = slowed * (model.strength + model.shocks) / model.strength;
    let ratio = alone / inverse_limit;
    assert!(
        (1.0..1.1).contains(&ratio),
        "{slowed:.1}/s against 1/limit = {inverse_limit:.1}/s: {ratio:.3} without β"
    );
}

/// Pairs of the heaviest phase are left alone; nothing ever gains energy.
#[test]
fn artificial_viscosity_only_takes_energy_and_leaves_the_heavy_phase_alone() {
    let n = 24;
    let mut cloud = world(disorder::<2>(n, 0.3, 5), periodic(), 1.0 / n as f64, 2.0);
    set_light(&mut cloud, |x| x[0] > 0.5);
    let mut random = Random::new(9);
    let mut draw = || 40.0 * (random.next() - 0.5);
    set_velocity(&mut cloud, |_| Vect::<2>::new(draw(), draw()));
    let moving = cloud.free.get(fields::VELOCITY).unwrap().to_vec();
    let place = cloud.free.get(fields::POSITION).unwrap().to_vec();
    let forces = force(&mut cloud, &mut InterfaceFriction::default());
    let power: f64 = forces.iter().zip(&moving).map(|(f, u)| f.dot(u)).sum();
    assert!(power < 0.0, "{power} W");
    let far = place.iter().zip(&forces);
    let mut far = far.filter(|(x, _)| x[0] > 0.2 && x[0] < 0.3);
    assert!(far.all(|(_, f)| f.norm() == 0.0));
}

/// What lies at a closed interface slides freely: friction is for light particles that are alone.
#[test]
fn light_particles_at_a_closed_interface_are_not_scattered() {
    let n = 20;
    let mut cloud = world(lattice::<2>(n), periodic(), 1.0 / n as f64, 2.0);
    let lone = Vect::<2>::repeat(0.25 - 0.5 / n as f64);
    set_light(&mut cloud, |x| x[0] > 0.5 || (x - lone).norm() < 1e-9);
    scatter(&mut cloud, &mut InterfaceFriction::default());
    let place = cloud.free.get(fields::POSITION).unwrap();
    let dispersed_fraction = cloud.free.get(DISPERSED_FRACTION).unwrap();
    for (x, s) in place.iter().zip(dispersed_fraction) {
        let wanted = f64::from((x - lone).norm() < 1e-9);
        assert_eq!(*s, wanted, "{x}");
    }
}
