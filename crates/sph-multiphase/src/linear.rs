//! Sparse symmetric systems on the neighbour graph, and their solvers.
//!
//! * [`Matrix`]: rows of particles, scalar or d × d entries, put together from the neighbour lists by an [`Assembly`].
//! * [`Operator`]: what a solver needs of a system; a [`Matrix`] is one, a product without a matrix may be another.
//! * [`LinearSolver`]: [`Automatic`], [`Cholesky`], [`ConjugateGradient`], [`Bicgstab`], as plugins;
//!   [`Jacobi`] for comparison.
//! * [`TimeScheme`]: how friction is taken over a step, [`BackwardEuler`] or [`CrankNicolson`].
//!
//! The unknowns are of any kind: a viscous velocity, a pressure, a temperature.
//!
//! ```
//! use sph_core::Vect;
//! use sph_multiphase::linear::{ConjugateGradient, Entries, LinearSolver, Matrix, Pattern};
//!
//! // Three particles in a row, each coupled to the next: diagonal 2, coupling −1.
//! let pattern = Pattern::from_rows(&[vec![1], vec![0, 2], vec![1]]);
//! let matrix = Matrix::<2>::new(pattern, Entries::scalar(vec![2.0; 3], vec![-1.0; 4]));
//! let right = vec![Vect::<2>::new(1.0, 0.0); 3];
//! let mut x = vec![Vect::<2>::zeros(); 3];
//! let report = ConjugateGradient::default().solve(&matrix, &right, &mut x).unwrap();
//! assert!((x[1][0] - 2.0).abs() < 1e-7 && report.iterations <= 3);
//! ```

mod assemble;
mod automatic;
mod bicgstab;
mod cholesky;
mod conjugate_gradient;
mod entry;
mod halved;
mod incomplete;
mod jacobi;
mod krylov;
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
pub use conjugate_gradient::{ConjugateGradient, Memories};
pub use entry::{Block, Entry};
pub use halved::{Halved, Halves};
pub use jacobi::Jacobi;
pub(crate) use krylov::Tolerance;
pub(crate) use matrix::coupling_ratio;
pub use matrix::{Diagonal, Entries, Matrix, Pattern, Values};
pub use operator::{LowRank, Operator, SolveError};
pub use particle_matrix::ParticleMatrix;
pub use precondition::Preconditioner;
pub use scheme::{
    BackwardEuler, CrankNicolson, ImplicitViscosityEntry, OuterIteration, TimeScheme,
};
pub use solver::{LinearSolver, LinearSolverEntry, LinearSystem, Report, SolveResult};
