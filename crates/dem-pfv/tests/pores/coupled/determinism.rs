//! The same bits on any number of threads, and after a resumption.

use dem_pfv::coupled::{CoupledSystem, FlowCondition, FlowSetup, Fluid, State, WallBoundary, Wave};
use dem_pfv::flow::{HydraulicRadius, Solver};
use dem_pfv::grains::{Control, GrainSystem};

use crate::coupled::{boxed, boxed_laws, packed, packing, sticking, wave};
use crate::{BOX200, BOX1000, assert_same_on_threads};

/// A packing under a piston with a wave on top, of a fluid that gives way: everything that is remembered.
fn system() -> CoupledSystem {
    let setup = boxed(packing(BOX1000)).gravity([0.0, 0.0, -9.81]);
    let mut grains = GrainSystem::new(setup).expect("grains");
    grains.walls[4].control = Control::Piston {
        stress: 8e4,
        mass: 100.0,
    };
    let top = FlowCondition::Wave(Wave {
        ramp: 1e4,
        period: Some(0.1),
        ..wave(1.0, 2e3)
    });
    let fluid = Fluid {
        bulk_modulus: Some(1e9),
        ..Fluid::new(50.0, 1000.0)
    };
    let setup = sticking(FlowSetup::new(fluid));
    CoupledSystem::new(grains, setup.side(5, top.into())).expect("a system")
}

fn hydraulic() -> Box<HydraulicRadius> {
    Box::new(HydraulicRadius::default())
}

fn run(system: &mut CoupledSystem, steps: usize) {
    for _ in 0..steps {
        system.step(1.2e-4).expect("a step");
    }
}

fn bits(system: &CoupledSystem) -> Vec<u64> {
    let grains = &system.grains().grains;
    let columns = [&grains.position, &grains.velocity, &grains.external_force];
    let vectors = columns.into_iter().flatten().flatten().copied();
    let walls = system.grains().walls.iter();
    let walls = walls.flat_map(|w| [w.point.z, w.external_force.z]);
    let flow = system.pressures.iter().chain(&system.rates).copied();
    vectors.chain(walls).chain(flow).map(f64::to_bits).collect()
}

#[test]
fn one_two_and_four_threads_give_the_same_bits() {
    assert_same_on_threads(|| {
        let mut system = system();
        run(&mut system, 60);
        assert!(system.meshes > 2, "{} meshes", system.meshes);
        bits(&system)
    });
}

#[test]
fn a_resumed_run_goes_on_to_the_same_bits() {
    let mut whole = system();
    run(&mut whole, 60);
    let mut first = system();
    run(&mut first, 37);
    let text = serde_json::to_string(&first.save()).expect("saved");
    drop(first);
    let state: State = serde_json::from_str(&text).expect("read");
    let mut second = CoupledSystem::resume(state, boxed_laws(), hydraulic()).expect("resumed");
    let before = second.meshes;
    run(&mut second, 23);
    assert!(second.meshes > before, "no mesh after the resumption");
    assert_eq!(second.meshes, whole.meshes);
    assert_eq!(bits(&second), bits(&whole));
}

/// Where a mesh is too large for a factor, conjugate gradients start from the last pressures: those are kept too.
#[test]
fn a_resumed_run_with_conjugate_gradients_goes_on_to_the_same_bits() {
    let start = || {
        let mut setup = FlowSetup::new(Fluid::new(50.0, 0.0)).side(5, WallBoundary::drained(100.0));
        setup.solver = Solver::ConjugateGradient {
            tolerance: 1e-8,
            limit: 1000,
        };
        CoupledSystem::new(packed(BOX200), setup).expect("a system")
    };
    let mut whole = start();
    run(&mut whole, 60);
    let mut first = start();
    run(&mut first, 31);
    let resumed = CoupledSystem::resume(first.save(), boxed_laws(), hydraulic());
    let mut second = resumed.expect("resumed");
    run(&mut second, 29);
    assert_eq!(bits(&second), bits(&whole));
}
