//! Everything that a piece of physics offers a flow.

use sph_core::{Access, AnyField, Evolved, Field, Scalar, Stage};
use sph_neighbours::{Interaction, Terms, World};

use crate::{Gate, Limiter, OutsideForce, Report, Stages, StepHook, StepPhase};

/// An energy that single particles store, J, by their index.
pub type ParticleEnergy<'a> = Box<dyn Fn(usize) -> f64 + Sync + 'a>;

/// Energy stored in particles, which counts as internal energy of the flow.
pub trait StoredEnergy<const D: usize>: Send {
    /// The energies of the particles; none where a column is missing.
    fn energy<'a>(&'a self, world: &'a World<D>) -> Option<ParticleEnergy<'a>>;
}

/// The pieces that a contribution offers a flow. All are optional; a piece that is not offered costs nothing.
///
/// An evaluation runs the stages, then the sweep, which sums the terms. A step kicks velocities and transported scalars
/// (value ← value + Δt rate) and drifts particles; hooks run between these.
#[derive(Default)]
pub struct Offer<const D: usize> {
    /// The contribution's table in the scene, for messages.
    pub path: String,
    /// Stages of every evaluation. One whose columns are not read is left out.
    pub stages: Stages<D>,
    /// Terms of the interaction sweep.
    pub terms: Terms<D>,
    /// Terms that leave a column for hooks; left out unless a hook or gate reads it and nothing else reads it before.
    pub riding: Vec<(AnyField, Box<dyn Interaction<D>>)>,
    /// True if a term changes the density, with [`Rates::scalar`](sph_neighbours::Rates).
    pub changes_density: bool,
    /// Columns to compute, although no stage, term or hook reads them.
    pub goals: Vec<AnyField>,
    /// Columns that are advanced in time, with the columns of their rates. A rate is written by a stage, or by terms that
    /// declare to write it: they add to `rates.more[world.slot(rate)?]`, all in one sweep.
    pub transported: Vec<Evolved>,
    /// Scalars that hooks advance in time, as kicks advance velocities.
    pub advanced: Vec<Field<Scalar>>,
    /// Bounds on the step.
    pub limiters: Vec<Box<dyn Limiter<D>>>,
    /// Bounds on steps within a step, for listings.
    pub inner_bounds: Vec<String>,
    /// Work within a step.
    pub hooks: Vec<Box<dyn StepHook<D>>>,
    /// True if hooks before a drift read density, volume, pressure and γ of the present positions.
    pub fresh_state: bool,
    /// Names of stages and hooks that are cheaper with a looser tolerance of their solver, for advice on costs.
    pub solves: Vec<String>,
    /// Forces that hooks take out of the sweep, for measurements of forces.
    pub outside: Vec<OutsideForce<D>>,
    /// Sources and sinks of particles.
    pub gates: Vec<Box<dyn Gate<D>>>,
    /// Energy stored in particles.
    pub stored: Vec<Box<dyn StoredEnergy<D>>>,
    /// True if the pores of soils are full of a fluid that bears a part of their weight; for remarks.
    pub saturated: bool,
    /// Advice for a run in which a term makes a particle too fast.
    pub remedy: Option<String>,
    /// Advice for a run in which a stage or a hook fails, by the name of the stage or hook.
    pub remedies_of_failures: Vec<(&'static str, String)>,
}

impl<const D: usize> Offer<D> {
    /// Nothing yet, of the contribution whose table in the scene is `path`.
    pub fn new(path: String) -> Self {
        Offer {
            path,
            ..Offer::default()
        }
    }

    /// Takes the pieces of another contribution; the path and the remedy of its terms are left behind.
    pub fn take(&mut self, other: Offer<D>) {
        self.stages.extend(other.stages);
        self.terms.extend(other.terms);
        self.riding.extend(other.riding);
        self.changes_density |= other.changes_density;
        self.goals.extend(other.goals);
        self.transported.extend(other.transported);
        self.advanced.extend(other.advanced);
        self.limiters.extend(other.limiters);
        self.inner_bounds.extend(other.inner_bounds);
        self.hooks.extend(other.hooks);
        self.fresh_state |= other.fresh_state;
        self.solves.extend(other.solves);
        self.outside.extend(other.outside);
        self.gates.extend(other.gates);
        self.stored.extend(other.stored);
        self.saturated |= other.saturated;
        self.remedies_of_failures.extend(other.remedies_of_failures);
    }

    /// Adds a stage.
    pub fn stage(&mut self, stage: impl Stage<World<D>> + 'static) {
        self.stages.push(Box::new(stage));
    }

    /// Adds a term.
    pub fn term(&mut self, term: impl Interaction<D> + 'static) {
        self.terms.push(Box::new(term));
    }

    /// Adds a bound on the step.
    pub fn limiter(&mut self, limiter: impl Limiter<D> + 'static) {
        self.limiters.push(Box::new(limiter));
    }

    /// Adds a hook.
    pub fn hook(&mut self, hook: impl StepHook<D> + 'static) {
        self.hooks.push(Box::new(hook));
    }

    /// Adds remarks on the state at the end of a run, for which the columns of `access` are computed.
    pub fn report(
        &mut self,
        access: Access,
        report: impl Fn(&World<D>) -> Report + Send + 'static,
    ) {
        let name = self.path.clone();
        self.hook(Reporting {
            name,
            access,
            report,
        });
    }

    /// Adds a gate.
    pub fn gate(&mut self, gate: impl Gate<D> + 'static) {
        self.gates.push(Box::new(gate));
    }
}

/// A hook that works in no phase.
struct Reporting<F> {
    name: String,
    access: Access,
    report: F,
}

impl<const D: usize, F: Fn(&World<D>) -> Report + Send> StepHook<D> for Reporting<F> {
    fn name(&self) -> String {
        self.name.clone()
    }
    fn access(&self) -> Access {
        self.access.clone()
    }
    fn phases(&self) -> &'static [StepPhase] {
        &[]
    }
    fn report(&self, world: &World<D>) -> Report {
        (self.report)(world)
    }
}
