//! Viscosity from the end of the step: its matrix, its orders, and what it refuses.

mod input;
mod matrix;
mod order;
