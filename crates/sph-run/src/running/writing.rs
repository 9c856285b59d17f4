//! What a run writes on its way: rows, pictures, fields, checkpoints.

use std::collections::BTreeMap;
use std::time::Instant;

use sph_probes::Probe;
use sph_setup::{Probes, measure_walls};

use crate::failure::error::RunError;
use crate::results::balance::Balance;
use crate::running::checkpoint;
use crate::running::counters::Counters;
use crate::running::course::{Due, Running};
use crate::running::driver::Observer;
use crate::running::output::shows_depths;
use crate::running::pieces::write_own_share;

/// What probes have gathered, by their names.
fn gathered<const D: usize>(probes: &Probes<D>) -> BTreeMap<String, Vec<u64>> {
    let one =
        |(name, p): &(String, Box<dyn Probe<D>>)| Some((name.clone(), p.as_gathers()?.gathered()));
    let all = probes.iter().filter_map(one);
    all.filter(|(_, gathered)| !gathered.is_empty()).collect()
}

impl<const D: usize> Running<'_, D> {
    /// What is to be written at a time, s.
    pub(crate) fn is_due(&self, time: f64) -> Due {
        let end = self.scene.run.end;
        let every = self.scene.output.series_interval(end);
        let written = self.counters.last_row == Some(time.to_bits());
        let output = self.counters.next_output;
        let number = (time / self.scene.run.checkpoint_interval()).floor() as u64;
        Due {
            row: !written && (time >= self.counters.rows as f64 * every || time >= end),
            output: output.is_some_and(|t| time >= f64::from_bits(t)),
            checkpoint: number > self.counters.checkpoints || time >= end,
        }
    }

    pub(crate) fn write_what_is_due(
        &mut self,
        time: f64,
        observer: &mut (dyn Observer + Send),
    ) -> Result<(), RunError> {
        let start = Instant::now();
        let due = self.is_due(time);
        let measures = (due.row || due.output) && self.looks_around();
        let shows = due.output && shows_depths(self.scene);
        self.gather(measures || shows)?;
        if due.output && self.scene.output.vtk {
            self.gather_walls()?;
        }
        if due.row {
            // On several ranks all measure together, whoever writes.
            measure_walls(&mut self.parts.flow, &self.parts.probes)?;
            if let Some(whole) = &mut self.whole {
                let forces = &self.parts.flow.world.walls.forces;
                whole.flow.world.walls.forces.clone_from(forces);
            }
            self.write_row(observer)?;
            let every = self.scene.output.series_interval(self.scene.run.end);
            self.counters.rows = (time / every).floor() as u64 + 1;
            self.counters.last_row = Some(time.to_bits());
        }
        if due.output {
            for told in self.write_output()? {
                observer.message(&told);
            }
            self.counters.outputs += 1;
            self.counters.next_output = self.next_output(time);
        }
        if due.checkpoint {
            let interval = self.scene.run.checkpoint_interval();
            self.counters.checkpoints = (time / interval).floor() as u64;
            self.save_gathered()?;
        }
        self.output_seconds += start.elapsed().as_secs_f64();
        Ok(())
    }

    /// Fields, pictures and curves. Ranks write the particles of a frame together, but where these have a depth that the first
    /// alone has found. Tells what changes in the pictures.
    fn write_output(&mut self) -> Result<Vec<String>, RunError> {
        let parts = self.parts.flow.parts.as_ref();
        let team = parts.map(|p| (p.transport().rank(), p.transport().ranks()));
        let together = self.scene.output.vtk && !shows_depths(self.scene);
        let among = team.filter(|(_, ranks)| together && *ranks > 1);
        let shown = self.whole.as_ref().unwrap_or(&self.parts);
        match (&mut self.files, among) {
            (Some(files), among) => {
                let among = among.map(|(_, ranks)| (&self.parts.flow, ranks));
                files.outputs.write(&shown.flow, &shown.probes, among)
            }
            (None, Some((rank, _))) => {
                let place = (self.counters.outputs, rank);
                write_own_share(self.scene, &self.parts.flow, &self.options.out, place)?;
                Ok(Vec::new())
            }
            (None, None) => Ok(Vec::new()),
        }
    }

    fn write_row(&mut self, observer: &mut (dyn Observer + Send)) -> Result<(), RunError> {
        let Some(files) = &mut self.files else {
            return Ok(());
        };
        let shown = self.whole.as_ref().unwrap_or(&self.parts);
        let dt = shown.flow.world.dt;
        let balance = files.series.row(&shown.flow, &shown.probes, dt)?;
        let (left, time) = (shown.flow.mass_left(), shown.flow.world.time);
        let told = self.mach.look(&balance).into_iter();
        let told = told
            .chain(self.energy.look(&balance, left, time))
            .chain(self.departure.look(self.scene, &self.parts.flow));
        told.for_each(|told| observer.message(&told));
        if self.counters.rows == 0 {
            self.remember_start(&balance);
        }
        Ok(())
    }

    fn remember_start(&mut self, balance: &Balance<D>) {
        self.counters.initial = [balance.mass.to_bits(), balance.energy().to_bits()];
        self.counters.initial_momentum = balance.momentum.iter().map(|m| m.to_bits()).collect();
    }

    /// Writes a checkpoint of the present state.
    pub(crate) fn save(&mut self) -> Result<(), RunError> {
        self.gather(false)?;
        self.save_gathered()
    }

    pub(crate) fn save_gathered(&mut self) -> Result<(), RunError> {
        let Some(files) = &self.files else {
            return Ok(());
        };
        let (position, extrema) = files.series.resume_point();
        self.counters.series_position = position;
        self.counters.series_extrema = extrema.map(f64::to_bits);
        self.counters.series_peaks = Some(files.series.peaks.map(f64::to_bits).to_vec());
        self.counters.energies = self.energy.bits();
        self.counters.outputs = files.outputs.written;
        self.counters.colours = files.outputs.colours.seen.clone();
        let left = self.parts.flow.left();
        self.counters.left = left.map(|(_, l)| [l.mass.to_bits(), l.particles]).collect();
        let shown = self.shown();
        let counters = Counters {
            wall_seconds: self.wall_seconds(),
            stage_seconds: self.stage_seconds(),
            works: self.parts.flow.counts(),
            probes: gathered(&shown.probes),
            ..self.counters.clone()
        };
        let path = self.options.out.join(checkpoint::FILE);
        checkpoint::save(&shown.flow, &path, &self.options.identity, &counters)
    }
}
