//! What every formulation promises: adjoint operators, momentum, constants left alone.

use sph_core::{Role, Vect, fields};
use sph_multiphase::{ColagrossiLandrini, Continuity, Formulation, Grenier, HuAdams, Krimi};
use sph_neighbours::World;

use crate::conservation::{cloud, imbalance};
use crate::evaluate::rates;
use crate::world::{at, disorder, lattice, open, set, set_velocity, world};

fn all<const D: usize>() -> Vec<(&'static str, Box<dyn Formulation<D>>)> {
    let consistent = Krimi {
        divergence: Continuity::Consistent,
    };
    vec![
        ("hu-adams", Box::new(HuAdams::default())),
        (
            "colagrossi-landrini",
            Box::new(ColagrossiLandrini::default()),
        ),
        ("grenier", Box::new(Grenier::default())),
        ("krimi", Box::new(consistent)),
    ]
}

/// The columns a formulation's stages write, and what they write there.
fn prepare<const D: usize>(world: &mut World<D>, formulation: &dyn Formulation<D>) {
    for mut stage in formulation.stages() {
        let access = stage.access();
        for field in access.writes.iter().chain(&access.reads()) {
            world.free.add_any(*field, Role::Derived);
        }
        stage.run(world).unwrap();
    }
}

fn divergence<const D: usize>(world: &World<D>, formulation: &dyn Formulation<D>) -> Vec<f64> {
    rates(world, &vec![formulation.divergence()]).1
}

/// (Σ V p D{u} + Σ V u·G{p}) over its terms' size, with −V G{p} = m a.
fn adjointness<const D: usize>(world: &World<D>, formulation: &dyn Formulation<D>) -> f64 {
    let free = &world.free;
    let (volume, pressure) = free.all((fields::VOLUME, fields::PRESSURE)).unwrap();
    let (mass, velocity) = free.all((fields::MASS, fields::VELOCITY)).unwrap();
    let force = rates(world, &vec![formulation.pressure_term()]).0;
    let rate = divergence(world, formulation);
    let (mut sum, mut size) = (0.0, 0.0);
    for i in 0..volume.len() {
        let compressed = volume[i] * pressure[i] * rate[i];
        let work = mass[i] * force[i].dot(&velocity[i]);
        sum += compressed - work;
        size += compressed.abs() + work.abs();
    }
    sum / size
}

fn check_adjointness<const D: usize>(n: usize, ratio: f64) {
    for (name, formulation) in all::<D>() {
        let mut cloud = cloud::<D>(n, ratio, 3);
        prepare(&mut cloud, &*formulation);
        let found = adjointness(&cloud, &*formulation);
        assert!(
            found.abs() < 1e-13,
            "{name} in {D}D: Σ V p D + Σ V u·G = {found:e}"
        );
    }
}

#[test]
fn gradient_and_divergence_are_skew_adjoint_to_1e_13() {
    check_adjointness::<2>(24, 2.0);
    check_adjointness::<3>(12, 1.5);
}

/// The paper's divergence is another one: the test above can fail.
#[test]
fn the_literal_divergence_of_krimi_is_not_the_adjoint() {
    let mut cloud = cloud::<2>(24, 2.0, 3);
    let literal = Krimi::default();
    prepare(&mut cloud, &literal);
    let found = adjointness(&cloud, &literal).abs();
    assert!(found > 1e-5, "Σ V p D + Σ V u·G = {found:e}");
}

#[test]
fn pressure_conserves_momentum_to_1e_13_and_angular_momentum_to_1e_12() {
    for (name, formulation) in all::<2>() {
        let mut cloud = cloud::<2>(24, 2.0, 5);
        prepare(&mut cloud, &*formulation);
        let force = rates(&cloud, &vec![formulation.pressure_term()]).0;
        let sum = imbalance(&cloud, &force);
        assert!(sum < 1e-13, "{name}: Σ m a / Σ m |a| = {sum:e}");
    }
    // A patch in the open: no pair across a period.
    for (name, formulation) in all::<2>() {
        let mut patch = world(disorder::<2>(20, 0.3, 7), open(), 0.05, 2.0);
        set(&mut patch, fields::PRESSURE, |x| {
            3.0 + x[0] - 2.0 * x[1] * x[0]
        });
        prepare(&mut patch, &*formulation);
        let force = rates(&patch, &vec![formulation.pressure_term()]).0;
        let position = patch.free.get(fields::POSITION).unwrap();
        let mass = patch.free.get(fields::MASS).unwrap();
        let torque = |i: usize| mass[i] * position[i].perp(&force[i]);
        let sum: f64 = (0..mass.len()).map(torque).sum();
        let size: f64 = (0..mass.len()).map(|i| torque(i).abs()).sum();
        assert!(sum.abs() < 1e-12 * size, "{name}: {sum:e} of {size:e}");
    }
}

#[test]
fn constant_velocity_has_exactly_no_divergence() {
    for (name, formulation) in all::<2>() {
        let mut cloud = cloud::<2>(24, 2.0, 6);
        set_velocity(&mut cloud, |_| Vect::<2>::new(3.0, -1.0));
        prepare(&mut cloud, &*formulation);
        let rate = divergence(&cloud, &*formulation);
        assert!(rate.iter().all(|d| *d == 0.0), "{name}");
    }
}

/// u = (x, 2y) on a lattice: div u = 3; −∇p/ρ of p = x: −1.
#[test]
fn linear_fields_on_a_lattice_are_met_to_1_per_cent() {
    for (name, formulation) in all::<2>() {
        let mut grid = world(lattice::<2>(15), open(), 1.0 / 15.0, 2.0);
        set_velocity(&mut grid, |x| Vect::<2>::new(x[0], 2.0 * x[1]));
        set(&mut grid, fields::PRESSURE, |x| x[0]);
        prepare(&mut grid, &*formulation);
        // A density sum on the open lattice: the middle is full.
        let middle = at(&grid, Vect::repeat(0.5));
        let rate = divergence(&grid, &*formulation)[middle];
        let force = rates(&grid, &vec![formulation.pressure_term()]).0[middle];
        assert!((rate / 3.0 - 1.0).abs() < 0.01, "{name}: div = {rate}");
        assert!((force[0] + 1.0).abs() < 0.01, "{name}: a = {force}");
    }
}
