//! Viscosity and pressure from the end of the step: their matrix, their orders, and what is refused.

mod input;
mod matrix;
mod order;
mod pressure;
