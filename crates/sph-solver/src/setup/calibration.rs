//! What pieces of work cost on this machine: measured, not known.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};
use sph_core::{StepError, StepLimit, System};
use sph_scene::Scene;

use crate::setup::assemble::assemble;
use crate::setup::load::{Load, Per, Piece, SWEEP};
use crate::step::clocks::{LISTS_NAME, REST_NAME};
use crate::step::guard;
use crate::step::snapshot::Snapshot;
use crate::{Assembled, SolverError};

/// Seconds of one thread for one particle, pair or contact of each piece of work, by piece, what it counts and dimension.
///
/// Measured with a few steps of small scenes. What no scene had is taken to cost what its like cost: a sweep as much as the
/// mean sweep, terms by their number, in another dimension by the ratio of the sweeps over all terms.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Calibration(BTreeMap<String, f64>);

/// Steps before the clock starts: lists, caches and buffers are cold.
const COLD: usize = 3;
/// Least number of steps that are timed.
const STEPS: usize = 10;
/// Time that the steps of a scene may take, s.
const BUDGET: f64 = 0.15;
/// Times that lists are built.
const BUILDS: usize = 3;
/// Over the lower quartile, beyond which the time of a piece is that of others at work on the machine.
const DISTURBED: f64 = 1.5;
/// Share of the mean below which a piece had nothing to do in a step.
const IDLE: f64 = 0.05;

fn key(piece: &str, per: Per, dimension: usize) -> String {
    format!("{piece} per {per:?}, {dimension}D").to_lowercase()
}

/// Number of terms in the name of a sweep over all terms.
fn terms(name: &str) -> usize {
    1 + name.matches("; ").count() + name.matches(" + ").count()
}

impl Calibration {
    /// From a few steps of each scene; those without walls come first, since what is left of the time of the others is their walls'.
    ///
    /// # Errors
    /// If a scene cannot be assembled or run.
    pub fn measure<'s>(scenes: impl IntoIterator<Item = &'s Scene>) -> Result<Self, SolverError> {
        let mut all = Calibration::default();
        let one = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        let one = one.map_err(|e| SolverError::at("--threads", e.to_string()))?;
        for scene in scenes {
            one.install(|| match scene.dimension {
                3 => all.learn::<3>(scene),
                _ => all.learn::<2>(scene),
            })?;
        }
        Ok(all)
    }

    fn learn<const D: usize>(&mut self, scene: &Scene) -> Result<(), SolverError> {
        let mut parts = assemble::<D>(scene)?;
        let spent = measured(&mut parts)?;
        let load = Load::of(&parts.flow, 1.0)?;
        for (name, seconds) in &spent {
            self.split(&load, name, *seconds);
        }
        Ok(())
    }

    /// Divides the time of a stage among its pieces: what is known already is taken off.
    fn split(&mut self, load: &Load, name: &str, seconds: f64) {
        let own = |p: &&Piece| {
            p.name == name || (name.starts_with(SWEEP) && p.name == SWEEP && p.amount > 0.0)
        };
        let mut left = seconds;
        let mut unknown: Vec<&Piece> = Vec::new();
        for piece in load.pieces.iter().filter(own) {
            match self.0.get(&key(&piece.name, piece.per, load.dimension)) {
                Some(cost) => left -= cost * piece.amount,
                None if piece.amount > 0.0 => unknown.push(piece),
                None => {}
            }
        }
        if unknown.len() > 1 {
            // Pairs cost what those of as many terms cost; what is left is the walls'.
            let like = self.sweep(name, load.dimension).unwrap_or(0.0);
            let pairs = unknown.iter().filter(|p| p.per == Per::Pair);
            left -= like * pairs.map(|p| p.amount).sum::<f64>();
            unknown.retain(|p| p.per != Per::Pair || like == 0.0);
        }
        for piece in &unknown {
            let share = left.max(0.0) / unknown.len() as f64;
            let key = key(&piece.name, piece.per, load.dimension);
            self.0.insert(key, share / piece.amount);
        }
    }

    /// A sweep over as many terms, from those that are known.
    fn sweep(&self, name: &str, dimension: usize) -> Option<f64> {
        let suffix = format!(" per pair, {dimension}d");
        let known = self.0.iter();
        let known = known.filter(|(k, _)| k.starts_with(SWEEP) && k.ends_with(&suffix));
        let per_term: Vec<f64> = known.map(|(k, cost)| cost / terms(k) as f64).collect();
        let mean = per_term.iter().sum::<f64>() / per_term.len().max(1) as f64;
        (mean > 0.0).then(|| mean * terms(name) as f64)
    }

    /// Seconds of one thread for one unit of a piece.
    fn cost(&self, piece: &Piece, dimension: usize) -> f64 {
        let at = |dimension| self.0.get(&key(&piece.name, piece.per, dimension)).copied();
        let sweep = |dimension| match piece.name.starts_with(SWEEP) && piece.per == Per::Pair {
            true => self.sweep(&piece.name, dimension),
            false => None,
        };
        if let Some(known) = at(dimension).or_else(|| sweep(dimension)) {
            return known;
        }
        // In the other dimension, by the ratio of the sweeps.
        let other = 5 - dimension;
        let ratio = match (self.sweep(SWEEP, dimension), self.sweep(SWEEP, other)) {
            (Some(here), Some(there)) => here / there,
            _ => 1.0,
        };
        at(other).map_or_else(|| self.mean(piece.per, dimension), |cost| cost * ratio)
    }

    /// The mean cost of whatever is counted as this, and 0 where nothing is.
    fn mean(&self, per: Per, dimension: usize) -> f64 {
        let suffix = format!(" per {per:?}, {dimension}D").to_lowercase();
        let known = self.0.iter().filter(|(k, _)| k.ends_with(&suffix));
        let (count, sum) = known.fold((0, 0.0), |(n, sum), (_, cost)| (n + 1, sum + cost));
        sum / f64::from(count.max(1))
    }

    /// Seconds of a step on a number of threads.
    pub fn step(&self, load: &Load, threads: usize) -> f64 {
        let pieces = load.pieces.iter();
        let all = pieces.map(|p| p.amount * self.cost(p, load.dimension));
        all.sum::<f64>() / threads.max(1) as f64
    }
}

/// Seconds of the pieces of a step.
fn measured<const D: usize>(parts: &mut Assembled<D>) -> Result<BTreeMap<String, f64>, StepError> {
    let mut kept = Snapshot::default();
    for _ in 0..COLD {
        advance(parts, &mut kept)?;
    }
    let mut samples: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    let began = Instant::now();
    let processor = on_processor();
    let mut steps = 0;
    while steps < STEPS || began.elapsed().as_secs_f64() < BUDGET {
        let before: Vec<Duration> = parts.flow.timings().iter().map(|t| t.spent).collect();
        let start = Instant::now();
        advance(parts, &mut kept)?;
        let mut rest = start.elapsed().as_secs_f64();
        for (timing, before) in parts.flow.timings().iter().zip(before) {
            let seconds = (timing.spent - before).as_secs_f64();
            rest -= seconds;
            let all = samples.entry(timing.name.clone()).or_default();
            all.push(seconds);
        }
        let all = samples.entry(REST_NAME.into()).or_default();
        all.push(rest.max(0.0));
        steps += 1;
    }
    // Lists on their own, since nobody knows when they expire.
    let mut builds = Vec::new();
    for _ in 0..BUILDS {
        let start = Instant::now();
        parts.flow.world.rebuild_lists()?;
        builds.push(start.elapsed().as_secs_f64());
    }
    parts.flow.evaluate()?;
    samples.insert(LISTS_NAME.into(), builds);
    // Where the system tells for how long this thread was at work, that share of the time counts.
    let wall = began.elapsed().as_secs_f64();
    let share = on_processor()
        .zip(processor)
        .map(|(now, then)| (now - then) / wall)
        .filter(|share| *share > 0.0);
    let cost = |seconds: Vec<f64>| match share {
        Some(share) => seconds.iter().sum::<f64>() / seconds.len() as f64 * share.min(1.0),
        None => mean_of_undisturbed(seconds),
    };
    let all = samples.into_iter();
    Ok(all.map(|(name, seconds)| (name, cost(seconds))).collect())
}

/// Seconds that this thread has been at work, where the system tells (Linux).
fn on_processor() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = text.split_whitespace().next()?.parse().ok()?;
    Some(1e-9 * nanoseconds)
}

/// Where nobody tells: the mean, where what is far above the usual counts as little above it; many pieces have nothing to do in some steps.
fn mean_of_undisturbed(mut seconds: Vec<f64>) -> f64 {
    seconds.sort_by(f64::total_cmp);
    let count = seconds.len() as f64;
    let mean = seconds.iter().sum::<f64>() / count;
    let busy = seconds.partition_point(|s| *s < IDLE * mean);
    let usual = seconds[busy + (seconds.len() - busy) / 4];
    let bounded = seconds.iter().map(|s| s.min(DISTURBED * usual));
    bounded.sum::<f64>() / count
}

/// What a run does between two outputs.
fn advance<const D: usize>(
    parts: &mut Assembled<D>,
    kept: &mut Snapshot<D>,
) -> Result<(), StepError> {
    let flow = &mut parts.flow;
    flow.evaluate()?;
    guard::rates(&flow.world, &flow.laws, [0.0, f64::INFINITY])?;
    let limits = flow.step_limits()?;
    let dt = StepLimit::least(&limits).map_or(1e-3, |l| l.dt);
    kept.take(flow)?;
    flow.world.dt = dt;
    parts.integrator.step(flow, dt)
}
