//! Everything before the first step of a run.

use std::sync::Arc;
use std::time::Instant;

use sph_core::StepError;
use sph_decomposition::Transport;
use sph_io::FolderLock;
use sph_neighbours::Nearby;
use sph_scene::Scene;
use sph_setup::{
    Assembled, assemble_share, readable, refuse_the_indivisible, rehearse, short_steps,
};

use crate::failure::error::RunError;
use crate::running::beginning::begin;
use crate::running::colours::Colours;
use crate::running::counters::Counters;
use crate::running::course::{Files, Running};
use crate::running::departure::DepartureWatch;
use crate::running::driver::Observer;
use crate::running::energy::EnergyWatch;
use crate::running::mach::MachWatch;
use crate::running::options::{RunOptions, Start};
use crate::running::output::Outputs;
use crate::running::series::Series;
use crate::running::{lock, ranked};

/// Everything before the first step; what may be refused comes before anything is written.
pub(crate) fn ready<'a, const D: usize>(
    scene: &'a Scene,
    options: &'a RunOptions,
    ranks: Option<Arc<dyn Transport>>,
    (held, observer): (&mut Option<FolderLock>, &mut (dyn Observer + Send)),
) -> Result<Running<'a, D>, RunError> {
    let share = ranked::share(scene, options, ranks.as_ref());
    let mut parts = assemble_share::<D>(scene, share)?;
    let begun = !parts.flow.is_blank();
    if begun {
        rehearse(scene, &mut parts.flow, &parts.probes)?;
        let mut limits = parts.flow.step_limits()?;
        parts.flow.least_limits(&mut limits)?;
        let remedies = parts.flow.remedies_of_bounds()?;
        parts
            .warnings
            .extend(short_steps(scene, &limits, &remedies)?);
    }
    readable(scene)?;
    let writes = ranks.as_ref().is_none_or(|ranks| ranks.rank() == 0);
    if let Some(ranks) = &ranks {
        refuse_the_indivisible(&parts.flow, ranks.ranks())?;
    }
    if writes {
        *held = Some(lock::take(&options.out, observer)?);
        sph_io::writable(&options.out)?;
        sph_io::sweep_temporaries(&options.out)?;
    }
    let mut counters = begin(scene, options, writes, &mut parts.flow, observer)?;
    if let Some(ranks) = ranks.filter(|_| parts.flow.parts.is_none()) {
        parts.flow.divide(ranks).map_err(StepError::from)?;
    }
    let parted = parts.flow.parts.is_some();
    let whole = match writes && parted {
        true => Some(ranked::columns_of_all(scene, options, &parts, &counters)?),
        false => None,
    };
    let shown = whole.as_ref().unwrap_or(&parts);
    for (name, probe) in &shown.probes {
        let gathered = counters.probes.remove(name);
        if let (Some(gathered), Some(sums)) = (gathered, probe.as_gathers()) {
            sums.recall(&gathered);
        }
    }
    let files = match writes {
        true => Some(Files::open(scene, options, shown, &counters)?),
        false => None,
    };
    for warning in &parts.warnings {
        observer.message(&format!("note: {warning}"));
    }
    let energy = EnergyWatch::of(scene, &parts.flow, counters.energies);
    Ok(Running {
        scene,
        options,
        parts,
        whole,
        counters,
        files,
        started: Instant::now(),
        output_seconds: 0.0,
        tried: (0.0, "none"),
        limits: Vec::new(),
        mach: MachWatch::default(),
        energy,
        departure: DepartureWatch::default(),
        shares: Vec::new(),
        around: Nearby::NONE,
    })
}

impl Files {
    fn open<const D: usize>(
        scene: &Scene,
        options: &RunOptions,
        shown: &Assembled<D>,
        counters: &Counters,
    ) -> Result<Self, RunError> {
        let (flow, probes) = (&shown.flow, &shown.probes);
        let resumed = options.start.goes_on().then_some(counters);
        let at = resumed.map(|c| (c.series_position, c.series_extrema.map(f64::from_bits)));
        // First what may be refused: a changed scene may measure other columns.
        let mut series = Series::open(&options.out, flow.outlets.labels(), probes, at)?;
        let changed = options.start == Start::Changed;
        let outputs = Outputs::open(
            scene,
            probes,
            &options.out,
            resumed.map(|c| c.outputs),
            changed.then_some(flow.world.time),
            Colours::of(scene, shown.pressure, &counters.colours),
        )?;
        let kept = counters.series_peaks.iter().flatten();
        for (peak, bits) in series.peaks.iter_mut().zip(kept) {
            *peak = f64::from_bits(*bits);
        }
        Ok(Files { outputs, series })
    }
}
