//! Summary of a run: its size, cost and errors.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::Value as Json;
use sph_run::Status;

use crate::scene::compare::Compared;

/// Content of `summary.json`.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    /// Version of this form.
    pub schema_version: u32,
    /// Title.
    pub scene: String,
    /// Method of computation: always "grains".
    pub method: &'static str,
    /// The way it ended.
    pub status: Status,
    /// Version of the program.
    pub version: &'static str,
    /// Kind, name and parameters of the plugins in force.
    pub plugins: Vec<PluginInForce>,
    /// Grains.
    pub grains: usize,
    /// Cells of the last mesh; none without fluid.
    pub cells: Option<usize>,
    /// Meshes made; none without fluid.
    pub meshes: Option<u64>,
    /// Mean number of contacts of a grain.
    pub coordination: f64,
    /// Porosity of the box, if it is closed.
    pub porosity: Option<f64>,
    /// Unbalanced force ratio; none without contacts.
    pub unbalanced_force: Option<f64>,
    /// Steps made.
    pub steps: u64,
    /// Simulated time, s.
    pub simulated_seconds: f64,
    /// Wall-clock time of all parts of the run, s.
    pub wall_seconds: f64,
    /// That of the preparation, s.
    pub preparation_seconds: f64,
    /// Threads.
    pub threads: usize,
    /// Grains times steps over the wall-clock time of the steps, 1/s.
    pub grain_steps_per_second: f64,
    /// Shares of the steps by their limits.
    pub dt_limiters: BTreeMap<String, f64>,
    /// Values measured before the run started.
    pub derived: BTreeMap<String, f64>,
    /// Errors against the references.
    pub errors: BTreeMap<String, Compared>,
    /// Warnings.
    pub warnings: Vec<String>,
}

/// A plugin and its parameters.
#[derive(Clone, Debug, Serialize)]
pub struct PluginInForce {
    /// Kind: "contact-law" or "conductance".
    pub kind: String,
    /// Owner of the plugin: "grains", "box", "wall top".
    pub of: String,
    /// Name.
    pub name: String,
    /// Parameters as the scene gives them, SI.
    pub parameters: Json,
}
