//! Counters of a resumed run, and checks of them.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value as Json;
use sph_run::{RunCounters, Trouble};
use sph_scene::Scene;

/// Counters of a run, as they stand in a checkpoint.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Counters {
    /// Those of the driver.
    #[serde(flatten)]
    pub(crate) books: RunCounters,
    pub(crate) steps: u64,
    pub(crate) rolled_back: u64,
    /// Roll-backs since the step had its whole length.
    #[serde(default)]
    pub(crate) retries: u32,
    pub(crate) series_extrema: [u64; 4],
    /// Highest energy, largest Mach number and largest share of fast mass of all rows; an earlier version wrote fewer.
    pub(crate) series_peaks: Option<Vec<u64>>,
    /// State of the watch on energy.
    pub(crate) energies: Option<[u64; 5]>,
    pub(crate) first_trouble: Option<Trouble>,
    /// Time at which a run began that started from another's state.
    pub(crate) started_at: Option<u64>,
    pub(crate) limited: BTreeMap<String, u64>,
    /// Σ 1/Δt of every bound, 1/s.
    #[serde(default)]
    pub(crate) bounds: BTreeMap<String, f64>,
    pub(crate) stage_seconds: BTreeMap<String, f64>,
    pub(crate) initial: [u64; 2],
    pub(crate) initial_momentum: Vec<u64>,
    pub(crate) step_scale: u64,
    /// Mass (as bits) and number of particles that have left, by outlet and phase.
    #[serde(default)]
    pub(crate) left: Vec<[u64; 2]>,
    /// Counts of the work within steps so far, by its name.
    #[serde(default)]
    pub(crate) works: BTreeMap<String, Json>,
    /// Sums of probes so far, bit by bit, by their names.
    #[serde(default)]
    pub(crate) probes: BTreeMap<String, Vec<u64>>,
    /// Most bytes of the system that each stage has solved so far.
    #[serde(default)]
    pub(crate) stage_bytes: Vec<usize>,
}

/// Largest count that is believed: a million steps a second for three centuries. Far below 2⁶⁴, so that
/// no run can count beyond.
pub(crate) const MOST: u64 = 1 << 53;
/// Rounding of an output time, relative.
const ROUNDING: f64 = 1e-9;

impl Counters {
    /// Those of a run that begins.
    pub fn begin() -> Self {
        Counters {
            step_scale: 1f64.to_bits(),
            ..Counters::default()
        }
    }

    /// The error of counts that no run of the scene can have at a time.
    ///
    /// A checkpoint with right checksums may be of any origin. Counts that decide the next work must fit the time;
    /// others need only be such that counting on is possible.
    pub fn nonsense(&self, scene: &Scene, time: f64) -> Option<String> {
        let scale = f64::from_bits(self.step_scale);
        if !(scale > 0.0 && scale <= 1.0) {
            return Some(format!("its `step_scale` is {scale}, not between 0 and 1"));
        }
        self.counts().or_else(|| self.numbers(time)).or_else(|| {
            let most = |every: f64| (time / every * (1.0 + ROUNDING)).floor() as u64;
            let rows = most(scene.output.series_interval(scene.run.end)) + 1;
            let saved = most(scene.run.checkpoint_interval());
            let told = [
                (self.books.rows, "rows of the series", rows),
                (self.books.checkpoints, "checkpoints", saved),
            ];
            let (n, of, most) = told.into_iter().find(|(n, _, most)| n > most)?;
            Some(format!("it counts {n} {of} by then, more than {most}"))
        })
    }

    /// Counts that no run reaches.
    fn counts(&self) -> Option<String> {
        let mut counts = vec![
            ("steps", self.steps),
            ("rolled_back", self.rolled_back),
            ("outputs", self.books.outputs as u64),
        ];
        counts.extend(self.limited.values().map(|n| ("limited", *n)));
        counts.extend(self.left.iter().map(|[_, n]| ("left", *n)));
        for (name, counted) in &self.works {
            let numbers = whole_numbers(counted).into_iter();
            counts.extend(numbers.map(|n| (name.as_str(), n)));
        }
        let largest = counts.into_iter().find(|(_, n)| *n > MOST);
        largest.map(|(name, n)| format!("its counter `{name}` is {n}, which no run reaches"))
    }

    /// Numbers that are none, and times that are not yet.
    fn numbers(&self, time: f64) -> Option<String> {
        let counts = |x: f64| x >= 0.0 && x.is_finite();
        let sums = self.bounds.values().chain(self.stage_seconds.values());
        if !sums.chain([&self.books.wall_seconds]).all(|x| counts(*x)) {
            return Some("it has clocks that run backwards or are not finite".into());
        }
        let mut left = self.left.iter().map(|[mass, _]| f64::from_bits(*mass));
        if !left.all(counts) {
            return Some("the mass that has left is negative or not finite".into());
        }
        let peaks = self.series_peaks.iter().flatten().copied();
        let energies = self.energies.into_iter().flatten();
        let extrema = self.series_extrema.into_iter().chain(peaks).chain(energies);
        if extrema.map(f64::from_bits).any(f64::is_nan) {
            return Some("extrema of its series are not numbers".into());
        }
        let started_at = self.started_at.map(f64::from_bits);
        let past = [
            ("last_row", self.books.last_row),
            ("started_at", started_at),
        ];
        let ahead = |t: f64| !(0.0..=time).contains(&t);
        if let Some((name, _)) = past.into_iter().find(|(_, t)| t.is_some_and(ahead)) {
            return Some(format!("its `{name}` is not before its time"));
        }
        let comes = |t: f64| t.is_finite() && t >= time * (1.0 - ROUNDING);
        let late = self.books.next_output.is_some_and(|t| !comes(t));
        late.then(|| "its `next_output` is not after its time".into())
    }

    /// Counts in intervals of the scene, for a scene whose intervals may be others than before.
    pub fn recount(&mut self, scene: &Scene, time: f64) {
        if let Some(last) = self.books.last_row {
            self.books.rows =
                (last / scene.output.series_interval(scene.run.end)).floor() as u64 + 1;
        }
        self.books.checkpoints = (time / scene.run.checkpoint_interval()).floor() as u64;
    }
}

/// All whole numbers in the counts of a piece of work.
fn whole_numbers(counted: &Json) -> Vec<u64> {
    match counted {
        Json::Number(n) => n.as_u64().into_iter().collect(),
        Json::Array(items) => items.iter().flat_map(whole_numbers).collect(),
        Json::Object(items) => items.values().flat_map(whole_numbers).collect(),
        _ => Vec::new(),
    }
}
