//! Particles as a model that is run, afresh or from a checkpoint.

use std::path::Path;

use sph_core::StepError;
use sph_neighbours::decomposition::PartError;
use sph_run::{Frames, Model, Poll, Progress, RunCounters, Start, Status, Watch};

use crate::failure::error::Result;
use crate::running::checkpoint::{self, begin};
use crate::running::counters::Counters;
use crate::running::course::{DerivedState, Running};
use crate::running::output::shows_depths;
use crate::running::ranked::{columns_of_all, looks_around};
use crate::running::series;
use crate::setup::measure_walls;
use crate::{RunError, Summary};

impl<const D: usize> Model for Running<'_, D> {
    type Error = RunError;
    type Summary = Summary;

    fn begin(
        &mut self,
        start: &Start,
        own: &Path,
        observer: &mut Watch<'_>,
    ) -> Result<RunCounters> {
        let (scene, options) = (self.scene, self.options);
        let flow = &mut self.parts.flow;
        self.counters = begin(scene, options, flow, observer)?;
        if start.goes_on() {
            let identity = (*start == Start::Resumed).then_some(&options.identity);
            self.zones.load(own, identity)?;
        }
        if let Some(ranks) = self.ranks.clone().filter(|_| flow.parts.is_none()) {
            flow.divide(ranks).map_err(StepError::from)?;
        }
        if self.writes() && self.parts.flow.parts.is_some() {
            let whole = columns_of_all(scene, options, &mut self.parts, &self.counters)?;
            self.whole = Some(whole);
        }
        let shown = self.whole.as_ref().unwrap_or(&self.parts);
        for (name, probe) in &shown.probes {
            let gathered = self.counters.probes.remove(name);
            if let (Some(gathered), Some(sums)) = (gathered, probe.as_gathers()) {
                sums.recall(&gathered);
            }
        }
        let energies = self.counters.energies;
        self.energy.so_far = energies.map(|all| all.map(f64::from_bits));
        if start.goes_on() {
            let [low, high, energy, momentum] = self.counters.series_extrema.map(f64::from_bits);
            self.extrema.density_range = [low, high];
            (self.extrema.energy_scale, self.extrema.momentum_scale) = (energy, momentum);
        }
        let kept = self.counters.series_peaks.iter().flatten();
        for (peak, bits) in self.extrema.peaks.iter_mut().zip(kept) {
            *peak = f64::from_bits(*bits);
        }
        self.counters.books.time = self.parts.flow.world.time;
        Ok(self.counters.books.clone())
    }

    /// Steps that fail are tried again with half of their length, from the state before.
    fn advance(&mut self, limit: f64, observer: &mut Watch<'_>) -> Result<Progress> {
        self.judge()?;
        let ready = |running: &Self| limit <= running.parts.flow.world.time;
        let mut done = ready(self);
        loop {
            if !self.known.evaluated {
                if let Err(cause) = self.evaluate() {
                    self.go_back(cause, observer)?;
                    done = ready(self);
                    continue;
                }
                self.known.evaluated = true;
                if self.good.is_some() && f64::from_bits(self.counters.step_scale) >= 1.0 {
                    self.counters.retries = 0;
                }
            }
            if done {
                return Ok(self.now());
            }
            self.known = DerivedState::default();
            match self.step(limit)? {
                Ok(()) => done = true,
                Err(cause) => self.go_back(cause, observer)?,
            }
        }
    }

    fn columns(&self) -> Vec<(String, String)> {
        let shown = self.shown();
        series::columns(shown.flow.outlets.labels(), &shown.probes)
    }

    fn row(&mut self, observer: &mut Watch<'_>) -> Result<Vec<f64>> {
        self.known.written = true;
        self.gather(looks_around(&self.parts.probes))?;
        // On several ranks all measure together.
        measure_walls(&mut self.parts.flow, &self.parts.probes)?;
        self.zones.measure_walls()?;
        if let Some(whole) = &mut self.whole {
            let forces = &self.parts.flow.world.walls.forces;
            whole.flow.world.walls.forces.clone_from(forces);
        }
        match self.writes() {
            true => self.measured(observer),
            false => Ok(Vec::new()),
        }
    }

    fn show(&mut self, frames: Option<&mut Frames>, observer: &mut Watch<'_>) -> Result<()> {
        self.known.written = true;
        self.gather(looks_around(&self.parts.probes) || shows_depths(self.scene))?;
        if self.scene.output.vtk {
            self.gather_walls()?;
        }
        for told in self.write_output(frames)? {
            observer.message(&told);
        }
        self.counters.books.outputs += 1;
        Ok(())
    }

    fn save(&mut self, books: &RunCounters, own: &Path) -> Result<()> {
        self.known.written = true;
        self.gather(false)?;
        self.save_gathered(books, own)
    }

    fn agree(&mut self, wish: Poll<RunError>) -> Result<bool> {
        match wish {
            // The run ends on all ranks if one could not write.
            Poll::Written(written) => match &mut self.parts.flow.parts {
                None => written.map(|()| false),
                Some(parts) => match parts.link.confirm(written.is_err()) {
                    Err(PartError::Elsewhere) if written.is_err() => written.map(|()| false),
                    Err(other) => Err(StepError::from(other).into()),
                    Ok(()) => Ok(false),
                },
            },
            Poll::Stop(stop) => {
                let any = self.parts.flow.any_rank(stop);
                any.map_err(|cause| self.failed(cause))
            }
        }
    }

    fn conclude(
        &mut self,
        ended: Result<Status, &mut RunError>,
        books: &RunCounters,
        _: &mut Watch<'_>,
    ) -> Result<Option<Summary>> {
        match ended {
            Err(RunError::Failed(failure)) => self.find_out(failure, books),
            Err(_) => Ok(None),
            Ok(status) => {
                self.gather(looks_around(&self.parts.probes))?;
                self.look_around()?;
                self.share()?;
                match self.writes() {
                    true => self.summary(status, None, books).map(Some),
                    false => Ok(None),
                }
            }
        }
    }
}

impl<const D: usize> Running<'_, D> {
    /// The row of the whole flow.
    fn measured(&mut self, observer: &mut Watch<'_>) -> Result<Vec<f64>> {
        let shown = self.whole.as_ref().unwrap_or(&self.parts);
        let (row, balance) = self.extrema.row(shown, &self.zones)?;
        let (left, time) = (shown.flow.mass_left(), shown.flow.world.time);
        let told = self.mach.look(&balance).into_iter();
        let told = told
            .chain(self.energy.look(&balance, left, time))
            .chain(self.departure.look(self.scene, &self.parts.flow));
        told.for_each(|told| observer.message(&told));
        let counters = &mut self.counters;
        if counters.initial_momentum.is_empty() {
            counters.initial = [balance.mass.to_bits(), balance.energy().to_bits()];
            counters.initial_momentum = balance.momentum.iter().map(|m| m.to_bits()).collect();
        }
        Ok(row)
    }

    /// Writes a checkpoint of the state that the first rank has.
    pub fn save_gathered(&mut self, books: &RunCounters, own: &Path) -> Result<()> {
        if !self.writes() {
            return Ok(());
        }
        let counters = &mut self.counters;
        let (extrema, [low, high]) = (&self.extrema, self.extrema.density_range);
        let numbers = [low, high, extrema.energy_scale, extrema.momentum_scale];
        counters.series_extrema = numbers.map(f64::to_bits);
        counters.series_peaks = Some(self.extrema.peaks.map(f64::to_bits).to_vec());
        counters.energies = self.energy.so_far.map(|all| all.map(f64::to_bits));
        counters.books = books.clone();
        let left = self.parts.flow.left();
        counters.left = left.map(|(_, l)| [l.mass.to_bits(), l.particles]).collect();
        let shown = self.shown();
        let sums = shown.probes.iter();
        let sums = sums.filter_map(|(name, p)| Some((name.clone(), p.as_gathers()?.gathered())));
        let counters = Counters {
            stage_seconds: self.stage_seconds(books),
            works: self.parts.flow.counts(),
            probes: sums.filter(|(_, sums)| !sums.is_empty()).collect(),
            ..self.counters.clone()
        };
        let identity = &self.options.identity;
        checkpoint::save((&shown.flow, self.walls()), own, identity, &counters)?;
        self.zones.save(own, identity)
    }

    fn now(&self) -> Progress {
        let (dt, limiter) = self.tried;
        let world = &self.parts.flow.world;
        Progress {
            time: world.time,
            step: self.counters.steps,
            dt,
            limiter,
            particles: world.free.len(),
            ..Progress::default()
        }
    }

    /// Ends a run whose state, as it was when something of it was written, is none of a flow that the scene means.
    fn judge(&mut self) -> Result<()> {
        if !self.known.evaluated {
            return Ok(());
        }
        if std::mem::take(&mut self.known.written) {
            let verdict = self.mach.verdict(self.scene);
            let verdict = verdict.or_else(|| self.departure.verdict());
            if let Some(cause) = self.agreed(verdict) {
                return Err(self.failed(cause));
            }
        }
        if self.parts.flow.world.time >= self.scene.run.end {
            let verdict = self.parts.flow.reports().find_map(|r| r.verdict);
            let verdict = verdict.or_else(|| self.energy.verdict());
            if let Some(cause) = self.agreed(verdict) {
                return Err(self.failed(cause));
            }
        }
        Ok(())
    }
}
