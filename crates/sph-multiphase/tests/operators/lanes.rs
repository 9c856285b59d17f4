//! Sums of several particles side by side against the same sums of one particle at a time: the same bits.

use sph_core::{Access, Role, StepError, Vect, fields};
use sph_neighbours::{
    Interaction, Neighbourhood, Rates, RowTerm, Terms, WithTerm, World, kernel_sums,
};

use sph_multiphase::{DensityWeighted, Divergence, Formulation, Krimi};

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

/// A term without its loop over clusters.
struct OneByOne<const D: usize>(Box<dyn Interaction<D>>);

struct ByRows<'a, const D: usize>(&'a dyn RowTerm<D>);

impl<const D: usize> RowTerm<D> for ByRows<'_, D> {
    fn row(&self, at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        self.0.row(at, rates);
    }
}

impl<const D: usize> Interaction<D> for OneByOne<D> {
    fn name(&self) -> String {
        self.0.name()
    }
    fn access(&self) -> Access {
        self.0.access()
    }
    fn with_columns(&self, world: &World<D>, with: &mut WithTerm<'_, D>) -> Result<(), StepError> {
        self.0.with_columns(world, &mut |term| with(&ByRows(term)))
    }
}

fn terms<const D: usize>() -> Terms<D> {
    vec![
        pressure(),
        viscosity(0.1),
        viscosity_column(),
        smoother(1.0),
        Krimi::default().pressure_term(),
        Divergence::boxed(DensityWeighted),
    ]
}

fn lanes_are_one_by_one<const D: usize>(world: &World<D>) {
    for (lanes, rows) in terms().into_iter().zip(terms()) {
        let name = lanes.name();
        let rows: Terms<D> = vec![Box::new(OneByOne(rows))];
        assert!(
            bits(world, vec![lanes]) == bits(world, rows),
            "{name} in {D}D"
        );
    }
}

#[test]
fn lanes_give_the_bits_of_single_particles() {
    let mut flat = world(disorder::<2>(20, 0.3, 6), periodic(), 0.05, 2.0);
    shaken(&mut flat);
    lanes_are_one_by_one(&flat);
    let mut solid = world(disorder::<3>(9, 0.3, 6), periodic(), 1.0 / 9.0, 1.3);
    shaken(&mut solid);
    lanes_are_one_by_one(&solid);
}

#[test]
fn lanes_give_the_bits_of_single_particles_next_to_walls() {
    let mut channel = Channel::closed(7);
    shaken(&mut channel.world);
    channel.world.walls.points.pressure.fill(2.0);
    channel.world.walls.elements.pressure.fill(2.5);
    channel.world.walls.update_contacts();
    lanes_are_one_by_one(&channel.world);
}

#[test]
fn a_list_without_its_skin_gives_the_same_bits() {
    let mut flat = world(disorder::<2>(20, 0.3, 6), periodic(), 0.05, 2.0);
    shaken(&mut flat);
    let with_skin = bits(&flat, terms());
    let mut sums = vec![0.0; flat.free.len()];
    kernel_sums(&mut flat, &mut sums).unwrap();
    let pruned = flat.lists.pruned.as_ref().expect("the sum prunes");
    assert!(pruned.entries() < flat.lists.free.entries());
    assert!(with_skin == bits(&flat, terms()));
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
