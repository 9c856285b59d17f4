//! Where a run begins: afresh, or from a checkpoint.

use sph_io::IoError;
use sph_scene::Scene;
use sph_solver::Flow;
use sph_solver::step::Hooked;

use crate::failure::error::RunError;
use crate::running::checkpoint;
use crate::running::counters::Counters;
use crate::running::driver::Observer;
use crate::running::options::{RunOptions, Start};

/// Puts the flow where the run begins, and gives what has been counted until there. Who `writes` clears the folder.
pub fn begin<const D: usize>(
    scene: &Scene,
    options: &RunOptions,
    writes: bool,
    flow: &mut Flow<D>,
    observer: &mut (dyn Observer + Send),
) -> Result<Counters, RunError> {
    let file = options.out.join(checkpoint::FILE);
    let mut counters = Counters::begin();
    if options.start.goes_on() {
        let same = options.start == Start::Resumed;
        let identity = same.then_some(&options.identity);
        counters = checkpoint::load(flow, scene, &file, identity)?;
        flow.recount(&counters.left);
        for Hooked { hook, .. } in &mut flow.hooks.all {
            if let Some(counts) = counters.works.remove(&hook.name()) {
                hook.resume(counts);
            }
        }
        let time = flow.world.time;
        observer.message(&format!(
            "resuming at t = {time:.6} s, step {}",
            counters.steps
        ));
        return Ok(counters);
    }
    if let Start::From(other) = &options.start {
        checkpoint::start_from(flow, scene, other)?;
        let time = flow.world.time;
        let from = other.display();
        observer.message(&format!("starting at t = {time:.6} s from {from}"));
        counters.started_at = Some(time.to_bits());
    }
    // An old checkpoint must not be resumed into the files of this run.
    if writes && file.exists() {
        observer.message(&format!(
            "note: the earlier run in {} is overwritten (--resume would have gone on with it)",
            options.out.display()
        ));
        let path = file.clone();
        std::fs::remove_file(&file).map_err(|source| IoError::Write { path, source })?;
    }
    Ok(counters)
}
