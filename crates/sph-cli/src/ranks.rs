//! The processes that `mpirun` has started with this one.

#[cfg(feature = "mpi")]
mod job;
#[cfg(feature = "mpi")]
mod rank;

use std::sync::{Arc, OnceLock};

use sph_neighbours::decomposition::Transport;

static TEAM: OnceLock<Arc<dyn Transport>> = OnceLock::new();

/// Stays in the job until this is dropped.
pub struct JobGuard {
    #[cfg(feature = "mpi")]
    _job: Option<job::Job>,
}

/// Joins the job that `mpirun` has started, if it has.
#[cfg(feature = "mpi")]
pub fn join() -> JobGuard {
    let job = job::Job::join();
    if let Some(job) = &job {
        let _ = TEAM.set(job.rank());
    }
    JobGuard { _job: job }
}

/// Nothing: this program was built without MPI.
#[cfg(not(feature = "mpi"))]
pub fn join() -> JobGuard {
    JobGuard {}
}

/// All ranks, if there are several.
pub fn communicator() -> Option<Arc<dyn Transport>> {
    TEAM.get()
        .filter(|communicator| communicator.ranks() > 1)
        .cloned()
}

/// True if this process prints and writes: the first of several, or the only one.
pub fn is_first() -> bool {
    communicator().is_none_or(|communicator| communicator.rank() == 0)
}
