//! Strains and elastic stresses at walls that slip.

use std::sync::Arc;

use sph_core::{Stage, Symmetric, Vect, fields};
use sph_neighbours::interactions;
use sph_particles::setup::Assembled;
use sph_soil::stress::{GradientStage, Renormalised, StressDivergence};
use sph_tests::{evaluated, move_as, scene};

/// A periodic layer of shaken particles, 12 rows on a smooth floor.
fn layer() -> Assembled<2> {
    let text = include_str!("layer.toml");
    evaluated(&scene(text, &[]))
}

/// u = (3y, −2y) over a floor at rest: the floor stops the second and does not know the first.
#[test]
fn a_smooth_floor_counts_in_the_strain_across_it_and_not_along_it() {
    let mut parts = layer();
    move_as(&mut parts, |x| Vect::from([3.0 * x[1], -2.0 * x[1]]));
    let world = &mut parts.flow.world;
    let mut stage = GradientStage::<2> {
        formula: Arc::new(Renormalised::default()),
        phases: None,
    };
    stage.run(world).unwrap();
    let gradients = world.free.get(fields::VELOCITY_GRADIENT).unwrap();
    let mut most: f64 = 0.0;
    for gradient in gradients {
        let exact = [[0.0, 3.0], [0.0, -2.0]];
        for (k, row) in exact.iter().enumerate() {
            for (l, value) in row.iter().enumerate() {
                most = most.max((gradient[(k, l)] - value).abs());
            }
        }
    }
    assert!(most < 1e-12, "off by {most} 1/s");
}

/// A smooth floor pushes upwards alone, whatever stress the layer carries.
#[test]
fn stresses_leave_no_force_along_a_smooth_floor() {
    let mut parts = layer();
    let world = &mut parts.flow.world;
    let stress = world.free.get_mut(fields::CARRIED_STRESS).unwrap();
    for (k, tau) in stress.iter_mut().enumerate() {
        let value = |j: usize| 100.0 * ((k * 7 + j * 3) as f64).sin();
        *tau = Symmetric::part_of([
            [value(0), value(1), 0.0],
            [value(1), -value(0), 0.0],
            [0.0; 3],
        ]);
    }
    let terms = [StressDivergence::boxed()];
    let mut acceleration = vec![Vect::zeros(); world.free.len()];
    interactions(world, &terms, &mut acceleration, None).unwrap();
    let mass = world.free.get(fields::MASS).unwrap();
    let forces = mass.iter().zip(&acceleration);
    let (along, scale) = forces.fold((0.0, 0.0), |(sum, scale), (m, a)| {
        (sum + m * a[0], scale + m * a[0].abs())
    });
    assert!(scale > 1.0, "nothing pushes: {scale} N");
    assert!((along / scale).abs() < 1e-12, "{along} N of {scale} N");
}
