//! Wall integrals in space against their definitions.

mod corners;
mod paths;
pub mod planes;
mod quadrature;
pub mod solid;
mod solids;
mod touching;
mod triangles;

use sph_boundary::Renormalisation3d;
use sph_kernels::{Kernel, PolynomialKernel};

/// Every built-in kernel with its integrals for h = 1 m.
fn kernels() -> Vec<(PolynomialKernel, Renormalisation3d)> {
    let with = |kernel: PolynomialKernel| {
        let of = Renormalisation3d::new(kernel.shape(), 1.0).expect("a kernel");
        (kernel, of)
    };
    sph_kernels::builtin().into_iter().map(with).collect()
}

/// Of γ and h∇γ: the displacement of the point by 10⁻¹⁰ h, times some 0.8. docs/numerics.md states it.
const TOLERANCE: f64 = 1.15e-10;

/// Reports and checks the worst error of one kernel.
fn assert_within(kernel: &PolynomialKernel, worst: f64, tolerance: f64) {
    println!("{:15} {worst:.1e}", kernel.name());
    assert!(worst <= tolerance, "{}: {worst:e}", kernel.name());
}
