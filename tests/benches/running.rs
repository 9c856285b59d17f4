//! A step of an assembled scene.

use sph_core::{StepLimit, System};
use sph_particles::setup::Assembled;

/// What a run does between two outputs.
pub fn advance<const D: usize>(parts: &mut Assembled<D>) {
    parts.flow.evaluate().expect("finite rates");
    let limits = parts.flow.step_limits().expect("all columns");
    let dt = StepLimit::least(&limits).expect("sound always limits").dt;
    parts.flow.world.dt = dt;
    let stepped = parts.integrator.step(&mut parts.flow, dt);
    stepped.expect("a good step");
}
