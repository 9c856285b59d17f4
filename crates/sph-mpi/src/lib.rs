//! Ranks that are processes of an MPI job.
//!
//! `Job::join` joins the job that `mpirun` has started; `Job::rank` is a
//! [`Transport`](sph_decomposition::Transport). A rank that dies takes the job with it: `mpirun` ends the others.
//!
//! Without the feature `mpi` there is nothing here.

#[cfg(feature = "mpi")]
mod job;
#[cfg(feature = "mpi")]
mod rank;

#[cfg(feature = "mpi")]
pub use job::Job;
#[cfg(feature = "mpi")]
pub use rank::MpiRank;
