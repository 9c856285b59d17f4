//! What the equations keep, closures, implicit solves, and the same bits on threads and ranks.

mod implicit;
mod invariants;
mod phases;
mod ranks;
mod threads;
mod turbulence;
