//! Cost of a run: of a step, or of a solve.

use serde::{Deserialize, Serialize};
use serde_json::Value as Json;
use sph_core::parameters;

/// A cost against the number of particles.
#[parameters]
pub struct Scaling {
    /// Unit of the cost.
    #[parameter(default)]
    pub cost: Cost,
    /// Name of the axis whose entries compete: the fastest at each size, and the sizes at which another takes over.
    #[parameter(default)]
    pub between: Option<String>,
}

/// Unit of the cost of a run.
#[parameters]
pub enum Cost {
    /// A step, everything included.
    #[default]
    Step,
    /// A solve of the implicit viscosity's system for all components.
    Solve,
}

impl Cost {
    pub fn name(self) -> &'static str {
        match self {
            Cost::Step => "time per step",
            Cost::Solve => "time per solve",
        }
    }

    /// Seconds of one, of a run that took `wall` seconds for `steps`; nothing if there was none.
    pub fn seconds(self, wall: Option<f64>, steps: u64, solves: Option<&SolveCost>) -> Option<f64> {
        let per = |seconds: f64, n: u64| (n > 0).then(|| seconds / n as f64);
        match self {
            Cost::Step => per(wall?, steps),
            Cost::Solve => solves.and_then(|s| per(s.seconds, s.count)),
        }
    }
}

/// Effort of the implicit solves of a variant.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct SolveCost {
    pub count: u64,
    /// Wall-clock seconds of all.
    pub seconds: f64,
    /// Mean number of iterations.
    pub iterations: f64,
    /// Most bytes of a matrix and of the solver's memory for it.
    pub bytes: usize,
}

impl SolveCost {
    /// Of their entry in the summary of a run, if it has one.
    pub(crate) fn from_summary(solves: &Json) -> Option<Self> {
        let counts = solves["by_method"].as_object()?.values();
        Some(SolveCost {
            count: counts.filter_map(Json::as_u64).sum(),
            seconds: solves["wall_seconds"].as_f64()?,
            iterations: solves["mean_iterations"].as_f64()?,
            bytes: solves["most_bytes"].as_u64()? as usize,
        })
    }
}
