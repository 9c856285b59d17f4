//! What the operators leave alone: momentum, uniform pressure, uniform velocity. 2D and 3D.

use sph_core::{Role, Vect, fields};
use sph_neighbours::World;

use crate::evaluate::{acceleration, pressure, viscosity, viscosity_column};
use crate::world::{Random, disorder, longest, periodic, set, set_velocity, world};

/// Σ m a over Σ m |a|.
pub fn imbalance<const D: usize>(world: &World<D>, acceleration: &[Vect<D>]) -> f64 {
    let mass = world.free.get(fields::MASS).unwrap();
    let forces = || acceleration.iter().zip(mass).map(|(a, m)| a * *m);
    let scale: f64 = forces().map(|f| f.norm()).sum();
    assert!(scale > 0.0, "there are forces");
    forces().sum::<Vect<D>>().norm() / scale
}

/// Shaken particles of two densities with random pressures, volumes, velocities, viscosities.
pub fn cloud<const D: usize>(n: usize, ratio: f64, seed: u64) -> World<D> {
    let positions = disorder::<D>(n, 0.3, seed);
    let mut cloud = world(positions, periodic(), 1.0 / n as f64, ratio);
    let mut random = Random::new(seed + 1);
    let cell = (n as f64).powi(-(D as i32));
    cloud.free.add(fields::VISCOSITY, Role::State);
    set(&mut cloud, fields::VOLUME, |_| {
        cell * random.between(0.8, 1.2)
    });
    set(&mut cloud, fields::DENSITY, |x| {
        if x[0] < 0.5 { 1000.0 } else { 1.2 }
    });
    set(&mut cloud, fields::PRESSURE, |_| random.between(-3.0, 10.0));
    set(&mut cloud, fields::VISCOSITY, |x| {
        if x[0] < 0.5 { 1e-3 } else { 2e-5 }
    });
    set_velocity(&mut cloud, |_| {
        Vect::from_fn(|_, _| random.between(-1.0, 1.0))
    });
    let free = &cloud.free;
    let (volume, density) = free.all((fields::VOLUME, fields::DENSITY)).unwrap();
    let mass = volume.iter().zip(density).map(|(v, rho)| v * rho).collect();
    *cloud.free.get_mut(fields::MASS).unwrap() = mass;
    cloud
}

fn conserves<const D: usize>(cloud: &World<D>) {
    for (name, term) in [
        ("pressure", pressure()),
        ("uniform viscosity", viscosity(0.1)),
        ("viscosity of two phases", viscosity_column()),
    ] {
        let sum = imbalance(cloud, &acceleration(cloud, term));
        // Every pair cancels but for rounding: 1e-16 per term, some 1e4 terms of random sign.
        assert!(sum < 1e-13, "{name} in {D}D: Σ m a / Σ m |a| = {sum:e}");
    }
}

#[test]
fn pressure_and_viscosity_conserve_momentum_to_1e_13_in_2d_and_3d() {
    (1..5).for_each(|seed| conserves(&cloud::<2>(24, 2.0, seed)));
    conserves(&cloud::<3>(12, 1.3, 9));
}

/// Without walls γ is 1 everywhere, so m a needs no weight; a wrong sign must be seen.
#[test]
fn an_operator_that_is_not_skew_would_be_caught() {
    let cloud = cloud::<2>(24, 2.0, 1);
    let mut wrong = acceleration(&cloud, pressure());
    wrong[0] *= 1.001;
    assert!(imbalance(&cloud, &wrong) > 1e-9);
}

fn leaves_uniform_fields_alone<const D: usize>(n: usize, ratio: f64) {
    let mut cloud = cloud::<D>(n, ratio, 4);
    set(&mut cloud, fields::PRESSURE, |_| 0.0);
    let wind = Vect::from_fn(|k, _| 3.0 - k as f64);
    set_velocity(&mut cloud, |_| wind);
    // Differences of equal numbers: not small, but nothing.
    for term in [pressure(), viscosity(0.1), viscosity_column()] {
        let name = term.name();
        assert_eq!(longest(&acceleration(&cloud, term)), 0.0, "{name}");
    }
}

#[test]
fn zero_pressure_and_uniform_velocity_give_exactly_no_acceleration() {
    leaves_uniform_fields_alone::<2>(24, 2.0);
    leaves_uniform_fields_alone::<3>(12, 1.3);
}

/// Work of the pressure equals what the density sum takes up: −Σ m a·u = Σ p dV/dt.
#[test]
fn the_pressure_gradient_is_skew_adjoint_to_the_density_sum_to_1e_12() {
    let cloud = cloud::<2>(24, 2.0, 2);
    let free = &cloud.free;
    let (x, u) = free.all((fields::POSITION, fields::VELOCITY)).unwrap();
    let (p, v) = free.all((fields::PRESSURE, fields::VOLUME)).unwrap();
    let mass = free.get(fields::MASS).unwrap();
    let force = acceleration(&cloud, pressure());
    let work: f64 = (0..x.len()).map(|i| mass[i] * force[i].dot(&u[i])).sum();
    // With 1/V = Σ w the volume changes at −V² Σ u_ab·∇w_ab.
    let mut taken_up = 0.0;
    for a in 0..x.len() {
        for b in 0..x.len() {
            let apart = cloud.domain.nearest_image(x[a] - x[b]);
            let factor = cloud.kernel.at(apart.norm()).1;
            taken_up -= p[a] * v[a] * v[a] * (u[a] - u[b]).dot(&apart) * factor;
        }
    }
    let error = (work - taken_up).abs() / work.abs();
    assert!(error < 1e-12, "{work} {taken_up}: {error:e}");
}
