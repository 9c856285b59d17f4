//! Summary of a run: its size, cost and errors.

use std::collections::BTreeMap;

use serde::Serialize;
use sph_run::{RunCounters, Status};

use crate::scene::{Assembled, Compared, Origin, PluginInForce, Progress, Scene, plugins};

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

/// Version of the form of the summary.
const SCHEMA_VERSION: u32 = 1;

impl Summary {
    /// Of a run that ended so, without errors against references and warnings.
    pub(crate) fn new(
        scene: &Scene,
        parts: &Assembled,
        progress: &Progress,
        status: Status,
        books: &RunCounters,
    ) -> Self {
        let (wet, grains) = (parts.model.wet(), parts.model.grains());
        let (count, steps) = (grains.grains.len(), grains.steps);
        let stepping = books.wall_seconds - progress.preparation_seconds;
        let rate = count as f64 * steps as f64 / stepping;
        let unbalanced = grains.unbalanced_force();
        let share = |(name, n): (&String, &u64)| (name.clone(), *n as f64 / steps.max(1) as f64);
        Self {
            schema_version: SCHEMA_VERSION,
            scene: scene.title.clone(),
            method: "grains",
            status,
            version: env!("CARGO_PKG_VERSION"),
            plugins: plugins(scene),
            grains: count,
            cells: wet.map(|w| w.pressures.len()),
            meshes: wet.map(|w| w.meshes),
            coordination: grains.coordination(),
            porosity: grains.porosity(),
            unbalanced_force: unbalanced.is_finite().then_some(unbalanced),
            steps,
            simulated_seconds: grains.time,
            wall_seconds: books.wall_seconds,
            preparation_seconds: progress.preparation_seconds,
            threads: rayon::current_num_threads(),
            grain_steps_per_second: if stepping > 0.0 { rate } else { 0.0 },
            dt_limiters: progress.limited.iter().map(share).collect(),
            derived: derived(&parts.origin),
            errors: BTreeMap::new(),
            warnings: Vec::new(),
        }
    }
}

/// Measurements before the run.
fn derived(origin: &Origin) -> BTreeMap<String, f64> {
    let modulus = origin.load.zip(origin.dry_strain).map(|(l, e)| l / e);
    let all = [
        ("mean diameter [m]", Some(origin.diameter)),
        ("highest grain at the start [m]", Some(origin.top)),
        ("load [Pa]", origin.load),
        ("dry strain", origin.dry_strain),
        ("mobility [m²/(Pa s)]", origin.mobility),
        ("oedometric modulus [Pa]", modulus),
        ("consolidation coefficient [m²/s]", origin.consolidation()),
    ];
    let known = |(name, value): (&str, Option<f64>)| Some((name.to_string(), value?));
    all.into_iter().filter_map(known).collect()
}
