//! Sparse symmetric systems on the neighbour graph, and their solvers.
//!
//! * [`Matrix`]: rows of particles, scalar or d × d entries, put together from the neighbour lists by an [`Assembly`].
//! * [`Operator`]: what a solver needs of a system; a [`Matrix`] is one, a product without a matrix may be another.
//! * [`LinearSolver`]: [`Automatic`], [`Cholesky`], [`ConjugateGradient`], [`Bicgstab`], as plugins;
//!   [`Jacobi`] for comparison.
//! * [`TimeScheme`]: how friction is taken over a step, [`BackwardEuler`] or [`CrankNicolson`].
//!
//! The unknowns are of any kind: a viscous velocity, a pressure, a temperature.

mod assemble;
mod automatic;
mod bicgstab;
mod cholesky;
mod conjugate_gradient;
mod entry;
mod halved;
mod incomplete;
mod jacobi;
mod matrix;
mod operator;
mod particle_matrix;
mod precondition;
mod scheme;
mod solver;

pub use assemble::{Assembly, Rows};
pub use automatic::Automatic;
pub use bicgstab::Bicgstab;
pub use cholesky::Cholesky;
pub use conjugate_gradient::{ConjugateGradient, Memory};
pub use entry::{Block, Entry};
pub use halved::{Halved, Halves};
pub use jacobi::Jacobi;
pub(crate) use matrix::coupling_ratio;
pub use matrix::{Diagonal, Entries, Matrix, Pattern, Values};
pub use operator::{LowRank, Operator, SolveError};
pub use particle_matrix::ParticleMatrix;
pub use precondition::Preconditioner;
pub use scheme::{
    BackwardEuler, CrankNicolson, ImplicitViscosityEntry, OuterIteration, TimeScheme,
};
pub(crate) use solver::Tolerance;
pub use solver::{LinearSolver, LinearSolverEntry, LinearSystem, Report, SolveResult};
