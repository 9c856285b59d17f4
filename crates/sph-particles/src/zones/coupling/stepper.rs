//! A scene in memory with its zones, one step at a time.

use sph_core::StepError;
use sph_scene::Scene;
use sph_solver::step::guard;
use sph_solver::{Flow, Snapshot};

use super::Coupling;
use crate::running::next_step::{RECOVERY, next_step};
use crate::setup::Assembled;

/// A scene in memory, one step at a time.
///
/// Steps are chosen, taken back and tried again as in a run: stepped to the same times, it has the same bits. Between
/// steps all columns are those of the present state. Particles are sorted now and then; `identity` follows them.
pub struct Stepper<const D: usize> {
    /// The flow with its integrator and probes.
    pub(crate) parts: Assembled<D>,
    pub(crate) coupling: Coupling<D>,
    pub(crate) scene: Scene,
    good: Snapshot<D>,
    /// Share of the step after steps that failed.
    pub(crate) scale: f64,
    evaluated: bool,
    pub(crate) steps: u64,
    pub(crate) rolled_back: u64,
    limiter: &'static str,
}

impl<const D: usize> Stepper<D> {
    /// Of an assembled scene with its zones.
    pub(crate) fn from_parts(scene: &Scene, parts: Assembled<D>, coupling: Coupling<D>) -> Self {
        Stepper {
            parts,
            coupling,
            scene: scene.clone(),
            good: Snapshot::default(),
            scale: 1.0,
            evaluated: false,
            steps: 0,
            rolled_back: 0,
            limiter: "none",
        }
    }

    /// The flow with its probes and plugins.
    pub fn parts(&self) -> &Assembled<D> {
        &self.parts
    }

    /// Simulated time, s.
    pub fn time(&self) -> f64 {
        self.parts.flow.world.time
    }

    /// The last step, s, and its limit.
    pub fn last_step(&self) -> (f64, &'static str) {
        (self.parts.flow.world.dt, self.limiter)
    }

    /// Steps taken, and steps that were taken back.
    pub fn steps(&self) -> (u64, u64) {
        (self.steps, self.rolled_back)
    }

    /// The state is another: it must be evaluated.
    pub(crate) fn changed(&mut self) {
        self.evaluated = false;
        self.parts.flow.moved = true;
    }

    /// Computes all derived columns of the present state, unless that is done.
    ///
    /// # Errors
    /// The particle or stage at which the state is bad.
    pub fn evaluate(&mut self) -> Result<(), StepError> {
        if !self.evaluated {
            let flow = &mut self.parts.flow;
            self.coupling.evaluate(flow)?;
            guard::rates(&flow.world, &flow.laws, self.scene.numerics.density_bounds)?;
            self.evaluated = true;
        }
        Ok(())
    }

    /// One step that does not go beyond `target` (s), and the evaluation of the state that it leads to; its length, s.
    ///
    /// # Errors
    /// If the step fails with all of the scene's `run.retries` halvings; the flow is then where it was before.
    pub fn step(&mut self, target: f64) -> Result<f64, StepError> {
        let mut retries = self.scene.run.retries;
        self.evaluate()?;
        let before = self.time();
        loop {
            self.good.take(&self.parts.flow)?;
            let Err(cause) = self.attempt(target) else {
                self.steps += 1;
                self.scale = (self.scale * RECOVERY).min(1.0);
                return Ok(self.time() - before);
            };
            self.good.restore(&mut self.parts.flow)?;
            self.evaluated = false;
            self.evaluate()?;
            if retries == 0 {
                return Err(cause);
            }
            retries -= 1;
            self.rolled_back += 1;
            self.scale *= 0.5;
        }
    }

    fn attempt(&mut self, target: f64) -> Result<(), StepError> {
        let time = self.time();
        let limits = self.parts.flow.step_limits()?;
        let factor = self.scene.run.safety * self.scale;
        let (dt, limiter) = next_step(&limits, factor, [time, target], target - time);
        if time + dt <= time {
            let why = format!("a step of {dt:e} s does not move the clock at {time} s");
            return Err(StepError::stage(limiter, why));
        }
        self.limiter = limiter;
        self.evaluated = false;
        self.coupling.step(&mut self.parts, dt, target)?;
        self.evaluate()
    }

    /// Steps until `target` (s) is hit exactly; the number of steps.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn run_until(&mut self, target: f64) -> Result<u64, StepError> {
        let before = self.steps;
        self.evaluate()?;
        while self.time() < target {
            self.step(target)?;
        }
        Ok(self.steps - before)
    }

    /// Takes the particles around this zone at the time to which it goes next.
    ///
    /// # Errors
    /// If a column is missing.
    pub(crate) fn look(&mut self, around: &Flow<D>) -> Result<(), StepError> {
        let guard = self.coupling.guard.as_mut();
        guard.map_or(Ok(()), |guard| guard.look(around))
    }

    /// Accelerates the particles of the band towards that time.
    ///
    /// # Errors
    /// If a column is missing.
    pub(crate) fn hold(&mut self) -> Result<(), StepError> {
        self.evaluate()?;
        self.coupling.hold(&mut self.parts.flow)
    }
}
