//! Triangulated packings, grains, the flow in their pores, and both together.

mod coupled;
mod flow;
mod grains;
mod triangulation;
