//! The wall treatments as plugins: what a solver sees of them.

mod corners;
mod operators;
mod pressure;
mod refusals;
mod sides;
