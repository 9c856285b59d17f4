//! A zone as a flow of its own, which follows the flow around it.

use rayon::prelude::*;
use sph_core::{StepError, fields};
use sph_solver::{Flow, Snapshot};

use super::stepper::Stepper;
use crate::zones::frame::Frame;
use crate::zones::sample::{Sample, Source, States};

/// A zone of finer particles.
pub(crate) struct Level<const D: usize> {
    /// Its name in the scene.
    pub name: String,
    pub frame: Frame<D>,
    pub stepper: Stepper<D>,
    /// Levels between the scene's spacing and the one around it.
    depth: usize,
    /// States to go back to, of the steps of each coarser level.
    kept: Vec<Snapshot<D>>,
}

impl<const D: usize> Level<D> {
    /// A zone whose box is `frame`, in a flow `depth` levels below the coarsest.
    pub fn new(name: &str, frame: Frame<D>, stepper: Stepper<D>, depth: usize) -> Self {
        Level {
            name: name.into(),
            frame,
            stepper,
            depth,
            kept: (0..=depth).map(|_| Snapshot::default()).collect(),
        }
    }

    /// Comes to the time of the flow around it, and gives the states of the particles of that in its core.
    ///
    /// # Errors
    /// A step of the zone that fails.
    pub fn follow(&mut self, around: &Flow<D>) -> Result<States<D>, StepError> {
        let time = around.world.time;
        if time < self.stepper.time() {
            self.put_back(self.depth)?;
        }
        self.stepper.look(around)?;
        if time > self.stepper.time() {
            self.keep(self.depth)?;
            self.stepper.hold()?;
            self.stepper.run_until(time).map_err(|e| self.named(e))?;
            self.stepper.exchange()?;
        }
        self.stepper.evaluate().map_err(|e| self.named(e))?;
        self.states(around)
    }

    /// States of the particles of the flow around that are in the core.
    fn states(&self, around: &Flow<D>) -> Result<States<D>, StepError> {
        let own = &self.stepper.parts.flow;
        // A fit in the core does not reach beyond the sides.
        let sample = Sample::of_flow(own, |x| self.frame.holds(x, 0.0))?;
        let source = Source::new(&sample, &own.world.domain, own.world.spacing);
        let position = around.world.free.get(fields::POSITION)?;
        let frame = &self.frame;
        let at = |(k, x)| {
            let inside = frame.in_core(x);
            Some((k, inside.then(|| source.at(x)).flatten()?))
        };
        let all = position.par_iter().enumerate().with_min_len(256);
        Ok(all.filter_map(at).collect())
    }

    /// Keeps its state, and that of its zones, for a flow `depth` levels below the coarsest.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn keep(&mut self, depth: usize) -> Result<(), StepError> {
        self.kept[depth].take(&self.stepper.parts.flow)?;
        self.stepper.coupling.keep(depth)
    }

    /// Puts it back.
    ///
    /// # Errors
    /// If lists cannot be built.
    pub fn put_back(&mut self, depth: usize) -> Result<(), StepError> {
        self.kept[depth].restore(&mut self.stepper.parts.flow)?;
        self.stepper.changed();
        // The step of the flow around is a shorter one now.
        self.stepper.scale = 1.0;
        self.stepper.coupling.put_back(depth)
    }

    fn named(&self, cause: StepError) -> StepError {
        StepError::stage(format!("zone `{}`", self.name), cause.to_string())
    }
}
