//! Outputs of a run: rows of `series.csv` with balances and probes, pictures, fields, checkpoints.

use std::collections::BTreeMap;
use std::path::Path;

use sph_run::{Frames, RunCounters, Watch};

use crate::failure::error::Result;
use crate::running::checkpoint;
use crate::running::counters::Counters;
use crate::running::course::Running;
use crate::running::output::{Outputs, shows_depths};
use crate::running::pieces::write_own_share;

impl<const D: usize> Running<'_, D> {
    /// Fields, pictures and curves. Ranks write the particles of a frame together, but where these have a depth that the first
    /// alone has found. Returns changes of the pictures.
    pub fn write_output(&mut self, frames: Option<&mut Frames>) -> Result<Vec<String>> {
        let parts = self.parts.flow.parts.as_ref();
        let communicator = parts.map(|p| (p.link.transport.rank(), p.link.transport.ranks()));
        let together = self.scene.output.vtk && !shows_depths(self.scene);
        let among = communicator.filter(|(_, ranks)| together && *ranks > 1);
        let shown = self.whole.as_ref().unwrap_or(&self.parts);
        match (frames, among) {
            (Some(frames), among) => {
                let among = among.map(|(_, ranks)| (&self.parts.flow, ranks));
                let outputs = Outputs {
                    scene: self.scene,
                    shown,
                    zones: &self.zones,
                };
                outputs.write(frames, among)
            }
            (None, Some((rank, _))) => {
                let place = (self.counters.outputs, rank);
                write_own_share(self.scene, &self.parts.flow, &self.options.out, place)?;
                Ok(Vec::new())
            }
            (None, None) => Ok(Vec::new()),
        }
    }

    /// The row of the whole flow.
    pub fn measured(&mut self, observer: &mut Watch<'_>) -> Result<Vec<f64>> {
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

    pub fn stage_seconds(&self, books: &RunCounters) -> BTreeMap<String, f64> {
        let mut all = self.counters.stage_seconds.clone();
        for timing in &self.parts.flow.timings {
            *all.entry(timing.name.clone()).or_default() += timing.spent.as_secs_f64();
        }
        *all.entry("output".into()).or_default() += books.output_seconds;
        all
    }

    /// Writes a checkpoint of the state that the first rank has.
    pub fn save_gathered(&mut self, books: &RunCounters, own: &Path) -> Result<()> {
        if !self.writes() {
            return Ok(());
        }
        let counters = &mut self.counters;
        counters.series_extrema = self.extrema.numbers().map(f64::to_bits);
        counters.series_peaks = Some(self.extrema.peaks.map(f64::to_bits).to_vec());
        counters.energies = self.energy.bits();
        counters.take(books);
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
}
