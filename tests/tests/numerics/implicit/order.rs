//! Orders in time, against the same flow with ever smaller steps.

use sph_core::{Vect, fields};
use sph_tests::{close, evaluated, scene, step};

/// Vortices that decay by e^−0.5 in the time that sound takes over half the box.
pub fn vortices(integrator: &str, viscosity: &str) -> String {
    format!(
        r#"
        title = "vortices"
        dimension = 2
        [run]
        end = 1.0
        [numerics]
        spacing = 0.05
        smoothing_ratio = 2.0
        [numerics.periodic]
        x = [0.0, 1.0]
        y = [0.0, 1.0]
        [smoother]
        [shifting]
        [integrator.{integrator}]
        {viscosity}
        [phase.fluid]
        density = 1.0
        speed_of_sound = 10.0
        [phase.fluid.rheology.newtonian]
        viscosity = 0.13
        [body.box]
        phase = "fluid"
        box = [[0.0, 0.0], [1.0, 1.0]]
        [body.box.initial.taylor-green]
        speed = 1.0
        length = 1.0
        kinematic_viscosity = 0.13
        density = 1.0
    "#
    )
}

const SPAN: f64 = 0.05;

/// Velocities after the span, by identity.
pub fn after(text: &str, steps: usize) -> Vec<Vect<2>> {
    let mut parts = evaluated::<2>(&scene(text, &[]));
    let dt = SPAN / steps as f64;
    for _ in 0..steps {
        step(&mut parts, dt);
    }
    let free = &parts.flow.world.free;
    let velocity = free.get(fields::VELOCITY).unwrap();
    let mut ordered = vec![Vect::zeros(); velocity.len()];
    for (id, u) in free.get(fields::IDENTITY).unwrap().iter().zip(velocity) {
        ordered[*id as usize] = *u;
    }
    ordered
}

fn order(integrator: &str, viscosity: &str) -> f64 {
    let text = vortices(integrator, viscosity);
    let runs = [20, 40, 80].map(|steps| after(&text, steps));
    let apart = |a: &[Vect<2>], b: &[Vect<2>]| -> f64 {
        let squares = a.iter().zip(b).map(|(a, b)| (a - b).norm_squared());
        squares.sum::<f64>().sqrt()
    };
    (apart(&runs[0], &runs[1]) / apart(&runs[1], &runs[2])).log2()
}

#[test]
fn backward_euler_is_of_first_order() {
    let tight = "[implicit-viscosity.backward-euler]\n[linear-solver.conjugate-gradient]\ntolerance = 1e-13";
    let found = order("symplectic-euler", tight);
    assert!((found - 1.0).abs() < 0.1, "order {found:.3}");
}

#[test]
fn crank_nicolson_with_leap_frog_is_of_second_order() {
    let tight = "[implicit-viscosity.crank-nicolson]\n[linear-solver.conjugate-gradient]\ntolerance = 1e-13";
    let found = order("leap-frog", tight);
    assert!((found - 2.0).abs() < 0.1, "order {found:.3}");
}

/// Explicitly: the order of every integrator for the flow as a whole.
#[test]
fn every_integrator_has_its_order_on_vortices() {
    for (integrator, stated) in [
        ("symplectic-euler", 1.0),
        ("verlet", 2.0),
        ("leap-frog", 2.0),
        ("predictor-corrector", 1.0),
    ] {
        let found = order(integrator, "");
        close(found, stated, 0.15, integrator);
    }
}
