//! The stage of the equations of state, with and without strain rates.

use std::sync::Arc;

use sph_core::{Declares, Role, Stage, fields};
use sph_multiphase::equations_of_state;
use sph_neighbours::World;
use sph_rheology::state::{BoundState, CompressibleGrains, EquationOfState, Linear, Reference};

use crate::world::{lattice, periodic, set, world};

fn water() -> Box<dyn BoundState> {
    Linear::default().bind(Reference {
        density: 1000.0,
        sound_speed: 20.0,
    })
}

fn beads() -> Box<dyn BoundState> {
    let grains = CompressibleGrains {
        grain_diameter: 5e-3,
        largest_fraction: 0.6,
        smallest_fraction: 0.5,
    };
    grains.bind(Reference {
        density: 480.0,
        sound_speed: 11.8,
    })
}

fn stage(laws: Vec<Box<dyn BoundState>>) -> impl Stage<World<2>> {
    equations_of_state(Arc::from(laws))
}

/// 2025 particles of both phases in runs that end within a batch.
fn mixed() -> World<2> {
    let mut world = world(lattice::<2>(45), periodic(), 1.0 / 45.0, 2.0);
    world.free.add(fields::PHASE, Role::State);
    world.free.add(fields::STRAIN_RATE, Role::State);
    set(&mut world, fields::STRAIN_RATE, |x| 20.0 * x[0]);
    set(&mut world, fields::DENSITY, |x| 470.0 + 15.0 * x[1]);
    let phase = world.free.get_mut(fields::PHASE).expect("phase");
    for (k, phase) in phase.iter_mut().enumerate() {
        *phase = u32::from(k / 100 % 2 == 1);
    }
    world
}

#[test]
fn only_laws_that_shear_read_the_strain_rate() {
    let reads = |laws| {
        let reads = stage(laws).access().reads();
        reads.iter().any(|f| f.name == fields::STRAIN_RATE.name)
    };
    assert!(!reads(vec![water(), water()]));
    assert!(reads(vec![beads()]) && reads(vec![water(), beads()]));
}

#[test]
fn every_particle_has_the_pressure_of_its_law() {
    for several in [false, true] {
        let mut world = mixed();
        let laws = || match several {
            false => vec![beads()],
            true => vec![water(), beads()],
        };
        stage(laws()).run(&mut world).expect("runs");
        let get = |field| world.free.get(field).expect("a column");
        let (density, rate) = (get(fields::DENSITY), get(fields::STRAIN_RATE));
        let phase = world.free.get(fields::PHASE).expect("phase");
        for (k, p) in get(fields::PRESSURE).iter().enumerate() {
            let mut alone = [0.0];
            let law = &laws()[if several { phase[k] as usize } else { 0 }];
            law.sheared_pressure(&density[k..=k], &rate[k..=k], &mut alone);
            assert_eq!(*p, alone[0], "{k}");
        }
    }
}

#[test]
fn without_laws_that_shear_the_column_need_not_be_there() {
    let mut world = world(lattice::<2>(4), periodic(), 0.25, 2.0);
    assert!(stage(vec![water()]).run(&mut world).is_ok());
    assert!(stage(vec![beads()]).run(&mut world).is_err());
}
