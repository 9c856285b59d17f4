//! Ranks that are processes of an MPI job.
//!
//! [`Job::join`] joins the job that `mpirun` has started; [`Job::rank`] is a [`Transport`](crate::Transport). A rank that
//! dies takes the job with it: `mpirun` ends the others.

mod job;
mod rank;

pub use job::Job;
pub use rank::MpiRank;
