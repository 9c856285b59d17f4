//! Walls in space: what is made of surfaces, what is refused, and what a mesh answers.

mod bodies;
mod boxes;
mod contains;
mod large;
mod near;
mod open;
mod refused;
pub mod shapes;
mod stacked;
