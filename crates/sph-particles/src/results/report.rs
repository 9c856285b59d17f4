//! The summary at the end of a run, and the findings of a failed one.

use std::collections::BTreeMap;
use std::path::Path;

use sph_run::{RunCounters, SERIES, SUMMARY, Status};
use sph_solver::OutletTotals;

use crate::failure::error::{Failure, Result};
use crate::results::advice;
use crate::results::balance::{Balance, FAST};
use crate::results::summary::{Drift, ErrorEntry, SCHEMA_VERSION, Summary};
use crate::results::{reference_plots, references};
use crate::running::course::Running;
use crate::running::watches::SHARE;
use crate::setup::Memory;

impl<const D: usize> Running<'_, D> {
    /// Content of `summary.json`.
    pub fn summary(
        &mut self,
        status: Status,
        failure: Option<&Failure>,
        books: &RunCounters,
    ) -> Result<Summary> {
        let flow = &self.shown().flow;
        let world = &flow.world;
        let mut warnings = self.parts.warnings.clone();
        if let Some(failure) = failure {
            warnings.push(failure.to_string());
            warnings.extend(failure.findings.advice.iter().cloned());
        }
        let errors = match status {
            Status::Failed => BTreeMap::new(),
            _ => self.compare(&mut warnings)?,
        };
        let balance = Balance::from_flow(flow)?;
        let steps = self.counters.steps;
        let particles = world.free.len();
        let stage_seconds = self.stage_seconds(books);
        let working = books.wall_seconds - stage_seconds.get("output").copied().unwrap_or(0.0);
        let neighbours = self.around.mean_neighbours();
        let work = particles as f64 * steps as f64;
        let threads = rayon::current_num_threads();
        let ranks = self.shares.len().max(1);
        let limited = self.counters.limited.iter();
        let share = |(name, n): (&String, &u64)| (name.clone(), *n as f64 / steps.max(1) as f64);
        let [_, mach, _] = self.extrema.peaks;
        let hooks = self.parts.flow.reports().map(|r| r.most_bytes);
        let solves: usize = hooks.chain(self.counters.stage_bytes.iter().copied()).sum();
        let mut summary = Summary {
            schema_version: SCHEMA_VERSION,
            scene: self.scene.title.clone(),
            status,
            version: env!("CARGO_PKG_VERSION").into(),
            plugins: self.parts.plugins.clone(),
            dimension: D,
            particles,
            wall_points: world.walls.points.position.len(),
            neighbours,
            steps,
            steps_rolled_back: self.counters.rolled_back,
            simulated_seconds: world.time,
            started_at: self.counters.started_at.map(f64::from_bits),
            wall_seconds: books.wall_seconds,
            wall_seconds_by_stage: stage_seconds,
            threads,
            ranks: self.shares.clone(),
            particle_steps_per_second: over(work, working),
            nanoseconds_per_pair: over(1e9 * working * (threads * ranks) as f64, work * neighbours),
            bytes_per_particle: world.free.bytes_per_particle(),
            memory: Memory::estimate(self.scene, &self.parts.flow, solves as f64)?,
            list_builds: world.lists.builds,
            dt_limiters: limited.map(share).collect(),
            dt_limits: advice::mean_limits(&self.counters.bounds, steps),
            advice: Vec::new(),
            drift: self.drift(&balance),
            kinetic_energy: balance.kinetic,
            density_range: self.extrema.density_range,
            mach,
            nearest: self.around.nearest().map(|d| d / world.spacing),
            first_trouble: self.counters.first_trouble.clone(),
            failure: failure.map(|f| f.findings.clone()),
            density_constant_range: flow.density_constant_range(),
            escaped: flow.escaped_from(self.walls())?,
            left: self.left(),
            relaxation: self.parts.relaxation,
            counts: self.parts.flow.counts_of_summary(),
            errors,
            warnings,
            files: listing(&self.options.out),
        };
        let remedies = flow.remedies_of_bounds()?;
        let sound = advice::room_of_sound(mach, summary.density_range);
        summary.advice = advice::advice(&summary, &remedies, sound, &flow.solves);
        self.say_what_is_odd(&mut summary);
        Ok(summary)
    }

    /// Wall-clock time of stages, hooks and outputs, s.
    pub fn stage_seconds(&self, books: &RunCounters) -> BTreeMap<String, f64> {
        let mut all = self.counters.stage_seconds.clone();
        for timing in &self.parts.flow.timings {
            *all.entry(timing.name.clone()).or_default() += timing.spent.as_secs_f64();
        }
        *all.entry("output".into()).or_default() += books.output_seconds;
        all
    }

    /// Particles that left by the scene's exits, and by the border of the domain if there are any.
    fn left(&self) -> BTreeMap<String, OutletTotals> {
        let flow = &self.parts.flow;
        let named = flow.outlets.labels().len();
        let all = flow.left().enumerate();
        let told = all.filter(|(k, (_, left))| *k < named || left.particles > 0);
        told.map(|(_, (to, left))| (to.clone(), left)).collect()
    }

    /// Errors against references, whose pictures are drawn, too.
    fn compare(&self, warnings: &mut Vec<String>) -> Result<BTreeMap<String, ErrorEntry>> {
        let (scene, out) = (self.scene, &self.options.out);
        let errors = references::errors(scene, self.shown(), &out.join(SERIES), warnings)?;
        if let Err(error) = reference_plots::plots(scene, out) {
            // A plot is a convenience: its failure must not cost the result.
            warnings.push(format!("the plots were not written: {error}"));
        }
        Ok(errors)
    }

    /// Changes of conserved quantities since the start.
    fn drift(&self, balance: &Balance<D>) -> Drift {
        let flow = &self.shown().flow;
        let [mass, energy] = self.counters.initial.map(f64::from_bits);
        let then = &self.counters.initial_momentum;
        let momentum = balance.momentum.iter().zip(then);
        let momentum = momentum.map(|(now, then)| (now - f64::from_bits(*then)).powi(2));
        let momentum = momentum.sum::<f64>().sqrt();
        let extrema = &self.extrema;
        let [highest, ..] = extrema.peaks;
        let more = balance.mass + flow.mass_left() - flow.world.free.inserted.mass - mass;
        Drift {
            mass: over(more, mass),
            momentum: over(momentum, extrema.momentum_scale),
            energy: over(balance.energy() - energy, extrema.energy_scale),
            energy_rise: over((highest - energy).max(0.0), extrema.energy_scale),
        }
    }

    /// Adds remarks of hooks, on particles behind walls and on speeds near that of sound.
    fn say_what_is_odd(&self, summary: &mut Summary) {
        let flow = &self.shown().flow;
        let escaped = summary.escaped;
        let (warnings, advice) = (&mut summary.warnings, &mut summary.advice);
        let reports: Vec<_> = flow.reports().collect();
        advice.extend(reports.iter().flat_map(|r| r.advice.clone()));
        if flow.world.free.is_empty() {
            warnings.push("all particles have left: the scene is empty at the end".into());
        }
        if escaped > 0 {
            warnings.push(format!("{escaped} particles are behind a wall at the end"));
        }
        let border = flow.left().skip(flow.outlets.labels().len());
        for (_, left) in border.filter(|(_, left)| left.particles > 0) {
            warnings.push(format!(
                "{} particles of {:.3} kg went over the end of a wall and left the domain: `numerics.domain` may be \
                 larger, or an `[outlet.NAME]` take them out before",
                left.particles, left.mass
            ));
        }
        warnings.extend(reports.into_iter().flat_map(|r| r.warnings));
        if flow.world.free.is_empty() {
            warnings.push("all particles have left before the end".into());
        }
        if let Some([warning, remedy]) = self.energy.remarks() {
            warnings.push(warning);
            advice.push(remedy);
        }
        let (over, remedy) = self.departure.remarks();
        warnings.extend(over);
        advice.extend(remedy.into_iter().map(String::from));
        let [.., fast] = self.extrema.peaks;
        if fast > SHARE {
            advice.push(format!(
                "{:.0} % of the mass was faster than {FAST} of the speed of sound, where the density of a liquid \
                 moves by 2 % and more; raise `speed_of_sound` or `velocity_scale` of the phase",
                100.0 * fast
            ));
        }
    }
}

/// A number over a scale; 0 without a positive scale.
fn over(x: f64, scale: f64) -> f64 {
    if scale > 0.0 { x / scale } else { 0.0 }
}

fn listing(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<String> = entries
        .filter_map(|e| e.file_name().into_string().ok())
        .filter(|n| !n.starts_with('.'))
        // Which is about to be written.
        .chain([SUMMARY.to_string()])
        .collect();
    names.sort();
    names.dedup();
    names
}
