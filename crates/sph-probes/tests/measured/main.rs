//! Probes on fields whose measures are known.

mod bed;
mod common;
mod concentration_level;
mod line;
mod measure;
mod phases;
mod profile;
mod scour_map;
mod stream_function;
