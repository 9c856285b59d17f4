//! The discrete operators against the numbers of the theory, on lattices and in disorder; solvers of linear systems.

mod channel;
mod conservation;
mod density;
mod dissipation;
mod evaluate;
mod formulations;
mod friction;
mod interfaces;
mod lanes;
mod lattice;
mod limits;
mod renormalised;
mod shifting;
mod smoother;
mod smoothers;
mod solvers;
mod state;
mod walls;
mod world;
