//! Sparse symmetric positive definite systems A x = b.
//!
//! * [`UpperTriangle`]: a matrix by its columns.
//! * [`Cholesky`]: A = L Lᵀ by faer, in an [`Order`] of elimination that is kept while only values change;
//!   [`nested_dissection`] makes one from places.
//! * [`conjugate_gradient`]: iterations from a first guess.
//! * [`Groups`]: members of numbered groups, such as the neighbours of unknowns.
//! * [`SparseError`]: systems that cannot be solved.
#![doc = include_str!("../README.md")]

mod cholesky;
mod conjugate_gradient;
mod dissection;
mod error;
mod groups;
mod matrix;
mod substitution;

pub use cholesky::{Cholesky, Order};
pub use conjugate_gradient::conjugate_gradient;
pub use dissection::nested_dissection;
pub use error::SparseError;
pub use groups::Groups;
pub use matrix::UpperTriangle;
