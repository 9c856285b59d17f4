//! The record of a finished variant, and the cost of its steps and solves.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value as Json;
use sph_core::parameters;
use sph_io::IoError;
use sph_run::Trouble;

use crate::Origin;

/// Name of the record in a variant's folder.
const FILE: &str = "record.json";
/// Longest record, bytes.
const LONGEST: u64 = 64 << 20;

/// End of a variant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// All repetitions reached their end.
    Done,
    /// It stopped on an error.
    Failed,
    /// It exceeded the study's time limit.
    OverLimit,
    /// It has begun, and goes on when the study is run again.
    Interrupted,
    /// It comes after one that broke on the same axis, and is not run.
    Skipped,
    /// It has not been run yet.
    #[default]
    Pending,
}

impl Status {
    /// As it stands in tables.
    pub fn name(self) -> &'static str {
        match self {
            Status::Done => "done",
            Status::Failed => "failed",
            Status::OverLimit => "over limit",
            Status::Interrupted => "interrupted",
            Status::Skipped => "skipped",
            Status::Pending => "pending",
        }
    }
}

/// The record of a variant that has run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Record {
    /// The way it ended.
    pub status: Status,
    pub(crate) fingerprint: String,
    /// The error, or the exceeded limit.
    pub reason: Option<String>,
    /// Time limit in force, s.
    pub(crate) time_limit: Option<f64>,
    pub(crate) errors: BTreeMap<String, Error>,
    /// Wall-clock seconds of every repetition.
    pub(crate) wall_seconds: Vec<f64>,
    /// Wall-clock seconds of the repetition under way, s.
    pub(crate) spent: f64,
    #[serde(flatten)]
    pub(crate) size: RunSize,
    /// Share of the steps limited by each bound.
    pub(crate) dt_limiters: BTreeMap<String, f64>,
    pub(crate) health: Health,
    /// Effort of implicit solves in the last repetition.
    pub(crate) solves: Option<SolveCost>,
    /// Wall-clock seconds per stage, of the fastest repetition.
    pub(crate) wall_seconds_by_stage: BTreeMap<String, f64>,
    #[serde(flatten)]
    pub(crate) origin: Origin,
}

/// Size of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RunSize {
    pub threads: usize,
    /// Free particles, or grains.
    #[serde(alias = "grains")]
    pub particles: usize,
    pub steps: u64,
    pub steps_rolled_back: u64,
    /// Simulated time reached, s.
    pub simulated_seconds: f64,
}

/// Numbers by which a run is judged; numbers that are not finite are left out.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Health {
    /// Particles behind a wall at the end.
    pub escaped: usize,
    /// Least and largest density over the reference, over all rows of the series.
    pub density_range: Option<[f64; 2]>,
    /// Change of the energy over the largest energy of any kind.
    pub energy_drift: Option<f64>,
    /// Most that the energy was above its first value, over the same.
    pub energy_rise: Option<f64>,
    /// Change of the momentum over Σ m|u|.
    pub momentum_drift: Option<f64>,
    /// Largest speed over the speed of sound.
    pub mach: Option<f64>,
    /// Least and mean distance to the nearest particle at the end, over the spacing.
    pub nearest: Option<[f64; 2]>,
    /// The first step that failed, if any did.
    pub first_trouble: Option<Trouble>,
}

impl Health {
    /// Largest distance of a density from its reference, over it.
    pub fn density_deviation(&self) -> Option<f64> {
        let [low, high] = self.density_range?;
        Some((low - 1.0).abs().max((high - 1.0).abs()))
    }
}

/// A comparison with a reference.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Error {
    /// The number; null if nothing could be compared.
    pub value: Option<f64>,
    pub norm: String,
    /// Unit, "1" for relative norms.
    #[serde(default = "one")]
    pub unit: String,
    /// The mean that is compared, of the norm `mean`, and that of the reference.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub means: Option<[f64; 2]>,
}

fn one() -> String {
    "1".into()
}

/// A part of a run's summary, which a method may lack.
fn part<T: DeserializeOwned + Default>(summary: &Json, key: &str) -> T {
    T::deserialize(&summary[key]).unwrap_or_default()
}

impl Record {
    /// Results of a run, from its summary.
    pub fn from_summary(summary: &Json) -> Self {
        let drift = &summary["drift"];
        Record {
            spent: part(summary, "wall_seconds"),
            size: RunSize::deserialize(summary).unwrap_or_default(),
            dt_limiters: part(summary, "dt_limiters"),
            solves: SolveCost::from_summary(&summary["implicit_viscosity"]),
            health: Health {
                escaped: part(summary, "escaped"),
                density_range: part(summary, "density_range"),
                energy_drift: part(drift, "energy"),
                energy_rise: part(drift, "energy_rise"),
                momentum_drift: part(drift, "momentum"),
                mach: part(summary, "mach"),
                nearest: part(summary, "nearest"),
                first_trouble: part(summary, "first_trouble"),
            },
            errors: part(summary, "errors"),
            wall_seconds_by_stage: part(summary, "wall_seconds_by_stage"),
            ..Record::default()
        }
    }

    /// The record in a variant's folder, if there is one that can be read.
    pub fn load(folder: &Path) -> Option<Self> {
        let file = folder.join(FILE);
        sph_io::readable(&file, LONGEST).ok()?;
        serde_json::from_str(&std::fs::read_to_string(file).ok()?).ok()
    }

    /// Writes the record, all or nothing.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn save(&self, folder: &Path) -> Result<(), IoError> {
        sph_io::write_json(folder.join(FILE), self)
    }

    /// Path of the record in a variant's folder.
    pub fn path(folder: &Path) -> PathBuf {
        folder.join(FILE)
    }

    /// Takes over the results of a finished repetition.
    pub fn add(&mut self, run: &Record) {
        let fastest = self.least_seconds().is_none_or(|s| run.spent <= s);
        self.wall_seconds.push(run.spent);
        self.look(run);
        self.spent = 0.0;
        self.errors.clone_from(&run.errors);
        if fastest {
            let stages = &run.wall_seconds_by_stage;
            self.wall_seconds_by_stage.clone_from(stages);
        }
    }

    /// Takes over how far a repetition got.
    pub fn look(&mut self, run: &Record) {
        self.spent = run.spent;
        self.size.clone_from(&run.size);
        self.dt_limiters.clone_from(&run.dt_limiters);
        self.solves.clone_from(&run.solves);
        self.health.clone_from(&run.health);
    }

    /// True if nothing is left to do for a variant of this fingerprint.
    pub fn settles(&self, fingerprint: &str, repetitions: usize, limit: Option<f64>) -> bool {
        let same = self.fingerprint == fingerprint;
        same && match self.status {
            Status::Done => self.wall_seconds.len() >= repetitions,
            Status::Failed => true,
            // A longer limit gives it another chance.
            Status::OverLimit => match (self.time_limit, limit) {
                (Some(then), Some(now)) => now <= then,
                _ => false,
            },
            Status::Skipped | Status::Interrupted | Status::Pending => false,
        }
    }

    /// Wall-clock seconds of the fastest repetition.
    pub fn least_seconds(&self) -> Option<f64> {
        self.wall_seconds.iter().copied().reduce(f64::min)
    }

    /// Seconds of a step or a solve.
    pub fn cost(&self, cost: Cost) -> Option<f64> {
        cost.seconds(self.least_seconds(), self.size.steps, self.solves.as_ref())
    }

    /// Slowest repetition over the fastest, less one.
    pub fn spread(&self) -> Option<f64> {
        let most = self.wall_seconds.iter().copied().reduce(f64::max)?;
        let least = self.least_seconds().filter(|s| *s > 0.0)?;
        (self.wall_seconds.len() > 1).then_some(most / least - 1.0)
    }

    /// The bound that limited most steps.
    pub fn limiter(&self) -> Option<&str> {
        let most = self.dt_limiters.iter().max_by(|a, b| a.1.total_cmp(b.1));
        most.map(|(name, _)| name.as_str())
    }

    /// An error that a finished variant has.
    pub fn error(&self, name: &str) -> Option<f64> {
        match self.status {
            Status::Done => self.errors.get(name)?.value,
            _ => None,
        }
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finished_variants_are_not_run_again() {
        let record = |status, limit| Record {
            status,
            fingerprint: "a".into(),
            time_limit: limit,
            wall_seconds: vec![1.0, 1.5],
            ..Record::default()
        };
        let done = record(Status::Done, None);
        assert!(done.settles("a", 2, None) && !done.settles("b", 2, None));
        assert!(!done.settles("a", 3, None), "another repetition is wanted");
        assert_eq!(done.least_seconds(), Some(1.0));
        assert_eq!(done.spread(), Some(0.5));
        assert!(record(Status::Failed, None).settles("a", 9, None));
        let late = record(Status::OverLimit, Some(60.0));
        assert!(late.settles("a", 1, Some(60.0)));
        assert!(!late.settles("a", 1, Some(61.0)) && !late.settles("a", 1, None));
        assert!(!record(Status::Interrupted, None).settles("a", 1, None));
    }

    #[test]
    fn a_record_comes_back_and_a_broken_one_counts_as_none() {
        let folder = tempfile::tempdir().unwrap();
        let record = Record {
            status: Status::OverLimit,
            reason: Some("…".into()),
            ..Record::default()
        };
        record.save(folder.path()).unwrap();
        assert_eq!(Record::load(folder.path()), Some(record));
        std::fs::write(Record::path(folder.path()), "{").unwrap();
        assert_eq!(Record::load(folder.path()), None);
    }
}
