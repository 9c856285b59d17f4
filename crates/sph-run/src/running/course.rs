//! A run on its way: what it has, and what it writes.

use std::time::Instant;

use sph_core::StepLimit;
use sph_neighbours::Nearby;
use sph_scene::Scene;
use sph_setup::Assembled;

use crate::results::summary::RankShare;
use crate::running::counters::Counters;
use crate::running::departure::DepartureWatch;
use crate::running::energy::EnergyWatch;
use crate::running::mach::MachWatch;
use crate::running::options::RunOptions;
use crate::running::output::Outputs;
use crate::running::series::Series;

/// A run on its way.
pub(crate) struct Running<'a, const D: usize> {
    pub(crate) scene: &'a Scene,
    pub(crate) options: &'a RunOptions,
    pub(crate) parts: Assembled<D>,
    /// All of a flow of which `parts` has this rank's part; on the first of several ranks alone.
    pub(crate) whole: Option<Assembled<D>>,
    pub(crate) counters: Counters,
    /// What this process writes; nothing on ranks behind the first.
    pub(crate) files: Option<Files>,
    pub(crate) started: Instant,
    pub(crate) output_seconds: f64,
    /// The last step that was tried, s, and what limited it.
    pub(crate) tried: (f64, &'static str),
    /// Bounds of the step at hand.
    pub(crate) limits: Vec<StepLimit>,
    pub(crate) mach: MachWatch,
    pub(crate) energy: EnergyWatch,
    pub(crate) departure: DepartureWatch,
    /// Every rank's share, on the first at the end.
    pub(crate) shares: Vec<RankShare>,
    /// What the particles of all ranks have near them, at the end.
    pub(crate) around: Nearby,
}

/// What is written while a scene runs.
pub(crate) struct Files {
    pub(crate) outputs: Outputs,
    pub(crate) series: Series,
}

/// What is to be written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Due {
    /// A row of the series.
    pub(crate) row: bool,
    /// Fields, pictures and curves.
    pub(crate) output: bool,
    /// A checkpoint.
    pub(crate) checkpoint: bool,
}

impl Due {
    pub(crate) fn any(self) -> bool {
        self.row || self.output || self.checkpoint
    }
}
