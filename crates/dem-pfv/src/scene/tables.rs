//! A scene of grains as plain data: one file per group of tables.

mod fluid;
mod grains;
mod output;
mod probe;
mod reference;
mod scene;
mod wall;

pub use crate::Axis;
pub use crate::coupled::Wave;
pub use fluid::Fluid;
pub use grains::{Cloud, Grains, Grown, Lattice, Rained, Start, Weight};
pub use output::Output;
pub use probe::Probe;
pub use reference::{Reference, Statistic};
pub use scene::{Oedometer, Run, Scene};
pub use wall::{Box, Piston, RecordedLoad, Servo, Wall};

use std::collections::BTreeMap;

/// Parameter tables by plugin name.
pub type Plugins = BTreeMap<String, toml::Table>;

/// The schema of [`Plugins`], whose keys are those of a plugin.
pub(crate) type AnyPlugins = BTreeMap<String, serde_json::Map<String, serde_json::Value>>;

/// A point or a vector along x, y and z.
pub type Triple = [f64; 3];
