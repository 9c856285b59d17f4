//! Hooks of a flow, with the phases in which each runs; observers of the boundaries within a step, which change nothing
//! but columns of their own; declared columns of stages, gates and forces.

use sph_contribution::{StepHook, StepPhase};
use sph_core::{Access, AnyField, StepError};
use sph_neighbours::{Interaction, World};

/// A hook at work.
pub struct Hooked<const D: usize> {
    /// The kind of plugin that it comes from.
    pub kind: &'static str,
    /// The hook.
    pub hook: Box<dyn StepHook<D>>,
    /// Its columns: collected once, since each list takes memory.
    pub access: Access,
}

/// All hooks of a flow, in their order.
#[derive(Default)]
pub struct Hooks<const D: usize> {
    pub all: Vec<Hooked<D>>,
    /// The numbers of those that run, by phase.
    by_phase: [Vec<usize>; StepPhase::COUNT],
    /// The numbers of those that kick.
    pub kicking: Vec<usize>,
}

impl<const D: usize> Hooks<D> {
    /// Adds a hook of a kind of plugin.
    pub fn add(&mut self, kind: &'static str, mut hook: Box<dyn StepHook<D>>) {
        let number = self.all.len();
        for phase in hook.phases() {
            self.by_phase[*phase as usize].push(number);
        }
        if hook.as_kick().is_some() {
            self.kicking.push(number);
        }
        let access = hook.access();
        self.all.push(Hooked { kind, hook, access });
    }

    /// The numbers of those that run in a phase.
    pub fn during(&self, phase: StepPhase) -> &[usize] {
        &self.by_phase[phase as usize]
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Boundary {
    /// The stages have run.
    Evaluated,
    /// Velocities and scalars are advanced next.
    Kicks,
    /// Velocities and scalars have been advanced.
    Kicked,
    /// The hook of a number has run in a phase.
    Hooked(StepPhase, usize),
    /// All hooks after the kick have run.
    KickEnds,
    /// Walls have turned velocities.
    Constrained,
    /// Particles drift next.
    Drifts,
}

pub(crate) struct ObservedFlow<'a, const D: usize> {
    pub world: &'a mut World<D>,
    pub terms: &'a [Box<dyn Interaction<D>>],
    /// Length of the kick or drift, s.
    pub dt: f64,
}

/// An observer of a flow at the boundaries within its steps.
pub(crate) trait Observer<const D: usize>: Send {
    fn observe(&mut self, at: Boundary, seen: &mut ObservedFlow<'_, D>) -> Result<(), StepError>;
}

/// The columns of all parts of a flow, in its order: collected once, since each list takes memory.
#[derive(Default)]
pub(crate) struct Columns {
    pub stages: Vec<Access>,
    pub gates: Vec<Access>,
    /// Terms of the sweep, and those outside of it.
    pub forces: Vec<Access>,
}

pub(crate) fn writes_any(access: &Access, fields: &[AnyField]) -> bool {
    fields.iter().any(|f| access.writes.contains(f))
}
