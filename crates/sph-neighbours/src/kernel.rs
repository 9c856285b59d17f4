//! The kernel: its plugins, its scaling by walls, and sums of its values alone.

pub(crate) mod inverse;
pub(crate) mod kernel_sums;
pub(crate) mod kernels;
pub(crate) mod lattice;
pub(crate) mod scaling;
