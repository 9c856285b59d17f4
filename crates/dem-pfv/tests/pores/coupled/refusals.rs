//! Refusals name the grain, the wall or the cell; extreme flows that can be computed are stable.

use dem_pfv::Axis;
use dem_pfv::coupled::{
    CoupledError, CoupledSystem, FlowCondition, FlowSetup, Fluid, Recorded, StepLimit,
    WallBoundary, Wave,
};
use dem_pfv::flow::{FlowError, HydraulicRadius};
use dem_pfv::grains::{Grain, GrainError, GrainSystem, LinearElastic, Setup, Wall};

fn grains(spheres: Vec<Grain>) -> Result<GrainSystem, GrainError> {
    let setup = Setup::new(spheres, LinearElastic::new(1e6, 0.5, 0.3));
    GrainSystem::new(
        setup
            .walls(Wall::cuboid([0.0; 3], [1.0; 3]))
            .gravity([0.0, 0.0, -9.81]),
    )
}

fn ball(x: f64, radius: f64) -> Grain {
    Grain::new([x, 0.5, 0.5], radius, 2600.0)
}

fn drained() -> FlowSetup {
    FlowSetup::new(Fluid::new(10.0, 1000.0)).side(5, WallBoundary::drained(0.0))
}

fn refused(grains: GrainSystem, setup: FlowSetup) -> CoupledError {
    match CoupledSystem::new(grains, setup) {
        Ok(_) => panic!("not refused"),
        Err(error) => error,
    }
}

fn one() -> GrainSystem {
    grains(vec![ball(0.5, 0.2)]).expect("a ball")
}

#[test]
fn grains_that_overlap_or_are_in_walls_are_named() {
    let error =
        CoupledError::from(grains(vec![ball(0.3, 0.2), ball(0.65, 0.2)]).expect_err("overlap"));
    assert!(
        error
            .to_string()
            .starts_with("grains 0 and 1 overlap by 5.000e-2 m"),
        "{error}"
    );
    let error =
        CoupledError::from(grains(vec![ball(0.5, 0.1), ball(0.9, 0.2)]).expect_err("in the wall"));
    assert!(
        error.to_string().contains("grain 1 reaches") && error.to_string().contains("wall 1"),
        "{error}"
    );
    let error = CoupledError::from(grains(vec![ball(1.5, 0.2)]).expect_err("beyond the wall"));
    assert!(
        matches!(error, CoupledError::Grains(GrainError::InWall(0, ..))),
        "{error}"
    );
    assert!(matches!(grains(vec![]), Err(GrainError::NoGrains)));
    // Moved by hand into each other while the fluid is there.
    let mut system = CoupledSystem::new(
        grains(vec![ball(0.25, 0.2), ball(0.75, 0.2)]).expect("two"),
        drained(),
    )
    .expect("two");
    system.grains_mut().grains.position[1].x = 0.5;
    let error = system.remesh().expect_err("overlap");
    assert!(
        matches!(error, CoupledError::Flow(FlowError::Overlap(0, 1, ..))),
        "{error}"
    );
}

#[test]
fn numbers_out_of_range_are_named() {
    for (fluid, what) in [
        (Fluid::new(0.0, 1000.0), "the viscosity is 0"),
        (Fluid::new(-1.0, 1000.0), "the viscosity is -1"),
        (Fluid::new(f64::NAN, 1000.0), "the viscosity is NaN"),
        (Fluid::new(1.0, -1.0), "the fluid's density is -1"),
        (
            Fluid {
                bulk_modulus: Some(0.0),
                ..Fluid::new(1.0, 1000.0)
            },
            "the bulk modulus is 0",
        ),
    ] {
        let error = refused(
            one(),
            FlowSetup::new(fluid).side(5, WallBoundary::drained(0.0)),
        );
        assert!(error.to_string().starts_with(what), "{error}");
    }
    let mut setup = drained();
    setup.remeshing.strain = Some(-1.0);
    let error = refused(one(), setup);
    assert!(
        error.to_string().contains("strain for remeshing"),
        "{error}"
    );
    let mut system = CoupledSystem::new(one(), drained()).expect("a system");
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(system.step(step), Err(CoupledError::Number(_))));
    }
}

#[test]
fn closed_walls_are_refused_unless_the_fluid_gives_way() {
    let closed = FlowSetup::new(Fluid::new(10.0, 1000.0));
    let error = refused(one(), closed);
    assert!(
        matches!(error, CoupledError::Flow(FlowError::NoPressure(0))),
        "{error}"
    );
    let soft = FlowSetup::new(Fluid {
        bulk_modulus: Some(1e6),
        ..Fluid::new(10.0, 1000.0)
    });
    let mut system = CoupledSystem::new(one(), soft).expect("a system");
    system.run_to(0.02, 0.8).expect("a run");
    assert!(system.pressures.iter().all(|p| p.is_finite()));
    // A wall that is closed while the run goes on: the old condition stays.
    let mut system = CoupledSystem::new(one(), drained()).expect("a system");
    let error = system
        .set_side(5, WallBoundary::closed())
        .expect_err("no pressure is left");
    assert!(
        matches!(error, CoupledError::Flow(FlowError::NoPressure(_))),
        "{error}"
    );
    system.run_to(0.01, 0.8).expect("it goes on");
}

#[test]
fn conditions_and_rooms_that_mean_nothing_are_named() {
    let wave = |half_length: f64| {
        FlowCondition::Wave(Wave {
            axis: Axis::X,
            crest: 0.0,
            half_length,
            amplitude: 1.0,
            ramp: 0.0,
            period: None,
        })
    };
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
        wave(0.0),
        profile(vec![0.0]),
        profile(vec![1.0, 0.0]),
    ] {
        let side = WallBoundary {
            condition,
            sticks: false,
        };
        let error = refused(one(), drained().side(5, side));
        assert!(matches!(error, CoupledError::BadCondition(5, _)), "{error}");
    }
    let mut few = drained();
    few.sides.pop();
    assert!(matches!(refused(one(), few), CoupledError::Sides(5, 6)));
    let law = || LinearElastic::new(1e6, 0.5, 0.3);
    let open = GrainSystem::new(
        Setup::new(vec![ball(0.5, 0.1)], law())
            .walls(Wall::cuboid([0.0; 3], [1.0; 3])[..4].to_vec()),
    );
    let mut four = drained();
    four.sides.truncate(4);
    assert!(
        refused(open.expect("a ball"), four)
            .to_string()
            .contains("walls")
    );
    let periodic = Setup::new(vec![ball(0.5, 0.1)], law()).periodic(0, 0.0, 1.0);
    let periodic = GrainSystem::new(periodic.walls(Wall::cuboid([0.0; 3], [1.0; 3])[2..].to_vec()))
        .expect("a ball");
    assert!(matches!(
        refused(periodic, drained()),
        CoupledError::Periodic(0)
    ));
}

/// Above the limit nothing is moved, and the message says which part of it counts.
#[test]
fn a_step_above_the_limit_moves_nothing() {
    let mut system = CoupledSystem::new(one(), drained()).expect("a system");
    let limit = system.step_limit().expect("a limit");
    let before = system.grains().grains.position.to_vec();
    let error = system.step(1.001 * limit.step).expect_err("too long");
    assert!(
        matches!(
            error,
            CoupledError::StepTooLarge(_, StepLimit { grain: 0, .. })
        ),
        "{error}"
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
    assert!((share - 1.0).abs() < 0.01, "{share}");
}

#[test]
fn a_state_of_other_grains_is_refused() {
    let system = CoupledSystem::new(one(), drained()).expect("a system");
    let mut state = serde_json::to_value(system.save()).expect("saved");
    state["places"]["centres"]
        .as_array_mut()
        .expect("a list")
        .clear();
    let state = serde_json::from_value(state).expect("read");
    let laws: Vec<Box<dyn dem_pfv::grains::ContactLaw>> =
        vec![Box::new(LinearElastic::new(1e6, 0.5, 0.3))];
    assert!(matches!(
        CoupledSystem::resume(state, laws, Box::new(HydraulicRadius::default())),
        Err(CoupledError::BadState(_))
    ));
}

#[test]
fn tables_that_do_not_fit_are_named() {
    let good = Recorded {
        axis: Axis::X,
        places: vec![0.0, 1.0],
        times: vec![0.0],
        pressures: vec![1.0, 2.0],
    };
    let with = |change: fn(&mut Recorded)| {
        let mut recorded = good.clone();
        change(&mut recorded);
        recorded.problem().unwrap_or("nothing").to_string()
    };
    assert!(with(|r| r.pressures = vec![1.0]).contains("one pressure for each"));
    assert!(with(|r| r.times = vec![]).contains("one at least"));
    assert!(with(|r| r.places = vec![1.0, 0.0]).contains("places"));
    assert!(with(|r| r.times = vec![f64::NAN]).contains("finite"));
}
