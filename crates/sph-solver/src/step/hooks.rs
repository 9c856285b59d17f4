//! Hooks of a flow, with the phases in which each runs.

use sph_contribution::{Hook, Kick, OutsideForce, StepHook, StepPhase};
use sph_core::Access;

/// A hook at work.
pub(crate) struct Hooked<const D: usize> {
    /// The kind of plugin that it comes from.
    pub kind: &'static str,
    hook: Hook<D>,
    /// Its columns: asked once, since each answer asks for memory.
    pub access: Access,
}

impl<const D: usize> Hooked<D> {
    pub fn of(kind: &'static str, hook: Hook<D>) -> Self {
        Hooked {
            kind,
            access: hook.get().access(),
            hook,
        }
    }

    pub fn get(&self) -> &dyn StepHook<D> {
        self.hook.get()
    }

    pub fn get_mut(&mut self) -> &mut dyn StepHook<D> {
        self.hook.get_mut()
    }

    /// The hook as one that kicks, with its columns, if it does.
    pub fn kick(&mut self) -> Option<(&mut dyn Kick<D>, &Access)> {
        match &mut self.hook {
            Hook::Kick(kick) => Some((&mut **kick, &self.access)),
            Hook::Plain(_) => None,
        }
    }
}

/// All hooks of a flow, in their order.
pub(crate) struct Hooks<const D: usize> {
    all: Vec<Hooked<D>>,
    /// The numbers of those that run, by phase.
    by_phase: [Vec<usize>; StepPhase::COUNT],
    /// The numbers of those that kick.
    kicking: Vec<usize>,
    /// Whether those before a drift read the state of the present positions.
    pub fresh_state: bool,
}

impl<const D: usize> Hooks<D> {
    pub fn of(all: Vec<Hooked<D>>) -> Self {
        let mut by_phase: [Vec<usize>; StepPhase::COUNT] = Default::default();
        let mut kicking = Vec::new();
        for (k, hooked) in all.iter().enumerate() {
            let phases = hooked.get().phases().iter();
            phases.for_each(|phase| by_phase[*phase as usize].push(k));
            if matches!(hooked.hook, Hook::Kick(_)) {
                kicking.push(k);
            }
        }
        Hooks {
            all,
            by_phase,
            kicking,
            fresh_state: false,
        }
    }

    pub fn iter(&self) -> std::slice::Iter<'_, Hooked<D>> {
        self.all.iter()
    }

    pub fn iter_mut(&mut self) -> std::slice::IterMut<'_, Hooked<D>> {
        self.all.iter_mut()
    }

    /// The hook of a number.
    pub fn number(&mut self, k: usize) -> &mut Hooked<D> {
        &mut self.all[k]
    }

    /// The numbers of those that run in a phase.
    pub fn during(&self, phase: StepPhase) -> &[usize] {
        &self.by_phase[phase as usize]
    }

    /// The numbers of those that kick.
    pub fn kicking(&self) -> &[usize] {
        &self.kicking
    }

    /// The forces of those that kick.
    pub fn forces(&self) -> Vec<OutsideForce<D>> {
        let force = |hooked: &Hooked<D>| match &hooked.hook {
            Hook::Kick(kick) => Some(kick.force()),
            Hook::Plain(_) => None,
        };
        self.all.iter().filter_map(force).collect()
    }
}
