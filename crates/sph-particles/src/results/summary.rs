//! `summary.json`: settings and results of a run.

use std::collections::BTreeMap;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value as Json;
use sph_run::{Status, Trouble};
use sph_solver::{OutletTotals, PluginInForce};

use crate::Findings;
use crate::setup::{Memory, Relaxation};

/// Version of the summary's layout.
pub const SCHEMA_VERSION: u32 = 1;

/// A comparison with a reference.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ErrorEntry {
    /// The number; null if nothing could be compared.
    pub value: Option<f64>,
    /// Name of the norm.
    pub norm: String,
    /// Unit of the value, "1" for relative norms.
    pub unit: String,
    /// Points or particles compared.
    pub samples: usize,
    /// First and last time compared, s.
    pub window: [f64; 2],
    /// The reference of the comparison.
    pub against: String,
    /// The mean that is compared, of the norm `mean`, and that of the reference.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub means: Option<[f64; 2]>,
}

/// Data of one of several ranks, at the end of a run.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct RankShare {
    /// Particles that it owned.
    pub particles: u64,
    /// Copies of others'.
    pub ghosts: u64,
    /// Messages to neighbours per step.
    pub messages_per_step: f64,
    /// Bytes in them per step.
    pub bytes_per_step: f64,
    /// Particles that went from it to others during the run.
    pub moved: u64,
    /// Memory of the flow's part at the end, bytes; on the first without the columns of the whole.
    #[serde(default)]
    pub memory_bytes: f64,
}

/// Relative change of a conserved quantity.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Drift {
    /// Over the initial mass; mass that has left by outlets still counts.
    pub mass: f64,
    /// Over Σ m|u| at the end, or its largest value so far if larger.
    pub momentum: f64,
    /// Over the largest energy of any kind.
    pub energy: f64,
    /// Most that the energy has been above its first value in any row, over the same.
    #[serde(default)]
    pub energy_rise: f64,
}

/// All that is known of a run at its end.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Summary {
    /// Layout of this file.
    pub schema_version: u32,
    /// Title of the scene.
    pub scene: String,
    /// The way it ended.
    pub status: Status,
    /// Version of the program.
    pub version: String,
    /// Plugins with their parameters.
    pub plugins: Vec<PluginInForce>,
    /// Space dimensions.
    pub dimension: usize,
    /// Free particles.
    pub particles: usize,
    /// Points and elements of walls.
    pub wall_points: usize,
    /// Mean number of true neighbours of a free particle, walls included.
    pub neighbours: f64,
    /// Steps taken.
    pub steps: u64,
    /// Steps that were rolled back.
    pub steps_rolled_back: u64,
    /// Simulated time, s.
    pub simulated_seconds: f64,
    /// Time at which the run took over the state of another, s, if it did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub started_at: Option<f64>,
    /// Wall-clock time of all parts of the run, s.
    pub wall_seconds: f64,
    /// Wall-clock time per stage, s.
    pub wall_seconds_by_stage: BTreeMap<String, f64>,
    /// Threads of the last part.
    pub threads: usize,
    /// Every rank's share; nothing where one process ran all.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ranks: Vec<RankShare>,
    /// Particles times steps per second.
    pub particle_steps_per_second: f64,
    /// Wall nanoseconds × threads / (particles × steps × true neighbours), outputs excluded.
    pub nanoseconds_per_pair: f64,
    /// Bytes of the columns per particle.
    pub bytes_per_particle: usize,
    /// Memory by its use, bytes.
    pub memory: Memory,
    /// Builds of the neighbour lists.
    pub list_builds: u64,
    /// Share of the steps limited by each plugin's bound.
    pub dt_limiters: BTreeMap<String, f64>,
    /// Counts of hooks, each under its key: of solves `implicit_viscosity`, of mass that passes open faces `open_boundaries`.
    #[serde(flatten)]
    pub counts: BTreeMap<String, Json>,
    /// Mean of each plugin's bound over the steps, s, before the safety factor.
    pub dt_limits: BTreeMap<String, f64>,
    /// Changes of conserved quantities.
    pub drift: Drift,
    /// Kinetic energy at the end, J.
    pub kinetic_energy: f64,
    /// Least and largest density over the reference, over all rows of the series.
    pub density_range: [f64; 2],
    /// Largest speed over the speed of sound of its phase, over all rows.
    pub mach: f64,
    /// Least and mean distance of a free particle to its nearest neighbour at the end, over the spacing.
    pub nearest: [f64; 2],
    /// The first step that failed, if any did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first_trouble: Option<Trouble>,
    /// Report of a failed run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub failure: Option<Findings>,
    /// Least and largest K/ρ₀ at the end, where the formulation has a density constant.
    pub density_constant_range: Option<[f64; 2]>,
    /// Particles behind a wall at the end.
    pub escaped: usize,
    /// Particles and mass that left by outlets, by `outlet.NAME.PHASE`.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub left: BTreeMap<String, OutletTotals>,
    /// The relaxation of the first particles, if the scene has one.
    pub relaxation: Option<Relaxation>,
    /// Errors against the scene's references.
    pub errors: BTreeMap<String, ErrorEntry>,
    /// Settings to try where one bound or one stage costs most of the run, or speeds near that of sound.
    pub advice: Vec<String>,
    /// Warnings.
    pub warnings: Vec<String>,
    /// Files of the run, relative to its folder.
    pub files: Vec<String>,
}

impl Summary {
    /// The counts under a key, if a hook has them.
    pub fn counted<T: DeserializeOwned>(&self, key: &str) -> Option<T> {
        serde_json::from_value(self.counts.get(key)?.clone()).ok()
    }
}
