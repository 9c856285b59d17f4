//! SPH smoothing kernels as exact piecewise polynomials.
//!
//! A kernel is a *shape* f(q) of q = r/h, not normalised, with compact support: f = 0 for
//! q ≥ support. In d dimensions and with the smoothing length h (m) it becomes
//!
//! ```text
//! w(r) = σ_d / h^d · f(r/h)   (1/m^d),     ∇w_ab = F(r) r_ab,   F(r) = w'(r)/r   (1/m^(d+2))
//! ```
//!
//! where σ_d makes ∫ w dV = 1. Two roles follow:
//!
//! * [`Kernel`] is the shape: slow, exact, without dimension or h. The built-in ones ([`builtin`], [`by_name`]) are
//!   given by polynomial coefficients alone; normalisation, derivative and radial moments are computed from the
//!   coefficients ([`PiecewisePolynomial`]), never typed in. Wall integrals start from the same coefficients.
//! * [`Sampler`] is a kernel bound to a dimension and an h: fast, evaluated on slices of squared distances, because one
//!   virtual call per slice costs nothing and one per pair costs a fifth of a whole pressure sweep.
//!
//! A result depends on its own squared distance alone, bit for bit, and neither on the length
//! of the slice nor on the place in it.
//!
//! A kernel of your own is either a [`PolynomialKernel`] made from coefficients ([`algebra`] multiplies factors out) or
//! any type that implements [`Kernel`], with [`ScalarSampler`] as its ready-made sampler.
//!
//! [`lanes`] has the vectors in which slices are evaluated: one formula for a number and for 2, 4 or 8 of them.
#![doc = include_str!("../README.md")]

pub mod algebra;
mod builtin;
mod double_double;
mod factored;
mod formula;
mod kernel;
pub mod lanes;
mod moments;
mod polynomial;
mod polynomial_sampler;
mod sampler;

pub use builtin::{
    builtin, by_name, cubic_spline, quartic_spline, quintic_spline, wendland_c2, wendland_c4,
    wendland_c6,
};
pub use kernel::{Kernel, PolynomialKernel, ScalarSampler, gauss_points};
pub use polynomial::PiecewisePolynomial;
pub use polynomial_sampler::polynomial_sampler;
pub use sampler::Sampler;
