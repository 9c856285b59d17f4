//! What walls do to a flow, through the library: forces, slip, relaxation, acceleration.

mod acceleration;
mod archimedes;
mod bench;
mod forces;
mod probe;
mod relaxation;
mod slip;
mod symmetric;
