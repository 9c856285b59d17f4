//! The renormalised surface: exact for linear velocities, and a force that takes what the densities give.

use sph_contribution::{Forces, StepMoment, StepPhase};
use sph_core::{Role, Vect, fields};
use sph_multiphase::{Formulation, HuAdams, MOMENT_EXCESS, Renormalised};
use sph_neighbours::World;

use crate::evaluate::{laws, offered, rates};
use crate::world::{Random, disorder, open, set, set_velocity, world};

const SPACING: f64 = 1.0 / 16.0;

/// A block with free sides, its particles a share of a spacing off their lattice.
fn block<const D: usize>(jitter: f64) -> World<D> {
    let mut block = world(disorder::<D>(16, jitter, 3), open(), SPACING, 2.0);
    for name in ["moment_excess", "explained_deficit"] {
        let field = renormalised(&block).stages[0].access().writes.into_iter();
        let field = field.filter(|f| f.name == name);
        field.for_each(|f| block.free.add_any(f, Role::Derived));
    }
    let mut random = Random::new(5);
    set(&mut block, fields::PRESSURE, |_| random.between(-1.0, 3.0));
    renormalised(&block).stages[0].run(&mut block).unwrap();
    block
}

/// The offer where sound is so slow that nothing relaxes.
fn renormalised<const D: usize>(world: &World<D>) -> sph_contribution::Offer<D> {
    let slow = laws(&[(1.0, 1e-12), (1.0, 1e-12)]);
    offered(&mut Renormalised::default(), (&slow, true), world)
}

/// dK/dt of every particle by the present velocities.
fn strain<const D: usize>(world: &mut World<D>) -> Vec<f64> {
    set(world, fields::DENSITY_CONSTANT, |_| 0.0);
    let mut offer = renormalised(world);
    let (sweep, outside) = (Vec::new(), Vec::new());
    let mut moment = StepMoment {
        world,
        dt: 1.0,
        forces: Forces {
            sweep: &sweep,
            outside: &outside,
        },
        on_walls: &mut Vec::new(),
    };
    offer.hooks[0]
        .run(StepPhase::AfterKick, &mut moment)
        .unwrap();
    world.free.get(fields::DENSITY_CONSTANT).unwrap().to_vec()
}

fn is_exact<const D: usize>() {
    let mut block = block::<D>(0.1);
    let gradient = |k: usize, l: usize| 0.7 * k as f64 - 0.4 * l as f64 + 0.3;
    set_velocity(&mut block, |x| {
        Vect::from_fn(|k, _| (0..D).map(|l| gradient(k, l) * x[l]).sum())
    });
    let trace: f64 = (0..D).map(|k| gradient(k, k)).sum();
    let plain = rates(&block, &vec![HuAdams::default().divergence()]).1;
    let density = block.free.get(fields::DENSITY).unwrap().to_vec();
    let constant = strain(&mut block);
    // The first row of a side, away from edges.
    let beyond = |c: &f64| !(SPACING..1.0 - SPACING).contains(c);
    let middle = |c: &f64| (5.0 * SPACING..1.0 - 5.0 * SPACING).contains(c);
    let position = block.free.get(fields::POSITION).unwrap();
    let side = |x: &Vect<D>| {
        x.iter().filter(|c| beyond(c)).count() == 1
            && x.iter().filter(|c| middle(c)).count() == D - 1
    };
    let at_side: Vec<usize> = (0..constant.len())
        .filter(|i| side(&position[*i]))
        .collect();
    assert!(at_side.len() > 20, "{}", at_side.len());
    for i in at_side {
        let divergence = plain[i] - constant[i] / density[i];
        let off = (divergence - trace).abs();
        assert!(off < 1e-12, "{divergence} for {trace}");
        assert!((plain[i] - trace).abs() > 0.01, "{}", plain[i]);
    }
}

#[test]
fn the_divergence_of_linear_velocities_is_exact_at_a_surface() {
    is_exact::<2>();
    is_exact::<3>();
}

#[test]
fn the_force_takes_the_energy_that_densities_gain_and_no_momentum() {
    let mut block = block::<2>(0.3);
    let mut random = Random::new(7);
    set_velocity(&mut block, |_| {
        Vect::from_fn(|_, _| random.between(-1.0, 1.0))
    });
    let force = rates(&block, &renormalised(&block).terms).0;
    let constant = strain(&mut block);
    let column = |field| block.free.get(field).unwrap();
    let (mass, volume) = (column(fields::MASS), column(fields::VOLUME));
    let (pressure, density) = (column(fields::PRESSURE), column(fields::DENSITY));
    let velocity = block.free.get(fields::VELOCITY).unwrap();
    let (mut power, mut scale, mut momentum) = (0.0, 0.0, Vect::<2>::zeros());
    for i in 0..force.len() {
        let done = mass[i] * force[i].dot(&velocity[i]);
        power += done + volume[i] * pressure[i] * constant[i] / density[i];
        scale += done.abs();
        momentum += force[i] * mass[i];
    }
    assert!(power.abs() < 1e-12 * scale, "{power:e} of {scale:e}");
    assert!(momentum.norm() < 1e-12 * scale, "{:e}", momentum.norm());
}

#[test]
fn nothing_acts_where_supports_are_full() {
    let block = block::<2>(0.0);
    let excess = block.free.get(MOMENT_EXCESS).unwrap();
    let position = block.free.get(fields::POSITION).unwrap();
    let inner = 5.0 * SPACING..1.0 - 5.0 * SPACING;
    let inside = |x: &Vect<2>| x.iter().all(|c| inner.contains(c));
    let all = position.iter().zip(excess).filter(|(x, _)| inside(x));
    assert!(all.clone().count() > 20);
    all.for_each(|(_, n)| assert_eq!(n.0, [0.0; 6]));
}
