//! Hooks of a flow, with the phases in which each runs.

use sph_contribution::{StepHook, StepPhase};
use sph_core::Access;

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
