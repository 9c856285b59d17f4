//! Work of a piece of physics within a step, between the evaluations, and its counts and remarks.

use std::sync::Arc;

use serde_json::Value as Json;
use sph_core::{Access, StepError};
use sph_neighbours::{Interaction, WallForce, World};

/// A force that acts outside of the interaction sweep.
pub type OutsideForce<const D: usize> = Arc<dyn Interaction<D>>;

/// All forces that act: the terms of the sweep, then those outside of it.
#[derive(Clone, Copy)]
pub struct Forces<'a, const D: usize> {
    /// The terms of the sweep.
    pub sweep: &'a [Box<dyn Interaction<D>>],
    /// Forces outside of it.
    pub outside: &'a [OutsideForce<D>],
}

impl<'a, const D: usize> Forces<'a, D> {
    /// One after the other.
    pub fn iter(&self) -> impl Iterator<Item = &'a dyn Interaction<D>> + use<'a, D> {
        let (sweep, outside) = (self.sweep.iter(), self.outside.iter());
        let sweep = sweep.map(|term| -> &'a dyn Interaction<D> { &**term });
        sweep.chain(outside.map(|force| -> &'a dyn Interaction<D> { &**force }))
    }
}

/// The phases of a step, in their order. Integrators of second order pass some of them twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepPhase {
    /// Velocities and scalars are those of the evaluation.
    BeforeKick,
    /// Velocities and scalars have been advanced by `dt`.
    AfterKick,
    /// Walls have not yet turned the velocities with which particles drift.
    BeforeWalls,
    /// Walls have turned the velocities; particles drift next, for `dt`.
    BeforeDrift,
    /// Particles have drifted for a half of `dt`; lists, wall contacts and γ are those of the place.
    MidDrift,
    /// Particles and walls have drifted for `dt`.
    AfterDrift,
}

impl StepPhase {
    /// Their number.
    pub const COUNT: usize = 6;
}

/// The state at which a hook runs.
pub struct StepMoment<'a, const D: usize> {
    /// Columns, walls, lists and clock.
    pub world: &'a mut World<D>,
    /// Length of the kick or drift, s.
    pub dt: f64,
    /// All forces. Only before a kick a hook may read the columns that they declare.
    pub forces: Forces<'a, D>,
    /// Forces on the walls in this kick besides those of `forces`, in the order of the walls; empty before the first.
    pub on_walls: &'a mut Vec<WallForce<D>>,
}

impl<const D: usize> StepMoment<'_, D> {
    /// Counts forces on all walls, in their order.
    pub fn push_walls(&mut self, forces: Vec<WallForce<D>>) {
        match self.on_walls.is_empty() {
            true => *self.on_walls = forces,
            false => {
                let both = self.on_walls.iter_mut().zip(&forces);
                both.for_each(|(whole, more)| whole.add(more));
            }
        }
    }
}

/// Work on velocities, positions and columns in some phases of a step.
///
/// Memory from step to step belongs into columns, which the hook's [`Access`] names as
/// [remembered](Access::remembers): only columns are rolled back when a step fails, and only they are in checkpoints.
pub trait StepHook<const D: usize>: Send {
    /// Name in timings and in errors.
    fn name(&self) -> String;
    /// Columns that it reads and writes; those that it reads are computed.
    fn access(&self) -> Access;
    /// The phases in which it runs; called once.
    fn phases(&self) -> &'static [StepPhase];
    /// Its work in a phase.
    ///
    /// # Errors
    /// If a column is missing or a value impossible; the step is then rolled back.
    fn run(&mut self, _phase: StepPhase, _moment: &mut StepMoment<'_, D>) -> Result<(), StepError> {
        Ok(())
    }
    /// The hook as one that advances the velocities itself, if it does.
    fn as_kick(&mut self) -> Option<&mut dyn Kick<D>> {
        None
    }
    /// Most bytes that it holds beside columns, at the present state and for a step of `dt` seconds.
    ///
    /// # Errors
    /// If a column is missing.
    fn bytes(&self, _world: &mut World<D>, _dt: f64) -> Result<usize, StepError> {
        Ok(0)
    }
    /// Counts and remarks, for summaries and checkpoints.
    fn report(&self, _world: &World<D>) -> Report {
        Report::default()
    }
    /// Goes on with the counts of a run that is resumed.
    fn resume(&mut self, _counts: Json) {}
}

/// A hook of a name, the columns that it touches, the phases in which it runs and its work, over a number of seconds.
pub fn step_hook<const D: usize>(
    name: &'static str,
    access: Access,
    phases: &'static [StepPhase],
    run: impl FnMut(&mut World<D>, f64) -> Result<(), StepError> + Send,
) -> impl StepHook<D> {
    FunctionHook {
        name,
        access,
        phases,
        run,
    }
}

struct FunctionHook<F> {
    name: &'static str,
    access: Access,
    phases: &'static [StepPhase],
    run: F,
}

impl<const D: usize, F> StepHook<D> for FunctionHook<F>
where
    F: FnMut(&mut World<D>, f64) -> Result<(), StepError> + Send,
{
    fn name(&self) -> String {
        self.name.into()
    }
    fn access(&self) -> Access {
        self.access.clone()
    }
    fn phases(&self) -> &'static [StepPhase] {
        self.phases
    }
    fn run(&mut self, _: StepPhase, moment: &mut StepMoment<'_, D>) -> Result<(), StepError> {
        (self.run)(moment.world, moment.dt)
    }
}

/// A kick in the place of that with the acceleration alone.
pub trait Kick<const D: usize> {
    /// Advances the velocities by `dt` seconds with the acceleration and its own force.
    ///
    /// # Errors
    /// As [`StepHook::run`].
    fn kick(&mut self, world: &mut World<D>, dt: f64) -> Result<(), StepError>;
}

/// Counts of a hook since the start, and its remarks at the end of a run.
#[derive(Debug, Default)]
pub struct Report {
    /// Counts, for checkpoints.
    pub counts: Option<Json>,
    /// Key of the counts in the summary; `None` leaves them out.
    pub summary: Option<&'static str>,
    /// The error that leaves the run without a result.
    pub verdict: Option<StepError>,
    /// Reasons to doubt the results.
    pub warnings: Vec<String>,
    /// Changes that a person may try next time.
    pub advice: Vec<String>,
    /// Most bytes that the hook has held beside columns.
    pub most_bytes: usize,
}

impl Report {
    /// A reason to doubt the results, and nothing else.
    pub fn warning(text: impl Into<String>) -> Self {
        Report {
            warnings: vec![text.into()],
            ..Report::default()
        }
    }

    /// A change that a person may try next time, and nothing else.
    pub fn advice(text: impl Into<String>) -> Self {
        Report {
            advice: vec![text.into()],
            ..Report::default()
        }
    }
}
