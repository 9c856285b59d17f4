//! A whole scene of grains.

use std::collections::BTreeMap;

use sph_core::parameters;

use super::{Box, Fluid, Grains, Output, Probe, Reference, Start, Wall};

/// Grains, walls, fluid, times and output of a scene.
#[parameters]
pub struct Scene {
    /// The scene in one line, with its publication.
    pub title: String,
    /// Subject of the scene and its results.
    pub description: Option<String>,
    /// Duration and accuracy of the run.
    pub run: Run,
    /// The grains and the law of their contacts.
    pub grains: Grains,
    /// Positions of the grains at the start, and their preparation.
    pub start: Start,
    /// A box of six walls, `left`, `right`, `front`, `back`, `bottom`, `top`.
    pub r#box: Option<Box>,
    /// Walls by name, `[wall.NAME]`: more about those of the box, further planes, and surfaces of triangles.
    #[parameter(default)]
    pub wall: BTreeMap<String, Wall>,
    /// The fluid in the pores; dry if left out.
    pub fluid: Option<Fluid>,
    /// Makes an oedometer test of it.
    pub oedometer: Option<Oedometer>,
    /// Measurements by name, `[probe.NAME]`; `kind` chooses it, the other keys are its parameters.
    #[parameter(default)]
    pub probe: BTreeMap<String, Probe>,
    /// Comparisons by name, `[reference.NAME]`; their errors are in the summary.
    #[parameter(default)]
    pub reference: BTreeMap<String, Reference>,
    /// Files of a run, and the times of writing.
    #[parameter(default)]
    pub output: Output,
}

/// Duration and accuracy of the run.
#[parameters]
pub struct Run {
    /// Simulated time at which the run ends, s, counted from the end of the preparation.
    #[parameter(unit: "s", above: 0.0)]
    pub end: f64,
    /// Share of the largest stable step.
    #[parameter(default: 0.8, unit: "1", above: 0.0, max: 1.0, quantity: "safety factor")]
    pub safety: f64,
    /// Coefficient of non-viscous damping D_a; leave it at zero where a fluid damps. Catalano 2012, Eq. (2.15).
    #[parameter(default, unit: "1", min: 0.0, below: 1.0)]
    pub damping: f64,
    /// Largest number of steps; no limit if left out.
    #[parameter(min: 1)]
    pub max_steps: Option<u64>,
    /// Simulated time between checkpoints, s; a tenth of `end` if left out.
    #[parameter(unit: "s", above: 0.0)]
    pub checkpoint_every: Option<f64>,
}

/// A sudden load on a piston, and the measures of its answer: the strain under the same load when it comes slowly and
/// dry, and the consolidation coefficient C_v = K Δσ / ε that follows with the mobility K of the packing.
#[parameters]
pub struct Oedometer {
    /// Name of the wall that is the piston; its load is the step from `prepared` to `stress`.
    pub wall: String,
    /// Parts in which the dry load comes, each left to settle.
    #[parameter(default: 40, min: 1, max: 1000)]
    pub parts: u32,
}
