//! The compiled combinations of terms against the same terms one by one: the same bits.

use sph_core::{Role, Vect, fields};
use sph_neighbours::{Interaction, Terms, World, fuse_all, kernel_sums};

use crate::channel::Channel;
use crate::evaluate::{pressure, rates, smoother, viscosity, viscosity_column};
use crate::world::{Random, disorder, periodic, set, set_velocity, world};

fn shaken<const D: usize>(world: &mut World<D>) {
    let mut random = Random::new(8);
    world.gravity[1] = -9.81;
    world.driving[0] = 0.3;
    world.free.add(fields::VISCOSITY, Role::State);
    set(world, fields::PRESSURE, |_| random.between(-3.0, 10.0));
    set(world, fields::DENSITY, |_| random.between(0.9, 1.1));
    set(world, fields::VISCOSITY, |_| random.between(0.1, 1.0));
    set_velocity(world, |_| Vect::from_fn(|_, _| random.between(-1.0, 1.0)));
}

fn bits<const D: usize>(world: &World<D>, terms: Terms<D>) -> Vec<u64> {
    let (acceleration, scalar) = rates(world, &terms);
    let all = acceleration.iter().flatten().chain(&scalar);
    all.map(|x| x.to_bits()).collect()
}

type Choice<const D: usize> = fn() -> Vec<Box<dyn Interaction<D>>>;

/// Every registered combination, in the order in which a solver offers the terms.
fn combinations<const D: usize>() -> [(&'static str, Choice<D>); 5] {
    [
        ("pressure, viscosity, smoother", || {
            vec![pressure(), viscosity(0.1), smoother(1.0)]
        }),
        ("pressure, viscosities, smoother", || {
            vec![pressure(), viscosity_column(), smoother(1.0)]
        }),
        ("pressure, viscosity", || vec![pressure(), viscosity(0.1)]),
        ("pressure, viscosities", || {
            vec![pressure(), viscosity_column()]
        }),
        ("pressure, smoother", || vec![pressure(), smoother(1.0)]),
    ]
}

fn fused_is_separate<const D: usize>(world: &World<D>) {
    for (what, terms) in combinations::<D>() {
        let fused = fuse_all(terms());
        assert_eq!(fused.len(), 1, "{what} is one loop: {}", fused[0].name());
        // Every term keeps a sum of its own over the same neighbours in the same order, and
        // the sums are finished in the same order: not a rounding differs.
        assert!(bits(world, fused) == bits(world, terms()), "{what} in {D}D");
    }
}

#[test]
fn fused_terms_give_the_bits_of_separate_terms() {
    let mut flat = world(disorder::<2>(20, 0.3, 6), periodic(), 0.05, 2.0);
    shaken(&mut flat);
    fused_is_separate(&flat);
    let mut solid = world(disorder::<3>(9, 0.3, 6), periodic(), 1.0 / 9.0, 1.3);
    shaken(&mut solid);
    fused_is_separate(&solid);
}

#[test]
fn fused_terms_give_the_bits_of_separate_terms_next_to_walls() {
    let mut channel = Channel::closed(7);
    shaken(&mut channel.world);
    channel.world.walls.points.pressure.fill(2.0);
    channel.world.walls.elements.pressure.fill(2.5);
    fused_is_separate(&channel.world);
}

#[test]
fn a_list_without_its_skin_gives_the_same_bits() {
    let mut flat = world(disorder::<2>(20, 0.3, 6), periodic(), 0.05, 2.0);
    shaken(&mut flat);
    let terms: Choice<2> = || vec![pressure(), viscosity(0.1), smoother(1.0)];
    let with_skin = bits(&flat, fuse_all(terms()));
    let mut sums = vec![0.0; flat.free.len()];
    kernel_sums(&mut flat, &mut sums).unwrap();
    let pruned = flat.lists.pruned.as_ref().expect("the sum prunes");
    assert!(pruned.entries() < flat.lists.free.entries());
    assert!(with_skin == bits(&flat, fuse_all(terms())));
}

#[test]
fn another_order_of_the_terms_differs_by_rounding_alone() {
    let mut flat = world(disorder::<2>(20, 0.3, 6), periodic(), 0.05, 2.0);
    shaken(&mut flat);
    let (a, _) = rates(&flat, &vec![pressure(), viscosity(0.1)]);
    let (b, _) = rates(&flat, &vec![viscosity(0.1), pressure()]);
    for (a, b) in a.iter().zip(&b) {
        assert!((a - b).norm() <= 1e-14 * a.norm().max(1000.0), "{a} {b}");
    }
}
