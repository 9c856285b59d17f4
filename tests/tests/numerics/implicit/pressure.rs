//! Pressure from the end of the step.

use sph_core::{System, Vect, fields};
use sph_multiphase as _;
use sph_multiphase::FREE_SURFACE;
use sph_tests::{assembled, bench, close, scene};

use crate::implicit::order::{after, vortices};

/// Root of the mean square over that of `b`.
fn apart(a: &[Vect<2>], b: &[Vect<2>]) -> f64 {
    let squares = a.iter().zip(b).map(|(a, b)| (a - b).norm_squared());
    let whole = b.iter().map(|b| b.norm_squared());
    (squares.sum::<f64>() / whole.sum::<f64>()).sqrt()
}

#[test]
fn with_small_steps_it_is_the_explicit_scheme_to_first_order() {
    let ahead = "[pressure.implicit]\ntolerance = 1e-12";
    let difference = |steps| {
        let solved = after(&vortices("symplectic-euler", ahead), steps);
        apart(&solved, &after(&vortices("symplectic-euler", ""), steps))
    };
    let runs = [160, 320, 640].map(difference);
    let order = (runs[1] / runs[2]).log2();
    close(order, 1.0, 0.15, "order of the difference");
}

#[test]
fn a_scene_that_asks_for_no_step_or_no_solve_is_refused_with_its_line() {
    let scene = format!(
        "{}\n[pressure.implicit]\ncourant = 0.0\n",
        sph_tests::DAM_BREAK
    );
    let bench = bench!(&scene);
    let refused = bench.refused("run scene.toml --quiet --out r");
    refused.says("courant = 0.0");
    assert!(!bench.path("r").exists());
}

#[test]
fn a_surface_that_the_scene_does_not_name_is_refused() {
    let scene = format!("{}\n[pressure.implicit]\n", sph_tests::DAM_BREAK);
    let bench = bench!(&scene);
    let outcome = bench.call("run scene.toml --quiet --out r");
    assert_ne!(outcome.code, Some(0));
    outcome.says("[surface.cone-test]");
}

/// Water in a tank of 9 by 9 spacings, 14 rows deep, its particles up to 6 % of a spacing off the lattice.
fn tank() -> Vec<(Vect<3>, f64)> {
    let text = include_str!("tank.toml");
    let mut parts = assembled::<3>(&scene(text, &[]));
    let free = &mut parts.flow.world.free;
    let mut position = free.take(fields::POSITION).expect("positions");
    for (k, x) in position.iter_mut().enumerate() {
        *x += Vect::from_fn(|axis, _| 6e-3 * (12.9898 * (3 * k + axis) as f64).sin());
    }
    let places = position.clone();
    free.put(fields::POSITION, position).expect("positions");
    parts.flow.evaluate().expect("a state");
    let surface = parts.flow.world.free.get(FREE_SURFACE).expect("surfaces");
    places.into_iter().zip(surface.iter().copied()).collect()
}

/// In edges and corners walls fill most of the support, and what is left of ∇C is noise. Held at the pressure of a surface, a
/// corner had 1.6 kPa for 7 kPa after one step.
#[test]
fn edges_and_corners_of_a_tank_are_no_free_surface() {
    let particles = tank();
    // A support and a row below the surface.
    let deep = |x: &Vect<3>| x[2] < 0.9;
    let wrong = particles.iter().filter(|(x, s)| deep(x) && *s > 0.0);
    let found = particles.iter().filter(|(_, s)| *s == 2.0).count();
    println!("{found} particles at the surface of 81");
    assert_eq!(wrong.count(), 0, "of those deep in the water");
    assert_eq!(found, 81, "the first row and nobody else is at the surface");
}
