//! Conservation, closures, soils, implicit solves, zones, and the same bits on threads and ranks.

mod implicit;
mod invariants;
mod phases;
mod ranks;
mod sediment;
mod soils;
mod suspension;
mod threads;
mod turbulence;
mod zones;
