//! The discrete operators against the numbers of the theory, on lattices and in disorder.

mod channel;
mod conservation;
mod density;
mod evaluate;
mod fusing;
mod lattice;
mod smoother;
mod walls;
mod world;
