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

/// Required of γ beside a gear, plates and wedges, as docs/numerics.md states it.
const OF_GAMMA: f64 = 4e-14;
