//! The processes that `mpirun` has started with this one.

#[cfg(feature = "mpi")]
mod job;

use std::sync::{Arc, OnceLock};

use sph_neighbours::decomposition::Transport;

static TEAM: OnceLock<Arc<dyn Transport>> = OnceLock::new();

/// Joins the job that `mpirun` has started, if it has, until the result is dropped.
#[cfg(feature = "mpi")]
pub fn join() -> Option<job::Job> {
    let job = job::Job::join()?;
    let _ = TEAM.set(job.rank());
    Some(job)
}

/// Nothing: this program was built without MPI.
#[cfg(not(feature = "mpi"))]
pub fn join() -> Option<()> {
    None
}

/// All ranks, if there are several.
pub fn communicator() -> Option<Arc<dyn Transport>> {
    TEAM.get().filter(|all| all.ranks() > 1).cloned()
}

/// True if this process prints and writes: the first of several, or the only one.
pub fn is_first() -> bool {
    communicator().is_none_or(|all| all.rank() == 0)
}
