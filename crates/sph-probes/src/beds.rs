//! Probes of beds under water.

mod levels;
mod lines;
mod scour_map;
