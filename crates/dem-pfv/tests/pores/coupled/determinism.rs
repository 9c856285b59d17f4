//! The same bits on any number of threads, and after a resumption.

use dem_pfv::Axis;
use dem_pfv::coupled::{CoupledSystem, FlowCondition, FlowSetup, Fluid, State, WallBoundary, Wave};
use dem_pfv::flow::HydraulicRadius;
use dem_pfv::grains::{Control, GrainSystem};

use crate::coupled::{BOX1000, MODULUS, box_of_laws, boxed, packing, sticking};

/// A packing under a piston with a wave on top, of a fluid that gives way: everything that is remembered.
fn system() -> CoupledSystem {
    let setup = boxed(packing(BOX1000), MODULUS).gravity([0.0, 0.0, -9.81]);
    let mut grains = GrainSystem::new(setup).expect("grains");
    grains.walls[4].control = Control::Piston {
        stress: 8e4,
        mass: 100.0,
    };
    let wave = Wave {
        axis: Axis::X,
        crest: 0.0,
        half_length: 1.0,
        amplitude: 2e3,
        ramp: 1e4,
        period: Some(0.1),
    };
    let top = WallBoundary {
        condition: FlowCondition::Wave(wave),
        sticks: false,
    };
    let fluid = Fluid {
        bulk_modulus: Some(1e9),
        ..Fluid::new(50.0, 1000.0)
    };
    let setup = sticking(FlowSetup::new(fluid));
    CoupledSystem::new(grains, setup.side(5, top)).expect("a system")
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
    let vectors = columns
        .into_iter()
        .flatten()
        .flat_map(|v| v.iter().copied());
    let walls = system
        .grains()
        .walls
        .iter()
        .flat_map(|w| [w.point.z, w.external_force.z]);
    let flow = system.pressures.iter().chain(&system.rates).copied();
    vectors.chain(walls).chain(flow).map(f64::to_bits).collect()
}

#[test]
fn one_two_and_four_threads_give_the_same_bits() {
    let results: Vec<_> = [1, 2, 4]
        .into_iter()
        .map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.expect("threads").install(|| {
                let mut system = system();
                run(&mut system, 60);
                assert!(system.meshes > 2, "{} meshes", system.meshes);
                bits(&system)
            })
        })
        .collect();
    assert_eq!(results[0], results[1]);
    assert_eq!(results[0], results[2]);
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
    let mut second =
        CoupledSystem::resume(state, box_of_laws(MODULUS), hydraulic()).expect("resumed");
    let before = second.meshes;
    run(&mut second, 23);
    assert!(
        second.meshes > before,
        "no mesh was made after the resumption"
    );
    assert_eq!(second.meshes, whole.meshes);
    assert_eq!(bits(&second), bits(&whole));
}

/// Where a mesh is too large for a factor, conjugate gradients start from the last pressures: those are kept too.
#[test]
fn a_resumed_run_with_conjugate_gradients_goes_on_to_the_same_bits() {
    let start = || {
        let grains =
            GrainSystem::new(boxed(packing(crate::coupled::BOX200), MODULUS)).expect("grains");
        let mut setup = FlowSetup::new(Fluid::new(50.0, 0.0)).side(5, WallBoundary::drained(100.0));
        setup.solver = dem_pfv::flow::Solver::ConjugateGradient {
            tolerance: 1e-8,
            limit: 1000,
        };
        CoupledSystem::new(grains, setup).expect("a system")
    };
    let mut whole = start();
    run(&mut whole, 60);
    let mut first = start();
    run(&mut first, 31);
    let mut second =
        CoupledSystem::resume(first.save(), box_of_laws(MODULUS), hydraulic()).expect("resumed");
    run(&mut second, 29);
    assert_eq!(bits(&second), bits(&whole));
}
