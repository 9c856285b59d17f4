//! The density sum: it returns what it was given, and has no memory of the way.

use sph_core::{Role, Vect, fields};
use sph_multiphase::{Formulation, HuAdams};
use sph_neighbours::World;

use crate::channel::{Channel, measure};
use crate::world::{Random, disorder, lattice, periodic, set, world};

fn density<const D: usize>(world: &World<D>) -> Vec<f64> {
    world.free.get(fields::DENSITY).unwrap().to_vec()
}

fn sum_up<const D: usize>(world: &mut World<D>) {
    let mut stages = Formulation::<D>::stages(&HuAdams::default());
    stages[0].run(world).unwrap();
}

/// Largest relative difference of two columns.
fn worst(a: &[f64], b: &[f64]) -> f64 {
    let pairs = a.iter().zip(b);
    pairs.map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
}

/// The largest relative difference of the sum to random densities after a rebase.
fn given_back<const D: usize>(world: &mut World<D>, random: &mut Random) -> f64 {
    set(world, fields::DENSITY, |_| random.between(900.0, 1100.0));
    let given = density(world);
    HuAdams::default().rebase(world).unwrap();
    set(world, fields::DENSITY, |_| 0.0);
    sum_up(world);
    worst(&density(world), &given)
}

#[test]
fn after_a_rebase_the_sum_is_the_given_density_to_1e_14() {
    let mut random = Random::new(1);
    let mut plane = world(disorder::<2>(24, 0.3, 1), periodic(), 1.0 / 24.0, 2.0);
    set(&mut plane, fields::MASS, |x| {
        if x[0] < 0.5 { 1.7 } else { 0.002 }
    });
    let mut space = world(disorder::<3>(10, 0.3, 1), periodic(), 0.1, 1.3);
    set(&mut space, fields::MASS, |_| 1.0);
    // K = ρ − mΣw and ρ = K + mΣw: the roundings of one difference and one sum.
    let errors = [
        given_back(&mut plane, &mut random),
        given_back(&mut space, &mut random),
    ];
    assert!(errors.iter().all(|e| *e < 1e-14), "{errors:?}");
}

#[test]
fn next_to_walls_it_is_given_back_to_1e_14_and_the_volume_with_it() {
    let world = &mut Channel::closed(7).world;
    set(world, fields::MASS, |_| 250.0);
    let error = given_back(world, &mut Random::new(2));
    assert!(error < 1e-14, "{error:e}");
    let volume = world.free.get(fields::VOLUME).unwrap();
    for (v, rho) in volume.iter().zip(density(world)) {
        assert_eq!(*v, 250.0 / rho);
    }
}

/// Shakes particles of a density of 1000 for some steps and brings them back: the largest change of their densities on the
/// way, and the one that is left. `moved` is the way of a particle from its place and its shake, `measure` follows a move.
fn there_and_back<const D: usize>(
    world: &mut World<D>,
    (steps, [low, high], seed): (usize, [f64; 2], u64),
    moved: impl Fn(&Vect<D>, &Vect<D>) -> Vect<D>,
    mut measure: impl FnMut(&mut World<D>),
) -> [f64; 2] {
    // Numbers by which particles are found again after a sort.
    let count = world.free.len();
    world.free.add(fields::IDENTITY, Role::State);
    *world.free.get_mut(fields::IDENTITY).unwrap() = (0..count as u32).collect();
    let start = world.free.get(fields::POSITION).unwrap().to_vec();
    set(world, fields::DENSITY, |_| 1000.0);
    HuAdams::default().rebase(world).unwrap();
    let mut random = Random::new(seed);
    let mut push = |world: &mut World<D>, by: &dyn Fn(&Vect<D>, usize) -> Vect<D>| {
        let number = world.free.get(fields::IDENTITY).unwrap().to_vec();
        let positions = world.free.get_mut(fields::POSITION).unwrap();
        for (x, i) in positions.iter_mut().zip(number) {
            *x += by(x, i as usize);
        }
        world.refresh_lists().unwrap();
        measure(world);
        sum_up(world);
        worst(&density(world), &vec![1000.0; count])
    };
    let mut changed: f64 = 0.0;
    for _ in 0..steps {
        let shake: Vec<Vect<D>> = (0..count)
            .map(|_| Vect::from_fn(|_, _| random.between(low, high)))
            .collect();
        changed = changed.max(push(world, &|x, i| moved(x, &shake[i])));
    }
    [changed, push(world, &|x, i| start[i] - x)]
}

/// Between walls rows in front of both are pressed together; the last sum is that of the first in the order of another list.
#[test]
fn there_and_back_leaves_a_drift_below_1e_13() {
    let mut channel = Channel::closed(7);
    set(&mut channel.world, fields::MASS, |_| 250.0);
    let pressed = |x: &Vect<2>, shake: &Vect<2>| {
        let y = (x + shake)[1].clamp(0.2, 3.8);
        Vect::<2>::new(shake[0] + 0.1, y - x[1])
    };
    let top = channel.top;
    let between = there_and_back(
        &mut channel.world,
        (50, [-0.05, 0.05], 3),
        pressed,
        |world| measure(world, top),
    );
    let mut cloud = world(disorder::<3>(10, 0.2, 4), periodic(), 0.1, 1.3);
    set(&mut cloud, fields::MASS, |_| 1.0);
    let in_3d = there_and_back(&mut cloud, (20, [-0.02, 0.03], 5), |_, by| *by, |_| ());
    for [changed, drift] in [between, in_3d] {
        assert!(changed > 0.05, "nothing happened: {changed}");
        assert!(drift < 1e-13, "{drift:e} after changes of {changed:.2}");
    }
}

/// The sum of a full lattice: m Σw = 1.0012 ρ₀ in 2D at h/δr = 2, 1.0095 in 3D at 1.3.
#[test]
fn the_lattice_sum_of_the_kernel_is_10012_in_2d_and_10095_in_3d() {
    let mut flat = world(lattice::<2>(20), periodic(), 0.05, 2.0);
    sum_up(&mut flat);
    let mut solid = world(lattice::<3>(10), periodic(), 0.1, 1.3);
    sum_up(&mut solid);
    for (sums, printed) in [(density(&flat), 1.0012), (density(&solid), 1.0095)] {
        assert!(sums.iter().all(|rho| (rho - printed).abs() < 5e-5));
    }
}
