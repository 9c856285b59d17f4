//! The state with which a run begins.

use std::path::Path;

use sph_run::{Identity, Start, Watch};
use sph_scene::Scene;
use sph_solver::Flow;
use sph_solver::step::Hooked;

use crate::RunError;
use crate::running::checkpoint;
use crate::running::counters::Counters;

/// Puts the flow where the run begins, and returns the counts until there.
pub fn begin<const D: usize>(
    scene: &Scene,
    identity: &Identity,
    start: &Start,
    own: &Path,
    flow: &mut Flow<D>,
    observer: &mut Watch<'_>,
) -> Result<Counters, RunError> {
    let mut counters = Counters::begin();
    if start.goes_on() {
        let identity = (*start == Start::Resumed).then_some(identity);
        counters = checkpoint::load(flow, scene, own, identity)?;
        flow.recount(&counters.left);
        for Hooked { hook, .. } in &mut flow.hooks.all {
            if let Some(counts) = counters.works.remove(&hook.name()) {
                hook.resume(counts);
            }
        }
        let (time, step) = (flow.world.time, counters.steps);
        observer.message(&format!("resuming at t = {time:.6} s, step {step}"));
        return Ok(counters);
    }
    if let Start::From(other) = start {
        checkpoint::start_from(flow, scene, other)?;
        let time = flow.world.time;
        let from = other.display();
        observer.message(&format!("starting at t = {time:.6} s from {from}"));
        counters.started_at = Some(time.to_bits());
    }
    Ok(counters)
}
