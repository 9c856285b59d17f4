//! Everything before the first step of a run.

use std::sync::Arc;
use std::time::Instant;

use sph_decomposition::Transport;
use sph_io::FolderLock;
use sph_scene::Scene;

use crate::failure::error::SolverError;
use crate::results::references;
use crate::running::beginning::begin;
use crate::running::counters::Counters;
use crate::running::course::{Files, Running};
use crate::running::driver::Observer;
use crate::running::mach::MachWatch;
use crate::running::options::{RunOptions, Start};
use crate::running::output::Outputs;
use crate::running::series::{Series, rehearse};
use crate::running::{lock, ranked};
use crate::setup::assemble::{Assembled, assemble};
use crate::setup::estimate::tiny_steps;

/// Everything before the first step; what may be refused comes before anything is written.
pub(crate) fn ready<'a, const D: usize>(
    scene: &'a Scene,
    options: &'a RunOptions,
    ranks: Option<Arc<dyn Transport>>,
    (held, observer): (&mut Option<FolderLock>, &mut (dyn Observer + Send)),
) -> Result<Running<'a, D>, SolverError> {
    let mut parts = assemble::<D>(scene)?;
    rehearse(scene, &mut parts.flow, &parts.probes)?;
    references::readable(scene)?;
    let tiny = tiny_steps(scene, &parts.flow)?;
    parts.warnings.extend(tiny);
    let writes = ranks.as_ref().is_none_or(|ranks| ranks.rank() == 0);
    if let Some(ranks) = &ranks {
        ranked::refuse_the_indivisible(&parts, ranks.ranks())?;
    }
    if writes {
        *held = Some(lock::take(&options.out, observer)?);
        sph_io::writable(&options.out)?;
        sph_io::sweep_temporaries(&options.out)?;
    }
    let mut counters = begin(scene, options, writes, &mut parts.flow, observer)?;
    let whole = match ranks {
        None => None,
        Some(ranks) => ranked::divide(scene, options, ranks, &mut parts)?,
    };
    let shown = whole.as_ref().unwrap_or(&parts);
    for (name, probe) in &shown.probes {
        if let Some(gathered) = counters.probes.remove(name) {
            probe.recall(&gathered);
        }
    }
    let files = match writes {
        true => Some(Files::open(scene, options, shown, &counters)?),
        false => None,
    };
    for warning in &parts.warnings {
        observer.message(&format!("note: {warning}"));
    }
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
        shares: Vec::new(),
    })
}

impl Files {
    fn open<const D: usize>(
        scene: &Scene,
        options: &RunOptions,
        shown: &Assembled<D>,
        counters: &Counters,
    ) -> Result<Self, SolverError> {
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
        )?;
        if let Some(peaks) = counters.series_peaks {
            series.peaks = peaks.map(f64::from_bits);
        }
        Ok(Files { outputs, series })
    }
}
