//! Probes of beds under water.

pub(crate) mod bed_levels;
pub(crate) mod bed_lines;
pub(crate) mod columns;
pub(crate) mod concentration_level;
pub(crate) mod eroded_mass;
pub(crate) mod pore_pressure;
pub(crate) mod scour_map;
