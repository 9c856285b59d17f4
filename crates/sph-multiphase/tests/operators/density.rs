//! The density sum: it returns what it was given, and has no memory of the way.

use sph_core::{Role, Vect, fields};
use sph_multiphase::{Formulation, HuAdams};
use sph_neighbours::World;

use crate::channel::Channel;
use crate::world::{Random, disorder, periodic, set, world};

fn density<const D: usize>(world: &World<D>) -> Vec<f64> {
    world.free.get(fields::DENSITY).unwrap().to_vec()
}

fn sum_up<const D: usize>(world: &mut World<D>) {
    Formulation::<D>::stages(&HuAdams::default())[0]
        .run(world)
        .unwrap();
}

/// Largest relative difference of two columns.
fn worst(a: &[f64], b: &[f64]) -> f64 {
    let pairs = a.iter().zip(b);
    pairs.map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
}

/// Numbers the particles, so that they are found again after a sort.
fn number<const D: usize>(world: &mut World<D>) {
    world.free.add(fields::IDENTITY, Role::State);
    let count = world.free.len() as u32;
    *world.free.get_mut(fields::IDENTITY).unwrap() = (0..count).collect();
}

/// A column in the order of the numbers.
fn by_number<const D: usize>(world: &World<D>, column: &[f64]) -> Vec<f64> {
    let mut sorted = vec![f64::NAN; column.len()];
    for (i, value) in world.free.get(fields::IDENTITY).unwrap().iter().zip(column) {
        sorted[*i as usize] = *value;
    }
    sorted
}

fn push<const D: usize>(world: &mut World<D>, by: impl Fn(&Vect<D>, u32) -> Vect<D>) {
    let number = world.free.get(fields::IDENTITY).unwrap().to_vec();
    let positions = world.free.get_mut(fields::POSITION).unwrap();
    for (x, i) in positions.iter_mut().zip(number) {
        *x += by(x, i);
    }
    world.refresh_lists().unwrap();
}

#[test]
fn after_a_rebase_the_sum_is_the_given_density_to_1e_14() {
    let mut random = Random::new(1);
    let mut cloud = world(disorder::<2>(24, 0.3, 1), periodic(), 1.0 / 24.0, 2.0);
    set(&mut cloud, fields::DENSITY, |_| {
        random.between(900.0, 1100.0)
    });
    set(&mut cloud, fields::MASS, |x| {
        if x[0] < 0.5 { 1.7 } else { 0.002 }
    });
    let given = density(&cloud);
    HuAdams::default().rebase(&mut cloud).unwrap();
    set(&mut cloud, fields::DENSITY, |_| 0.0);
    sum_up(&mut cloud);
    // K = ρ − mΣw and ρ = K + mΣw: the roundings of one difference and one sum.
    let error = worst(&density(&cloud), &given);
    assert!(error < 1e-14, "2D: {error:e}");

    let mut cloud = world(disorder::<3>(10, 0.3, 1), periodic(), 0.1, 1.3);
    set(&mut cloud, fields::DENSITY, |_| {
        random.between(900.0, 1100.0)
    });
    set(&mut cloud, fields::MASS, |_| 1.0);
    let given = density(&cloud);
    HuAdams::default().rebase(&mut cloud).unwrap();
    set(&mut cloud, fields::DENSITY, |_| 0.0);
    sum_up(&mut cloud);
    let error = worst(&density(&cloud), &given);
    assert!(error < 1e-14, "3D: {error:e}");
}

#[test]
fn next_to_walls_it_is_given_back_to_1e_14_and_the_volume_with_it() {
    let mut channel = Channel::closed(7);
    let world = &mut channel.world;
    let mut random = Random::new(2);
    set(world, fields::DENSITY, |_| random.between(900.0, 1100.0));
    set(world, fields::MASS, |_| 250.0);
    let given = density(world);
    HuAdams::default().rebase(world).unwrap();
    sum_up(world);
    let error = worst(&density(world), &given);
    assert!(error < 1e-14, "{error:e}");
    let volume = world.free.get(fields::VOLUME).unwrap();
    for (v, rho) in volume.iter().zip(density(world)) {
        assert_eq!(*v, 250.0 / rho);
    }
}

/// Rows in front of both walls are pressed together, shaken for fifty steps and brought back.
#[test]
fn between_walls_there_and_back_leaves_a_drift_below_1e_13() {
    let mut channel = Channel::closed(7);
    number(&mut channel.world);
    set(&mut channel.world, fields::MASS, |_| 250.0);
    set(&mut channel.world, fields::DENSITY, |_| 1000.0);
    HuAdams::default().rebase(&mut channel.world).unwrap();
    let start = channel.world.free.get(fields::POSITION).unwrap().to_vec();
    let start_numbers = channel.world.free.get(fields::IDENTITY).unwrap().to_vec();
    let mut random = Random::new(3);
    let mut largest_change: f64 = 0.0;
    for _ in 0..50 {
        let shake: Vec<Vect<2>> = (0..start.len())
            .map(|_| Vect::<2>::new(random.between(-0.05, 0.05), random.between(-0.05, 0.05)))
            .collect();
        push(&mut channel.world, |x, i| {
            let y = (x + shake[i as usize])[1].clamp(0.2, 3.8);
            Vect::<2>::new(shake[i as usize][0] + 0.1, y - x[1])
        });
        channel.measure();
        sum_up(&mut channel.world);
        largest_change =
            largest_change.max(worst(&density(&channel.world), &vec![1000.0; start.len()]));
    }
    assert!(largest_change > 0.05, "nothing happened: {largest_change}");
    let mut home = vec![Vect::zeros(); start.len()];
    for (i, x) in start_numbers.iter().zip(&start) {
        home[*i as usize] = *x;
    }
    push(&mut channel.world, |x, i| home[i as usize] - x);
    channel.measure();
    sum_up(&mut channel.world);
    let back = by_number(&channel.world, &density(&channel.world));
    let drift = worst(&back, &vec![1000.0; start.len()]);
    // The same sum in the order of another list.
    assert!(
        drift < 1e-13,
        "{drift:e} after changes of {largest_change:.2}"
    );
}

#[test]
fn in_3d_there_and_back_leaves_a_drift_below_1e_13() {
    let mut cloud = world(disorder::<3>(10, 0.2, 4), periodic(), 0.1, 1.3);
    number(&mut cloud);
    set(&mut cloud, fields::MASS, |_| 1.0);
    set(&mut cloud, fields::DENSITY, |_| 1000.0);
    HuAdams::default().rebase(&mut cloud).unwrap();
    let start = cloud.free.get(fields::POSITION).unwrap().to_vec();
    let numbers = cloud.free.get(fields::IDENTITY).unwrap().to_vec();
    let mut random = Random::new(5);
    let mut changed: f64 = 0.0;
    for _ in 0..20 {
        let shake: Vec<Vect<3>> = (0..start.len())
            .map(|_| Vect::from_fn(|_, _| random.between(-0.02, 0.03)))
            .collect();
        push(&mut cloud, |_, i| shake[i as usize]);
        sum_up(&mut cloud);
        changed = changed.max(worst(&density(&cloud), &vec![1000.0; start.len()]));
    }
    assert!(changed > 0.05, "nothing happened: {changed}");
    let mut home = vec![Vect::zeros(); start.len()];
    for (i, x) in numbers.iter().zip(&start) {
        home[*i as usize] = *x;
    }
    push(&mut cloud, |x, i| home[i as usize] - x);
    sum_up(&mut cloud);
    let drift = worst(&density(&cloud), &vec![1000.0; start.len()]);
    assert!(drift < 1e-13, "{drift:e} after changes of {changed:.2}");
}

/// The sum of a full lattice: m Σw = 1.0012 ρ₀ in 2D at h/δr = 2, 1.0095 in 3D at 1.3.
#[test]
fn the_lattice_sum_of_the_kernel_is_10012_in_2d_and_10095_in_3d() {
    let mut flat = world(crate::world::lattice::<2>(20), periodic(), 0.05, 2.0);
    sum_up(&mut flat);
    assert!(density(&flat).iter().all(|rho| (rho - 1.0012).abs() < 5e-5));
    let mut solid = world(crate::world::lattice::<3>(10), periodic(), 0.1, 1.3);
    sum_up(&mut solid);
    assert!(
        density(&solid)
            .iter()
            .all(|rho| (rho - 1.0095).abs() < 5e-5)
    );
}
