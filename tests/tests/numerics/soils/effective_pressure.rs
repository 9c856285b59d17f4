//! The effective pressure by conjugate gradients and by Jacobi's iteration.

use std::time::Instant;

use sph_core::{StepLimit, System, fields};
use sph_neighbours::World;
use sph_particles::setup::Assembled;
use sph_soil::stress::{Laplace, PressureSolver, Soils};
use sph_tests::{evaluated, near, shipped};

/// ρ and Δρ of the bed, kg/m³.
const DENSITY: f64 = 1992.0;
const BUOYANT: f64 = 992.0;

/// A bed of so many rows of 5 mm under as much water.
fn bed(rows: usize) -> Assembled<2> {
    let height = 5e-3 * rows as f64;
    let bed = format!("body.bed.box=[[0.0, 0.0], [0.1, {height}]]");
    let water = format!("body.water.box=[[0.0, {height}], [0.1, {}]]", 2.0 * height);
    evaluated(&shipped("saturated-bed-at-rest", &[&bed, &water]))
}

/// Iterations of a cold start and the pressures.
fn cold(parts: &mut Assembled<2>, solver: PressureSolver, tolerance: f64) -> (usize, Vec<f64>) {
    let world = &mut parts.flow.world;
    let pressure = world.free.get_mut(fields::EFFECTIVE_PRESSURE).unwrap();
    pressure.fill(0.0);
    let start = Instant::now();
    let (iterations, pressure) = from_here(world, solver, tolerance);
    println!("{solver:?}: {iterations} in {:?}", start.elapsed());
    (iterations, pressure)
}

/// The same from the pressures that are there.
fn from_here(world: &mut World<2>, solver: PressureSolver, tolerance: f64) -> (usize, Vec<f64>) {
    let laplace = Laplace {
        pore_density: DENSITY - BUOYANT,
        solver,
        tolerance,
        ..Laplace::default()
    };
    // Phases in the order of their names: sand, water.
    let soils: Soils = vec![Some(DENSITY), None];
    let report = laplace
        .solve(soils, world)
        .unwrap_or_else(|e| panic!("{e}"));
    let pressure = world.free.get(fields::EFFECTIVE_PRESSURE).unwrap();
    (report.iterations, pressure.to_vec())
}

#[test]
fn both_solvers_agree_on_a_flat_bed() {
    let mut parts = bed(20);
    let (_, gradients) = cold(&mut parts, PressureSolver::ConjugateGradient, 1e-9);
    let (_, sweeps) = cold(&mut parts, PressureSolver::Jacobi, 1e-9);
    let largest = gradients.iter().copied().fold(0.0, f64::max);
    let pairs = gradients.iter().zip(&sweeps);
    let apart = pairs.fold(0.0_f64, |most, (a, b)| most.max((a - b).abs())) / largest;
    assert!(apart < 1e-5, "{apart:e} of the bottom's pressure apart");
    let exact = BUOYANT * 9.81 * (0.1 - 2.5e-3);
    near(largest, exact, 1e-4, "Pa at the bottom");
}

#[test]
fn sweeps_grow_as_the_square_of_the_rows_and_gradients_as_the_rows() {
    let rows = [10, 20, 40];
    let found = rows.map(|rows| {
        let mut parts = bed(rows);
        let of = |solver, parts: &mut _| cold(parts, solver, 1e-5).0 as f64;
        [PressureSolver::ConjugateGradient, PressureSolver::Jacobi].map(|s| of(s, &mut parts))
    });
    let told = format!("for {rows:?} rows conjugate gradients and Jacobi take {found:?}");
    println!("{told}");
    let order = |k: usize| (found[2][k] / found[1][k]).log2();
    assert!(order(0) < 1.3, "{told}");
    assert!((1.7..2.3).contains(&order(1)), "{told}");
}

#[test]
fn from_the_last_pressure_both_take_a_few() {
    let mut parts = bed(20);
    let mut sums = [0, 0];
    let mut counted = 0;
    for _ in 0..100 {
        let limits = parts.flow.limits();
        let dt = 0.9 * StepLimit::least(&limits).unwrap().dt;
        parts.flow.world.dt = dt;
        parts.integrator.step(&mut parts.flow, dt).unwrap();
        let free = &parts.flow.world.free;
        let identity = free.get(fields::IDENTITY).unwrap().to_vec();
        let last = free.get(fields::EFFECTIVE_PRESSURE).unwrap().to_vec();
        parts.flow.evaluate().unwrap();
        let world = &mut parts.flow.world;
        let solved = world.free.get(fields::EFFECTIVE_PRESSURE).unwrap().to_vec();
        if world.free.get(fields::IDENTITY).unwrap() != identity {
            continue;
        }
        counted += 1;
        let solvers = [PressureSolver::ConjugateGradient, PressureSolver::Jacobi];
        for (sum, solver) in sums.iter_mut().zip(solvers) {
            let pressure = world.free.get_mut(fields::EFFECTIVE_PRESSURE).unwrap();
            pressure.copy_from_slice(&last);
            *sum += from_here(world, solver, 1e-5).0;
        }
        let pressure = world.free.get_mut(fields::EFFECTIVE_PRESSURE).unwrap();
        pressure.copy_from_slice(&solved);
    }
    let mean = sums.map(|sum| sum as f64 / f64::from(counted));
    println!("means of {mean:?} in {counted} steps");
    assert!(counted > 50 && mean[1] < 100.0, "{mean:?} {counted}");
}
