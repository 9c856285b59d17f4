//! Outputs of a run: rows of `series.csv` with balances and probes, pictures, fields, checkpoints.

use std::collections::BTreeMap;
use std::path::Path;

use sph_probes::Probe;
use sph_run::{Frames, RunCounters, Watch};

use crate::failure::error::RunError;
use crate::running::checkpoint;
use crate::running::counters::Counters;
use crate::running::course::Running;
use crate::running::output::shows_depths;
use crate::running::pieces::write_own_share;
use crate::setup::Probes;

/// Sums of probes, by their names.
fn gathered<const D: usize>(probes: &Probes<D>) -> BTreeMap<String, Vec<u64>> {
    let one =
        |(name, p): &(String, Box<dyn Probe<D>>)| Some((name.clone(), p.as_gathers()?.gathered()));
    let all = probes.iter().filter_map(one);
    all.filter(|(_, gathered)| !gathered.is_empty()).collect()
}

impl<const D: usize> Running<'_, D> {
    /// Fields, pictures and curves. Ranks write the particles of a frame together, but where these have a depth that the first
    /// alone has found. Returns changes of the pictures.
    pub(crate) fn write_output(
        &mut self,
        frames: Option<&mut Frames>,
    ) -> Result<Vec<String>, RunError> {
        let parts = self.parts.flow.parts.as_ref();
        let communicator = parts.map(|p| (p.link.transport.rank(), p.link.transport.ranks()));
        let together = self.scene.output.vtk && !shows_depths(self.scene);
        let among = communicator.filter(|(_, ranks)| together && *ranks > 1);
        let shown = self.whole.as_ref().unwrap_or(&self.parts);
        match (frames, among) {
            (Some(frames), among) => {
                let among = among.map(|(_, ranks)| (&self.parts.flow, ranks));
                let outputs = &self.outputs;
                outputs.write((&shown.flow, &self.zones), &shown.probes, frames, among)
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
    pub(crate) fn measured(&mut self, observer: &mut Watch<'_>) -> Result<Vec<f64>, RunError> {
        let shown = self.whole.as_ref().unwrap_or(&self.parts);
        let dt = shown.flow.world.dt;
        let (row, balance) = self
            .extrema
            .row((&shown.flow, &self.zones), &shown.probes, dt)?;
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

    /// Takes up the extremes in rows of earlier parts of the run.
    pub(crate) fn recall_extrema(&mut self, goes_on: bool) {
        let extrema = &mut self.extrema;
        if goes_on {
            let [low, high, energy, momentum] = self.counters.series_extrema.map(f64::from_bits);
            extrema.density_range = [low, high];
            (extrema.energy_scale, extrema.momentum_scale) = (energy, momentum);
        }
        let kept = self.counters.series_peaks.iter().flatten();
        for (peak, bits) in extrema.peaks.iter_mut().zip(kept) {
            *peak = f64::from_bits(*bits);
        }
    }

    pub(crate) fn stage_seconds(&self, books: &RunCounters) -> BTreeMap<String, f64> {
        let mut all = self.counters.stage_seconds.clone();
        for timing in &self.parts.flow.timings {
            *all.entry(timing.name.clone()).or_default() += timing.spent.as_secs_f64();
        }
        *all.entry("output".into()).or_default() += books.output_seconds;
        all
    }

    /// Writes a checkpoint of the state that the first rank has.
    pub(crate) fn save_gathered(
        &mut self,
        books: &RunCounters,
        own: &Path,
    ) -> Result<(), RunError> {
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
        let counters = Counters {
            stage_seconds: self.stage_seconds(books),
            works: self.parts.flow.counts(),
            probes: gathered(&shown.probes),
            ..self.counters.clone()
        };
        let identity = &self.options.identity;
        checkpoint::save((&shown.flow, self.walls()), own, identity, &counters)?;
        self.zones.save(own, identity)
    }
}
