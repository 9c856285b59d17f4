//! What the equations keep, and the discrete system must keep as well.

use sph_core::{StepLimit, System, Vect, fields};
use sph_particles::setup::Assembled;
use sph_tests::assembled;

mod conservation;
mod energy;
mod lists;
mod scales;
mod symmetry;
mod symmetry_walls;
mod walls;

/// A shipped scene with overrides.
fn shipped(name: &str, overrides: &[&str]) -> Assembled<2> {
    assembled(&sph_tests::shipped(name, overrides))
}

/// Position and velocity of every particle, by its number.
type States = Vec<(Vect<2>, Vect<2>)>;

fn states(parts: &Assembled<2>) -> States {
    let free = &parts.flow.world.free;
    let positions = free.get(fields::POSITION).unwrap();
    let velocities = free.get(fields::VELOCITY).unwrap();
    let mut states = vec![(Vect::zeros(), Vect::zeros()); free.len()];
    for (k, i) in free.get(fields::IDENTITY).unwrap().iter().enumerate() {
        states[*i as usize] = (positions[k], velocities[k]);
    }
    states
}

/// Steps of a given length, or of the longest that the plugins allow; the rates are those of the end.
fn fly(parts: &mut Assembled<2>, steps: usize, dt: Option<f64>) {
    for _ in 0..steps {
        parts.flow.evaluate().unwrap();
        let dt = dt.unwrap_or_else(|| {
            let limits = parts.flow.step_limits().unwrap();
            StepLimit::least(&limits).expect("a limit").dt
        });
        parts.flow.world.dt = dt;
        parts.integrator.step(&mut parts.flow, dt).unwrap();
    }
    parts.flow.evaluate().unwrap();
}
