//! Refusals name the grain, the wall or the cell; extreme flows that can be computed are stable.

use dem_pfv::Axis;
use dem_pfv::coupled::{
    CoupledError, CoupledSystem, FlowCondition, FlowSetup, Fluid, Recorded, StepLimit, WallBoundary,
};
use dem_pfv::flow::{FlowError, HydraulicRadius};
use dem_pfv::grains::{Grain, GrainError, GrainSystem, LinearElastic, Setup, Wall};

use crate::coupled::wave;
use crate::{assert_says, close};

fn law() -> LinearElastic {
    LinearElastic::new(1e6, 0.5, 0.3)
}

fn grains(spheres: Vec<Grain>) -> Result<GrainSystem, GrainError> {
    let setup = Setup::new(spheres, law()).walls(Wall::cuboid([0.0; 3], [1.0; 3]));
    GrainSystem::new(setup.gravity([0.0, 0.0, -9.81]))
}

fn ball(x: f64, radius: f64) -> Grain {
    Grain::new([x, 0.5, 0.5], radius, 2600.0)
}

fn drained() -> FlowSetup {
    FlowSetup::new(Fluid::new(10.0, 1000.0)).side(5, WallBoundary::drained(0.0))
}

fn refused(grains: GrainSystem, setup: FlowSetup) -> CoupledError {
    CoupledSystem::new(grains, setup).err().expect("refused")
}

fn one() -> GrainSystem {
    grains(vec![ball(0.5, 0.2)]).expect("a ball")
}

/// One ball in a drained box.
fn one_drained() -> CoupledSystem {
    CoupledSystem::new(one(), drained()).expect("a system")
}

#[test]
fn grains_that_overlap_or_are_in_walls_are_named() {
    let error = |balls| CoupledError::from(grains(balls).expect_err("refused"));
    let overlap = error(vec![ball(0.3, 0.2), ball(0.65, 0.2)]);
    assert_says(overlap, "grains 0 and 1 overlap by 5.000e-2 m");
    let inside = error(vec![ball(0.5, 0.1), ball(0.9, 0.2)]).to_string();
    assert_says(&inside, "grain 1 reaches");
    assert_says(&inside, "wall 1");
    let beyond = error(vec![ball(1.5, 0.2)]);
    assert_kind!(beyond, CoupledError::Grains(GrainError::InWall(0, ..)));
    assert!(matches!(grains(vec![]), Err(GrainError::NoGrains)));
    // Moved by hand into each other while the fluid is there.
    let two = grains(vec![ball(0.25, 0.2), ball(0.75, 0.2)]).expect("two");
    let mut system = CoupledSystem::new(two, drained()).expect("two");
    system.grains_mut().grains.position[1].x = 0.5;
    let error = system.remesh().expect_err("overlap");
    assert_kind!(error, CoupledError::Flow(FlowError::Overlap(0, 1, ..)));
}

#[test]
fn numbers_out_of_range_are_named() {
    for (viscosity, density, modulus, what) in [
        (0.0, 1000.0, None, "the viscosity is 0"),
        (-1.0, 1000.0, None, "the viscosity is -1"),
        (f64::NAN, 1000.0, None, "the viscosity is NaN"),
        (1.0, -1.0, None, "the fluid's density is -1"),
        (1.0, 1000.0, Some(0.0), "the bulk modulus is 0"),
    ] {
        let mut setup = drained();
        setup.fluid = Fluid::new(viscosity, density);
        setup.fluid.bulk_modulus = modulus;
        assert_says(refused(one(), setup), what);
    }
    let mut setup = drained();
    setup.remeshing.strain = Some(-1.0);
    assert_says(refused(one(), setup), "strain for remeshing");
    let mut system = one_drained();
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(system.step(step), Err(CoupledError::Number(_))));
    }
}

#[test]
fn closed_walls_are_refused_unless_the_fluid_gives_way() {
    let mut setup = FlowSetup::new(Fluid::new(10.0, 1000.0));
    let error = refused(one(), setup.clone());
    assert_kind!(error, CoupledError::Flow(FlowError::NoPressure(0)));
    setup.fluid.bulk_modulus = Some(1e6);
    let mut system = CoupledSystem::new(one(), setup).expect("a system");
    system.run_to(0.02, 0.8).expect("a run");
    assert!(system.pressures.iter().all(|p| p.is_finite()));
    // A wall that is closed while the run goes on: the old condition stays.
    let mut system = one_drained();
    let closed = system.set_side(5, WallBoundary::closed());
    let error = closed.expect_err("no pressure is left");
    assert_kind!(error, CoupledError::Flow(FlowError::NoPressure(_)));
    system.run_to(0.01, 0.8).expect("it goes on");
}

#[test]
fn conditions_and_rooms_that_mean_nothing_are_named() {
    let profile = |places: Vec<f64>| {
        FlowCondition::Recorded(Recorded {
            axis: Axis::X,
            places,
            times: vec![0.0],
            pressures: vec![0.0; 2],
        })
    };
    for condition in [
        FlowCondition::Pressure(f64::NAN),
        FlowCondition::Inflow(f64::INFINITY),
        FlowCondition::Wave(wave(0.0, 1.0)),
        profile(vec![0.0]),
        profile(vec![1.0, 0.0]),
    ] {
        let error = refused(one(), drained().side(5, condition.into()));
        assert_kind!(error, CoupledError::BadCondition(5, _));
    }
    let mut few = drained();
    few.sides.pop();
    assert_kind!(refused(one(), few), CoupledError::Sides(5, 6));
    let walls = Wall::cuboid([0.0; 3], [1.0; 3]);
    let ball = || Setup::new(vec![ball(0.5, 0.1)], law());
    let open = GrainSystem::new(ball().walls(walls.into_iter().take(4)));
    let mut four = drained();
    four.sides.truncate(4);
    assert_says(refused(open.expect("a ball"), four), "walls");
    let periodic = ball().periodic(0, 0.0, 1.0);
    let periodic = GrainSystem::new(periodic.walls(walls.into_iter().skip(2)));
    let error = refused(periodic.expect("a ball"), drained());
    assert_kind!(error, CoupledError::Periodic(0));
}

/// Above the limit nothing is moved, and the message says which part of it counts.
#[test]
fn a_step_above_the_limit_moves_nothing() {
    let mut system = one_drained();
    let limit = system.step_limit().expect("a limit");
    let before = system.grains().grains.position.to_vec();
    let error = system.step(1.001 * limit.step).expect_err("too long");
    assert_kind!(
        error,
        CoupledError::StepTooLarge(_, StepLimit { grain: 0, .. })
    );
    assert_eq!(before, system.grains().grains.position);
    assert_eq!(system.time(), 0.0);
}

/// One grain is enough: it sinks, and ends at rest on the floor with its buoyant weight.
#[test]
fn one_grain_sinks_to_the_floor() {
    let mut ball = grains(vec![Grain::new([0.5, 0.5, 0.22], 0.2, 2600.0)]).expect("a ball");
    ball.set_damping(0.3).expect("damping");
    let mut system = CoupledSystem::new(ball, drained()).expect("a system");
    system.run_to(4.0, 0.8).expect("a run");
    let floor = -system.grains().walls[4].force.z;
    let share = floor / -system.buoyant_weight().z;
    println!("the floor bears {share:.6} of the buoyant weight");
    close(share, 1.0, 0.01);
}

#[test]
fn a_state_of_other_grains_is_refused() {
    let mut state = serde_json::to_value(one_drained().save()).expect("saved");
    state["places"]["centres"] = serde_json::json!([]);
    let state = serde_json::from_value(state).expect("read");
    let conductance = Box::new(HydraulicRadius::default());
    let resumed = CoupledSystem::resume(state, vec![Box::new(law())], conductance);
    assert!(matches!(resumed, Err(CoupledError::BadState(_))));
}

#[test]
fn tables_that_do_not_fit_are_named() {
    let good = Recorded {
        axis: Axis::X,
        places: vec![0.0, 1.0],
        times: vec![0.0],
        pressures: vec![1.0, 2.0],
    };
    let changes: [(fn(&mut Recorded), _); 4] = [
        (|r| r.pressures = vec![1.0], "one pressure for each"),
        (|r| r.times = vec![], "one at least"),
        (|r| r.places = vec![1.0, 0.0], "places"),
        (|r| r.times = vec![f64::NAN], "finite"),
    ];
    for (change, words) in changes {
        let mut recorded = good.clone();
        change(&mut recorded);
        assert_says(recorded.problem().unwrap_or("nothing"), words);
    }
}
