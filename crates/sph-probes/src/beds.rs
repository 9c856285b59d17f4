//! Probes of beds under water.

mod bed_levels;
mod concentration_level;
mod eroded_mass;
mod lines;
mod scour_map;
