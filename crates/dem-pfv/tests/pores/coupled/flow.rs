//! Forces, conditions, fluids that give way, and `darcy-cosine` (5.19).

use std::f64::consts::PI;

use dem_pfv::Axis;
use dem_pfv::coupled::{
    CoupledSystem, FlowCondition, FlowSetup, Fluid, Recorded, Vector, WallBoundary, Wave,
};
use dem_pfv::flow::Forces;
use dem_pfv::grains::{Control, GrainSystem, step_to_rest};
use dem_pfv::triangulation::Vertex;

use crate::coupled::{boxed, boxed_laws, packed, packing, sticking, wave};
use crate::{BOX200, BOX1000, close};

fn held(text: &str) -> GrainSystem {
    let mut grains = packing(text);
    grains.iter_mut().for_each(|g| g.held = true);
    GrainSystem::new(boxed(grains)).expect("grains")
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
    let grains = grains.map(|(k, f)| (f - forces.on_sphere(k)).amax());
    let walls = system.grains().walls.iter().enumerate();
    let wall = |w: usize| forces.wall_pressure[w] + forces.wall_viscous[w];
    let walls = walls.map(|(w, x)| (x.external_force - wall(w)).amax());
    let worst = grains.chain(walls).fold(0.0, f64::max);
    println!("largest difference {worst:e} N of 7 N");
    assert!(worst < 7.0 * 1e-13, "{worst:e}");
}

/// The head over a bed falls from crest to trough along a cosine; below it p = A cos(pi x/L) cosh(pi (z + h)/L) /
/// cosh(pi h/L) in a uniform bed. Page, RMS over inner cells: 0.055 with 200, 0.041 with 1000, 0.032 with 5000; it must
/// fall, and the mean error be below 0.01. Means of two ways to stand the packings up; `examples/darcy.rs` has 5000.
#[test]
fn a_cosine_load_seeps_as_darcy_has_it() {
    let error = |text: &str, up: usize| {
        let top = FlowCondition::Wave(wave(1.0, 0.5));
        let setup = FlowSetup::new(Fluid::new(1.0, 0.0)).side(2 * up + 1, top.into());
        let mut system = CoupledSystem::new(held(text), setup).expect("a system");
        system.step(1e-6).expect("a step");
        let pores = system.pores();
        let cells = pores.mesh.cells.iter().zip(&pores.centres);
        let cells = cells.zip(&system.pressures);
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
    let side = FlowCondition::Recorded(profile);
    let setup = FlowSetup::new(Fluid::new(1.0, 0.0)).side(5, side.into());
    let mut system = CoupledSystem::new(held(BOX200), setup).expect("a system");
    system.step(1e-6).expect("a step");
    for &cell in system.pores().mesh.cells_around(Vertex::Wall(5)) {
        let x = system.pores().centres[cell as usize].x;
        let expected = 10.0 + 20.0 * (x.clamp(0.25, 0.75) - 0.25);
        close(system.pressures[cell as usize], expected, 1e-12);
    }
    let wave = Wave {
        crest: 0.5,
        ramp: 2.0,
        period: Some(4.0),
        ..wave(2.0, 3.0)
    };
    for (x, t, pressure) in [
        (0.5, 1.0, 5.0),
        (2.5, 3.0, 9.0),
        (1.5, 1.0, 0.0),
        (0.5, 2.0, 0.0),
    ] {
        close(wave.pressure(&Vector::new(x, 0.0, 0.0), t), pressure, 1e-12);
    }
    // A value costs no mesh and no matrix, another kind does its part too.
    let mesh = system.meshes;
    let drained = system.set_side(5, WallBoundary::drained(4.0));
    drained.expect("a side");
    system.step(1e-6).expect("a step");
    assert!(system.pressures.iter().all(|p| (p - 4.0).abs() < 1e-9));
    let inflow = FlowCondition::Inflow(0.01);
    system.set_side(4, inflow.into()).expect("a side");
    system.measure_inflow();
    system.step(1e-6).expect("a step");
    let out = -system.inflow(5).expect("a flux");
    println!("0.01 m3/s in, {out} out");
    close(out / 0.01, 1.0, 1e-9);
    assert_eq!(system.meshes, mesh);
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
    let mut dry = GrainSystem::new(boxed(packing(BOX200)).damping(0.4)).expect("grains");
    press(&mut dry, confining);
    step_to_rest(&mut dry, 0.8, 1e-6, 100_000).expect("at rest");
    let state = dry.save();
    let height = |g: &GrainSystem| g.box_lengths().expect("a box")[2];
    let start = height(&dry);
    press(&mut dry, confining + load);
    step_to_rest(&mut dry, 0.8, 1e-7, 100_000).expect("at rest");
    let modulus = load * start / (start - height(&dry));
    let mut grains = GrainSystem::resume(state, boxed_laws()).expect("grains");
    let porosity = grains.porosity().expect("a box");
    press(&mut grains, confining + load);
    let mut setup = FlowSetup::new(Fluid::new(1.0, 0.0));
    setup.fluid.bulk_modulus = Some(porosity * modulus);
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
    close(share, 0.5, 0.005);
    close(squeezed, 0.5, 0.005);
}

/// What leaves through the walls is what the room lost, whatever the grains do: the balance of all pores.
#[test]
fn the_room_loses_what_flows_out() {
    let mut grains = packed(BOX200);
    grains.walls[5].velocity.z = -0.01;
    let setup = FlowSetup::new(Fluid::new(10.0, 0.0)).side(4, WallBoundary::drained(0.0));
    let mut system = CoupledSystem::new(grains, setup).expect("a system");
    for _ in 0..20 {
        system.step(1e-4).expect("a step");
    }
    let total: f64 = system.rates.iter().sum();
    close(total / -0.01, 1.0, 1e-9);
    // Fluxes of the coming step belong to these rates.
    system.measure_inflow();
    system.step(1e-4).expect("a step");
    let through = system.inflow(4).expect("a flux");
    println!("{through:.6e} m3/s through the floor, {total:.6e} lost by the pores");
    close(through / total, 1.0, 1e-9);
    assert_eq!(system.inflow(5), Some(0.0));
}

#[test]
fn a_bilinear_load_comes_back_and_stays_beyond_the_ends() {
    let (places, times) = (vec![0.0, 0.5, 2.0], vec![0.0, 0.1, 0.4, 1.0]);
    let load = |x: f64, t: f64| (3.0 - 2.0 * x) * (1.0 + 5.0 * t);
    let row = |t: &f64| places.iter().map(|x| load(*x, *t)).collect::<Vec<_>>();
    let recorded = Recorded {
        axis: Axis::X,
        pressures: times.iter().flat_map(row).collect(),
        places,
        times,
    };
    assert_eq!(recorded.problem(), None);
    for [x, t] in [[0.0, 0.0], [0.2, 0.05], [1.7, 0.39], [2.0, 1.0], [0.5, 0.4]] {
        close(recorded.pressure(x, t), load(x, t), 1e-12);
    }
    assert_eq!(recorded.pressure(-1.0, -1.0), load(0.0, 0.0));
    assert_eq!(recorded.pressure(9.0, 9.0), load(2.0, 1.0));
}
