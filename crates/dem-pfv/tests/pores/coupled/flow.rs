//! Forces, conditions, fluids that give way, and `darcy-cosine` (5.19).

use std::f64::consts::PI;

use dem_pfv::Axis;
use dem_pfv::coupled::{
    CoupledSystem, FlowCondition, FlowSetup, Fluid, Recorded, WallBoundary, Wave,
};
use dem_pfv::flow::Forces;
use dem_pfv::grains::{Control, GrainSystem, step_to_rest};

use crate::coupled::{BOX200, BOX1000, MODULUS, boxed, packing, sticking};

fn held(text: &str) -> GrainSystem {
    let mut grains = packing(text);
    grains.iter_mut().for_each(|g| g.held = true);
    GrainSystem::new(boxed(grains, MODULUS)).expect("grains")
}

/// Kept unit forces give what a sum over throats gives, on grains and walls.
#[test]
fn unit_forces_are_the_forces_of_the_flow() {
    let setup = sticking(FlowSetup::new(Fluid::new(1.0, 0.0)));
    let open = |p: f64| WallBoundary {
        sticks: true,
        ..WallBoundary::drained(p)
    };
    let setup = setup.side(2, open(0.0)).side(3, open(7.0));
    let mut system = CoupledSystem::new(held(BOX200), setup).expect("a system");
    system.step(1e-6).expect("a step");
    let forces = Forces::new(system.pores(), &system.pressures);
    let grains = system.grains().grains.external_force.iter().enumerate();
    let worst = grains
        .map(|(k, f)| (f - forces.on_sphere(k)).amax())
        .fold(0.0, f64::max);
    let walls = system.grains().walls.iter().enumerate();
    let wall = |w: usize| forces.wall_pressure[w] + forces.wall_viscous[w];
    let worst = walls
        .map(|(w, x)| (x.external_force - wall(w)).amax())
        .fold(worst, f64::max);
    println!("largest difference {worst:e} N of 7 N");
    assert!(worst < 7.0 * 1e-13, "{worst:e}");
}

/// The head over a bed falls from crest to trough along a cosine; below it p = A cos(pi x/L) cosh(pi (z + h)/L) /
/// cosh(pi h/L) in a uniform bed. Page, RMS over inner cells: 0.055 with 200, 0.041 with 1000, 0.032 with 5000; it must
/// fall, and the mean error be below 0.01. Means of two ways to stand the packings up; `examples/darcy.rs` has 5000.
#[test]
fn a_cosine_load_seeps_as_darcy_has_it() {
    let error = |text: &str, up: usize| {
        let wave = Wave {
            axis: Axis::X,
            crest: 0.0,
            half_length: 1.0,
            amplitude: 0.5,
            ramp: 0.0,
            period: None,
        };
        let top = WallBoundary {
            condition: FlowCondition::Wave(wave),
            sticks: false,
        };
        let setup = FlowSetup::new(Fluid::new(1.0, 0.0)).side(2 * up + 1, top);
        let mut system = CoupledSystem::new(held(text), setup).expect("a system");
        system.step(1e-6).expect("a step");
        let pores = system.pores();
        let cells = pores
            .mesh
            .cells
            .iter()
            .zip(&pores.centres)
            .zip(&system.pressures);
        let (mut square, mut sum, mut count) = (0.0, 0.0, 0.0);
        for ((_, at), p) in cells.filter(|((cell, _), _)| cell.walls() == 0) {
            let exact = 0.5 * (PI * at.x).cos() * (PI * at[up]).cosh() / PI.cosh();
            square += (p - exact) * (p - exact);
            sum += p - exact;
            count += 1.0;
        }
        (f64::sqrt(square / count), sum / count)
    };
    let mean = |text: &str| {
        let both = [error(text, 1), error(text, 2)];
        (0.5 * (both[0].0 + both[1].0), 0.5 * (both[0].1 + both[1].1))
    };
    let (few, many) = (mean(BOX200), mean(BOX1000));
    println!(
        "RMS {:.4} with 200, {:.4} with 1000 grains; means {:+.4}, {:+.4}",
        few.0, many.0, few.1, many.1
    );
    assert!(many.0 < few.0, "{few:?} {many:?}");
    assert!(many.1.abs() < 0.01, "{many:?}");
}

/// A profile of pressures is linear between its places and constant beyond; a wave swings with its period.
#[test]
fn profiles_and_waves_press_as_they_say() {
    let profile = Recorded {
        axis: Axis::X,
        places: vec![0.25, 0.75],
        times: vec![0.0],
        pressures: vec![10.0, 20.0],
    };
    let side = WallBoundary {
        condition: FlowCondition::Recorded(profile),
        sticks: false,
    };
    let setup = FlowSetup::new(Fluid::new(1.0, 0.0)).side(5, side);
    let mut system = CoupledSystem::new(held(BOX200), setup).expect("a system");
    system.step(1e-6).expect("a step");
    let top = dem_pfv::triangulation::Vertex::Wall(5);
    for &cell in system.pores().mesh.cells_around(top) {
        let x = system.pores().centres[cell as usize].x;
        let expected = 10.0 + 20.0 * (x.clamp(0.25, 0.75) - 0.25);
        let p = system.pressures[cell as usize];
        assert!((p - expected).abs() < 1e-12, "{p} Pa at {x} m");
    }
    let wave = Wave {
        axis: Axis::X,
        crest: 0.5,
        half_length: 2.0,
        amplitude: 3.0,
        ramp: 2.0,
        period: Some(4.0),
    };
    let at = |x: f64, t: f64| wave.pressure(&dem_pfv::coupled::Vector::new(x, 0.0, 0.0), t);
    assert!((at(0.5, 1.0) - 5.0).abs() < 1e-12 && (at(2.5, 3.0) - 9.0).abs() < 1e-12);
    assert!(at(1.5, 1.0).abs() < 1e-12 && at(0.5, 2.0).abs() < 1e-12);
    // A value costs no mesh and no matrix, another kind does its part too.
    let mesh = system.meshes;
    system
        .set_side(5, WallBoundary::drained(4.0))
        .expect("a side");
    system.step(1e-6).expect("a step");
    assert!(system.pressures.iter().all(|p| (p - 4.0).abs() < 1e-9));
    let inflow = WallBoundary {
        condition: FlowCondition::Inflow(0.01),
        sticks: false,
    };
    system.set_side(4, inflow).expect("a side");
    system.measure_inflow();
    system.step(1e-6).expect("a step");
    let out = -system.inflow(5).expect("a flux");
    println!("0.01 m3/s in, {out} out");
    assert!(
        (out / 0.01 - 1.0).abs() < 1e-9 && system.meshes == mesh,
        "{out}"
    );
}

/// Undrained loading: skeleton and fluid are parallel springs, p = sigma K_f/n / (E_oed + K_f/n), Biot's coefficient
/// being 1. At a bulk modulus with which they share alike; the stiffness of 200 grains is measured dry.
#[test]
fn a_closed_box_shares_a_load_between_grains_and_fluid() {
    let (confining, load) = (5e4, 500.0);
    let press = |grains: &mut GrainSystem, stress: f64| {
        let mass = 0.1 * grains.grains.mass.iter().sum::<f64>();
        grains.walls[5].control = Control::Piston { stress, mass };
    };
    let mut dry = GrainSystem::new(boxed(packing(BOX200), MODULUS).damping(0.4)).expect("grains");
    press(&mut dry, confining);
    step_to_rest(&mut dry, 0.8, 1e-6, 100_000).expect("at rest");
    let state = dry.save();
    let height = |g: &GrainSystem| g.box_lengths().expect("a box")[2];
    let start = height(&dry);
    press(&mut dry, confining + load);
    step_to_rest(&mut dry, 0.8, 1e-7, 100_000).expect("at rest");
    let modulus = load * start / (start - height(&dry));
    let mut grains =
        GrainSystem::resume(state, crate::coupled::box_of_laws(MODULUS)).expect("grains");
    let porosity = grains.porosity().expect("a box");
    press(&mut grains, confining + load);
    let bulk_modulus = Some(porosity * modulus);
    let mut setup = FlowSetup::new(Fluid {
        bulk_modulus,
        ..Fluid::new(1.0, 0.0)
    });
    setup.remeshing.strain = Some(0.002);
    let mut system = CoupledSystem::new(grains, setup).expect("a system");
    let step = 0.5 * system.step_limit().expect("a limit").step;
    for _ in 0..1500 {
        system.step(step).expect("a step");
    }
    let share = system.layer_pressure(2, 0.0, 1.0).expect("pores") / load;
    let squeezed = (start - height(system.grains())) / start * modulus / load;
    println!(
        "E_oed {modulus:.4e} Pa: the fluid bears {share:.4}, the grains {squeezed:.4} of the load ({} meshes)",
        system.meshes
    );
    assert!(
        (share - 0.5).abs() < 0.005 && (squeezed - 0.5).abs() < 0.005,
        "{share} {squeezed}"
    );
}

/// What leaves through the walls is what the room lost, whatever the grains do: the balance of all pores.
#[test]
fn the_room_loses_what_flows_out() {
    let mut grains = GrainSystem::new(boxed(packing(BOX200), MODULUS)).expect("grains");
    grains.walls[5].velocity.z = -0.01;
    let setup = FlowSetup::new(Fluid::new(10.0, 0.0)).side(4, WallBoundary::drained(0.0));
    let mut system = CoupledSystem::new(grains, setup).expect("a system");
    for _ in 0..20 {
        system.step(1e-4).expect("a step");
    }
    let total: f64 = system.rates.iter().sum();
    assert!((total / -0.01 - 1.0).abs() < 1e-9, "{total} m3/s of 0.01");
    // Fluxes of the coming step belong to these rates.
    system.measure_inflow();
    system.step(1e-4).expect("a step");
    let through = system.inflow(4).expect("a flux");
    println!("{through:.6e} m3/s through the floor, {total:.6e} lost by the pores");
    assert!((through / total - 1.0).abs() < 1e-9, "{through} {total}");
    assert_eq!(system.inflow(5), Some(0.0));
}

#[test]
fn a_bilinear_load_comes_back_and_stays_beyond_the_ends() {
    let (places, times) = (vec![0.0, 0.5, 2.0], vec![0.0, 0.1, 0.4, 1.0]);
    let load = |x: f64, t: f64| (3.0 - 2.0 * x) * (1.0 + 5.0 * t);
    let rows = times
        .iter()
        .flat_map(|t| places.iter().map(|x| load(*x, *t)));
    let recorded = Recorded {
        axis: Axis::X,
        pressures: rows.collect(),
        places,
        times,
    };
    assert_eq!(recorded.problem(), None);
    for [x, t] in [[0.0, 0.0], [0.2, 0.05], [1.7, 0.39], [2.0, 1.0], [0.5, 0.4]] {
        let off = (recorded.pressure(x, t) - load(x, t)).abs();
        assert!(off < 1e-12, "{off} Pa at {x} m and {t} s");
    }
    assert_eq!(recorded.pressure(-1.0, -1.0), load(0.0, 0.0));
    assert_eq!(recorded.pressure(9.0, 9.0), load(2.0, 1.0));
}
