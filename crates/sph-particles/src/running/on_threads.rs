//! Ranks within one process.

use std::sync::Arc;

use sph_neighbours::decomposition::Thread;
use sph_run::{RunOptions, Watch};
use sph_scene::Scene;

use crate::failure::error::RunError;
use crate::results::summary::Summary;
use crate::running::run::run_part;

/// Runs a scene on several ranks that are threads of this process.
///
/// The results are those of one rank, to the bit. Its purpose is to see how a scene divides, without a cluster.
///
/// # Errors
/// As [`run_part`].
pub fn run_on_threads(
    scene: &Scene,
    options: &RunOptions,
    ranks: usize,
    observer: &mut Watch<'_>,
) -> Result<Summary, RunError> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = options.threads.or(Some((cores / ranks).max(1)));
    let options = &options.clone().threads(threads);
    std::thread::scope(|scope| {
        let mut communicator = Thread::communicator(ranks).into_iter();
        let first = communicator.next();
        let part = |rank: Thread| move || run_part(scene, options, Arc::new(rank), &mut ());
        let others: Vec<_> = communicator.map(|rank| scope.spawn(part(rank))).collect();
        let first = match first {
            Some(first) => run_part(scene, options, Arc::new(first), observer),
            None => Err(RunError::at("--ranks", "there must be one at least")),
        };
        for other in others {
            let ended = other.join().unwrap_or_else(|_| Err(panicked()));
            // The first rank has reported it, if it could.
            if first.is_ok() {
                ended?;
            }
        }
        first?.ok_or_else(panicked)
    })
}

fn panicked() -> RunError {
    RunError::at("--ranks", "a rank ended without a result")
}
