//! Result of a variant, and series of variants that differ in their refinement only.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::{
    Bounds, Cost, Error, Health, Orders, Origin, Record, RunSize, SolveCost, Status, Variant,
    Verdict, verdict,
};

/// Results of a variant.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct VariantResult {
    /// Name, which is that of its folder.
    pub name: String,
    /// Label by axis.
    pub values: BTreeMap<String, String>,
    /// Value of the refinement's key.
    pub refinement: Option<f64>,
    /// The way it ended.
    pub status: Status,
    /// The error, if it did not end well.
    pub reason: Option<String>,
    /// Green, yellow or red, of a run along an axis.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub verdict: Option<Verdict>,
    /// Soundness of the run.
    #[serde(default)]
    pub health: Health,
    /// All errors against the scene's references.
    pub errors: BTreeMap<String, Error>,
    /// Observed order between this and the next coarser variant, of the first judged error.
    pub order: Option<f64>,
    /// Wall-clock times.
    pub wall_seconds: WallSeconds,
    /// Size of the run.
    #[serde(flatten)]
    pub size: RunSize,
    /// The bound that limited most steps.
    pub dt_limiter: Option<String>,
    /// Share of the steps limited by each bound.
    pub dt_limiters: BTreeMap<String, f64>,
    /// Effort of implicit solves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub solves: Option<SolveCost>,
    /// Wall-clock seconds per stage, of the fastest repetition.
    pub wall_seconds_by_stage: BTreeMap<String, f64>,
    /// Machine and program of the run.
    #[serde(flatten)]
    pub origin: Origin,
    /// Data on which the result depends.
    pub fingerprint: String,
}

/// Wall-clock times of the repetitions, s.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct WallSeconds {
    /// The least: the time of the variant without disturbance.
    pub min: Option<f64>,
    /// Largest over least, less one.
    pub spread: Option<f64>,
    /// All of them.
    pub all: Vec<f64>,
    /// Of the repetition that did not come to its end.
    #[serde(default)]
    pub spent: f64,
}

/// Variants that differ in their refinement only, from coarse to fine.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SeriesResult {
    /// Labels on the other axes.
    pub name: String,
    pub variants: Vec<String>,
    /// Orders of every judged error.
    pub orders: BTreeMap<String, Orders>,
}

impl VariantResult {
    pub(crate) fn new(
        v: &Variant,
        record: &Record,
        judge: Option<&Bounds>,
        axes: &[String],
    ) -> Self {
        VariantResult {
            name: v.name.clone(),
            values: axes.iter().cloned().zip(v.labels.iter().cloned()).collect(),
            refinement: v.refinement,
            status: record.status,
            reason: record.reason.clone(),
            verdict: judge.and_then(|bounds| verdict(record, bounds)),
            health: record.health.clone(),
            errors: match record.status {
                Status::Done => record.errors.clone(),
                _ => BTreeMap::new(),
            },
            order: None,
            wall_seconds: WallSeconds {
                min: record.least_seconds(),
                spread: record.spread(),
                all: record.wall_seconds.clone(),
                spent: record.spent,
            },
            size: record.size.clone(),
            dt_limiter: record.limiter().map(String::from),
            dt_limiters: record.dt_limiters.clone(),
            solves: record.solves.clone(),
            wall_seconds_by_stage: record.wall_seconds_by_stage.clone(),
            origin: record.origin.clone(),
            fingerprint: v.fingerprint.clone(),
        }
    }

    /// Seconds of a step or a solve.
    pub fn cost(&self, cost: Cost) -> Option<f64> {
        cost.seconds(self.wall_seconds.min, self.size.steps, self.solves.as_ref())
    }

    /// An error, if the variant is finished and has it.
    pub fn error(&self, name: &str) -> Option<f64> {
        self.errors.get(name)?.value
    }
}
