//! The job that this process is part of.

use std::sync::Arc;

use mpi::Threading;
use mpi::environment::Universe;
use mpi::traits::Communicator;

use crate::ranks::rank::MpiRank;

/// Variables that launchers set for the processes that they start: Open MPI, MPICH and its kin, Slurm.
const SIGNS: [&str; 4] = [
    "OMPI_COMM_WORLD_SIZE",
    "PMIX_RANK",
    "PMI_SIZE",
    "MPI_LOCALNRANKS",
];

/// The job; MPI ends with it.
pub struct Job {
    rank: Arc<MpiRank>,
    /// Ends MPI when it is dropped.
    _universe: Universe,
}

impl Job {
    /// Joins the job that `mpirun` or its like has started; `None` where this process was started without.
    ///
    /// Threads of the process may call MPI in turns (`MPI_THREAD_SERIALIZED`). A panic ends the whole job.
    pub fn join() -> Option<Self> {
        if !SIGNS.iter().any(|sign| std::env::var_os(sign).is_some()) {
            return None;
        }
        let (universe, _) = mpi::initialize_with_threading(Threading::Serialized)?;
        let rank = Arc::new(MpiRank::current());
        let told = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |panic| {
            told(panic);
            // Others would wait for ever.
            mpi::topology::SimpleCommunicator::world().abort(101);
        }));
        Some(Job {
            rank,
            _universe: universe,
        })
    }

    /// This process among all.
    pub fn rank(&self) -> Arc<MpiRank> {
        self.rank.clone()
    }
}
