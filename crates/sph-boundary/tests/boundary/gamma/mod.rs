//! γ and ∇γ against their definitions.

mod identities;
mod kernels;
mod plates;
mod polygons;
mod quadrature;
mod reference;
mod scan;
mod scene;
mod tables;
mod wedges;

/// Required of γ and h∇γ everywhere.
const TOLERANCE: f64 = 1e-12;
