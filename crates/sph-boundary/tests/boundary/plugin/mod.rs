//! The wall treatments as plugins: what a solver sees of them.

mod constrain;
mod corners;
mod dummy;
mod motion;
mod operators;
mod pressure;
mod refusals;
mod sides;
