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
//! ```
//! use sph_kernels::{Kernel, Sampler, by_name};
//!
//! let kernel = by_name("wendland-c2").expect("built in");
//! assert!((kernel.normalisation(1) - 0.75).abs() < 1e-15);
//!
//! // In a plane with h = 0.5 m: w(0) = 7/(4π) / h².
//! let sampler = kernel.sampler(2, 0.5);
//! let r2 = [0.0, 0.25, 1.0];
//! let (mut w, mut factor) = ([0.0; 3], [0.0; 3]);
//! sampler.both(&r2, &mut w, &mut factor);
//! assert!((w[0] - 7.0 / std::f64::consts::PI).abs() < 1e-14);
//! assert_eq!((w[2], factor[2]), (0.0, 0.0)); // on the support radius 2h = 1 m
//! ```
//!
//! A kernel of your own is either a [`PolynomialKernel`] made from coefficients ([`algebra`] multiplies factors out) or
//! any type that implements [`Kernel`], with [`ScalarSampler`] as its ready-made sampler.
//!
//! [`lanes`] has the vectors in which slices are evaluated: one formula for a number and for 2, 4 or 8 of them.

pub mod algebra;
mod builtin;
mod double_double;
mod factored;
mod formula;
mod kernel;
pub mod lanes;
mod moments;
mod polynomial;
mod polynomial_kernel;
mod polynomial_sampler;
mod quadrature;
mod sampler;
mod scalar_sampler;

pub use builtin::{
    builtin, by_name, cubic_spline, quartic_spline, quintic_spline, wendland_c2, wendland_c4,
    wendland_c6,
};
pub use kernel::Kernel;
pub use polynomial::PiecewisePolynomial;
pub use polynomial_kernel::PolynomialKernel;
pub use polynomial_sampler::polynomial_sampler;
pub use quadrature::gauss_points;
pub use sampler::Sampler;
pub use scalar_sampler::ScalarSampler;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
