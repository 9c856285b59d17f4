//! A scene stepped by hand: no folder, no file, and columns that may be changed between the steps.

use std::path::Path;

use sph_core::{FieldError, Role, StepError, System, fields};
use sph_scene::Scene;
use sph_solver::Snapshot;
use sph_solver::step::guard;

use crate::failure::error::RunError;
use crate::running::checkpoint;
use crate::running::next_step::next_step;
use crate::running::run::RECOVERY;
use crate::setup::{Assembled, assemble, rehearse};

/// A scene in memory, one step at a time.
///
/// Steps are chosen, taken back and tried again as in a run: stepped to the same times, it has the same bits. Between
/// steps all columns are those of the present state. Particles are sorted now and then; `identity` follows them.
pub struct Stepper<const D: usize> {
    /// The flow with its integrator and probes.
    parts: Assembled<D>,
    scene: Scene,
    good: Snapshot<D>,
    /// Share of the step after steps that failed.
    scale: f64,
    evaluated: bool,
    steps: u64,
    rolled_back: u64,
    limiter: &'static str,
}

impl<const D: usize> Stepper<D> {
    /// Assembles a scene of `D` dimensions.
    ///
    /// # Errors
    /// Every problem of the scene, with its path.
    pub fn new(scene: &Scene) -> Result<Self, RunError> {
        let mut parts = assemble::<D>(scene)?;
        rehearse(scene, &mut parts.flow, &parts.probes)?;
        Ok(Self::over(scene, parts))
    }

    /// Steps a scene that is assembled already.
    pub(crate) fn over(scene: &Scene, parts: Assembled<D>) -> Self {
        Stepper {
            parts,
            scene: scene.clone(),
            good: Snapshot::default(),
            scale: 1.0,
            evaluated: false,
            steps: 0,
            rolled_back: 0,
            limiter: "none",
        }
    }

    /// Begins with the particles and the time of a checkpoint of another run of the same bodies.
    ///
    /// # Errors
    /// A checkpoint that cannot be read or has other particles.
    pub fn start_from(&mut self, checkpoint: &Path) -> Result<(), RunError> {
        self.evaluated = false;
        checkpoint::start_from(&mut self.parts.flow, &self.scene, checkpoint)
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

    /// Computes all derived columns of the present state, unless that is done.
    ///
    /// # Errors
    /// The particle or stage at which the state is bad.
    pub fn evaluate(&mut self) -> Result<(), StepError> {
        if !self.evaluated {
            let flow = &mut self.parts.flow;
            flow.evaluate()?;
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
        let flow = &mut self.parts.flow;
        let limits = flow.step_limits()?;
        let factor = self.scene.run.safety * self.scale;
        let (dt, limiter) = next_step(&limits, factor, [time, target], target - time);
        if time + dt <= time {
            return Err(StepError::Stage {
                stage: limiter.into(),
                reason: format!("a step of {dt:e} s does not move the clock at {time} s"),
            });
        }
        self.limiter = limiter;
        self.evaluated = false;
        flow.world.dt = dt;
        self.parts.integrator.step(flow, dt)?;
        flow.let_out(dt)?;
        flow.let_in(dt)?;
        if time + dt >= target * (1.0 - 1e-12) {
            flow.world.time = target;
        }
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

    /// Present values of every probe: name with suffix, unit, value.
    ///
    /// # Errors
    /// If a column is missing, or the state is bad.
    pub fn measure(&mut self) -> Result<Vec<(String, &'static str, f64)>, RunError> {
        self.evaluate()?;
        rehearse(&self.scene, &mut self.parts.flow, &self.parts.probes)?;
        let mut all = Vec::new();
        for (name, probe) in &self.parts.probes {
            let values = probe.measure(&self.parts.flow.world)?;
            let columns = probe.columns().into_iter().zip(values);
            all.extend(columns.map(|(c, v)| (format!("{name}{}", c.suffix), c.unit, v)));
        }
        Ok(all)
    }

    /// Overwrites a column of state, `components` numbers per particle in the present order of the particles.
    ///
    /// # Errors
    /// If there is no such column of state, its length is another, or a number is not finite.
    pub fn set(&mut self, name: &str, values: &[f64]) -> Result<(), StepError> {
        let refused = |reason: String| StepError::Stage {
            stage: format!("setting `{name}`"),
            reason,
        };
        let free = &mut self.parts.flow.world.free;
        let state = |role: Role| role == Role::State;
        let found = free.columns().find(|(n, ..)| *n == name);
        let Some((name, _, role, ..)) = found else {
            return Err(refused("the scene has no such column".into()));
        };
        if !state(role) || name == fields::IDENTITY.name {
            let can = free.columns().filter(|(_, _, role, ..)| state(*role));
            let can: Vec<&str> = can.map(|(n, ..)| n).collect();
            let why = format!("it is not state, which is: {}", can.join(", "));
            return Err(refused(why));
        }
        if let Some(bad) = values.iter().find(|v| !v.is_finite()) {
            return Err(refused(format!("{bad} is not finite")));
        }
        match free.set_real(name, values) {
            Err(FieldError::Type(_)) => {
                let whole = values.iter().map(|v| *v as u32).collect::<Vec<_>>();
                free.set_index(name, &whole)?;
            }
            other => other?,
        }
        self.evaluated = false;
        self.parts.flow.moved = true;
        if name == fields::POSITION.name {
            guard::positions(&self.parts.flow.world)?;
            self.parts.flow.world.rebuild_lists()?;
        }
        Ok(())
    }
}
