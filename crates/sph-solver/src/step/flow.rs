//! A flow in motion: evaluation of all stages, kicks and drifts.

use std::time::Instant;

use rayon::prelude::*;
use sph_contribution::Contribution;
use sph_core::{
    Access, Evolved, Field, Recall, Role, Scalar, Stage, StepError, StepLimit, System, Vect, fields,
};
use sph_multiphase::{BoundState, Limiter};
use sph_neighbours::{Interaction, World, wall_forces};
use sph_stress::{CoulombFriction, ElasticMotion, PoreFlow};

use crate::step::clocks::{LISTS, MOTION, SEEPAGE_NAME, Timing};
use crate::step::dilatation::Dilatation;
use crate::step::implicit::ImplicitViscosity;
use crate::step::kept_rates::Kept;
use crate::step::outlets::Outlets;
use crate::step::snapshot::Snapshot;
use crate::step::stages::{SharedWall, lock};
use crate::step::sub_steps::SubSteps;

/// The assembled system of one scene.
pub struct Flow<const D: usize> {
    /// Columns, walls, lists, kernel, clock.
    pub world: World<D>,
    /// Stages in the order of the plan.
    pub(crate) stages: Vec<Box<dyn Stage<World<D>>>>,
    /// Names of the stages nobody needed.
    pub(crate) pruned: Vec<String>,
    pub(crate) limiters: Vec<Box<dyn Limiter<D>>>,
    pub(crate) walls: Option<SharedWall<D>>,
    pub(crate) evolved: Vec<Evolved>,
    /// All scalars that the integrator changes.
    pub(crate) integrated: Vec<Field<Scalar>>,
    /// Remembered stresses that follow the motion.
    pub(crate) elastic: Option<ElasticMotion<D>>,
    /// Elastic forces that have steps of their own.
    pub(crate) sub_steps: Option<SubSteps<D>>,
    /// Friction of soils on walls.
    pub(crate) coulomb: Option<CoulombFriction<D>>,
    /// Water that moves through pores.
    pub(crate) seepage: Option<Box<dyn PoreFlow<D>>>,
    /// Whether somebody moved since the last evaluation.
    pub(crate) moved: bool,
    /// Whether the columns of state are those that the last evaluation before a checkpoint or a snapshot left.
    pub(crate) restored: bool,
    /// What motion compresses.
    pub(crate) dilatation: Option<Dilatation<D>>,
    /// The state that an integrator keeps within a step.
    pub(crate) kept: Snapshot<D>,
    /// Accelerations and scalar rates of the kept state.
    pub(crate) kept_rates: Kept<D>,
    pub(crate) laws: std::sync::Arc<[Box<dyn BoundState>]>,
    /// η/ρ₀ of every phase, m²/s.
    pub(crate) kinematic_viscosities: Vec<f64>,
    /// The pair terms of the interaction sweep.
    pub(crate) terms: std::sync::Arc<[Box<dyn Interaction<D>>]>,
    /// What plugin every term comes from, by the term's name.
    pub(crate) kinds: Vec<(String, &'static str)>,
    /// Friction that is solved for, as a term.
    pub(crate) solved: Option<Box<dyn Interaction<D>>>,
    pub(crate) implicit: Option<ImplicitViscosity<D>>,
    pub(crate) timings: Vec<Timing>,
    /// Where particles leave.
    pub(crate) outlets: Outlets<D>,
    /// What plugins bring along whose kinds the solver does not know.
    pub(crate) contributions: Vec<Box<dyn Contribution<D>>>,
}

impl<const D: usize> Flow<D> {
    /// Smallest step limit with its name; the smallest of all plugins.
    ///
    /// # Errors
    /// If a limiter misses a column.
    pub fn step_limits(&self) -> Result<Vec<StepLimit>, StepError> {
        self.limiters.iter().map(|l| l.limit(&self.world)).collect()
    }
}

impl<const D: usize> System for Flow<D> {
    fn evaluate(&mut self) -> Result<(), StepError> {
        self.run_stages(|_| true)
    }

    fn evaluate_forces(&mut self) -> Result<(), StepError> {
        let state = [fields::DENSITY, fields::VOLUME, fields::PRESSURE].map(|f| f.any());
        let gives_state = |a: &Access| a.writes.iter().any(|f| state.contains(f));
        self.refresh_lists_and_derived()?;
        self.run_stages(|stage| !gives_state(&stage.access()))
    }

    fn keep(&mut self) -> Result<(), StepError> {
        let mut kept = std::mem::take(&mut self.kept);
        kept.take(self)?;
        self.kept = kept;
        self.keep_rates()
    }

    fn recall(&mut self, what: Recall) -> Result<(), StepError> {
        let kept = std::mem::take(&mut self.kept);
        kept.recall(self, what)?;
        self.kept = kept;
        Ok(())
    }

    fn average_rates(&mut self) -> Result<(), StepError> {
        self.average_with_kept()
    }

    fn kick(&mut self, dt: f64) -> Result<(), StepError> {
        let pressed = match &self.coulomb {
            None => None,
            Some(coulomb) => Some(coulomb.pressed(&self.world, &self.forces())?),
        };
        let start = Instant::now();
        let mut velocity = self.world.free.take(fields::VELOCITY)?;
        let solved = self.implicit.is_some() || self.seepage.is_some();
        let earlier = if solved { velocity.clone() } else { Vec::new() };
        if self.sub_steps.is_none() {
            let acceleration = self.world.free.get(fields::ACCELERATION)?;
            let all = velocity.par_iter_mut().zip(acceleration);
            all.with_min_len(2048).for_each(|(u, a)| *u += a * dt);
        }
        self.world.free.put(fields::VELOCITY, velocity)?;
        for evolved in &self.evolved {
            let mut value = self.world.free.take(evolved.value)?;
            let rate = self.world.free.get(evolved.rate)?;
            value
                .par_iter_mut()
                .zip(rate)
                .with_min_len(2048)
                .for_each(|(v, r)| *v += r * dt);
            self.world.free.put(evolved.value, value)?;
        }
        self.timings[MOTION].spent += start.elapsed();
        self.vibrate(dt)?;
        self.rub(&earlier, dt)?;
        if let Some((coulomb, pressed)) = self.coulomb.as_mut().zip(pressed) {
            coulomb.apply(&mut self.world, &pressed, dt)?;
        }
        self.seep(&earlier, dt)?;
        for contribution in &mut self.contributions {
            self.world.free.watch(&contribution.work());
            let ran = contribution.after_kick(&mut self.world, dt);
            self.world.free.unwatch("after a kick").and(ran)?;
        }
        Ok(())
    }

    fn drift(&mut self, dt: f64) -> Result<(), StepError> {
        let start = Instant::now();
        // Places go with the mean of sub-steps, what is left of the stress with the last.
        self.shift_to_mean(1.0)?;
        if let Some(walls) = &self.walls {
            lock(walls).constrain(&mut self.world, dt)?;
        }
        self.shift_to_mean(-1.0)?;
        self.deform(self.stress_behind(dt))?;
        self.shift_to_mean(1.0)?;
        match self.dilatation.take() {
            None => self.advance(dt)?,
            Some(mut dilatation) => {
                // The divergence of the middle of the drift: second order.
                self.advance(0.5 * dt)?;
                let applied = self.compress(&mut dilatation, dt);
                self.dilatation = Some(dilatation);
                applied?;
                self.advance(0.5 * dt)?;
            }
        }
        self.shift_to_mean(-1.0)?;
        for contribution in &mut self.contributions {
            self.world.free.watch(&contribution.work());
            let ran = contribution.after_drift(&mut self.world, dt);
            self.world.free.unwatch("after a drift").and(ran)?;
        }
        self.timings[MOTION].spent += start.elapsed();
        Ok(())
    }

    fn time(&self) -> f64 {
        self.world.time
    }

    fn limits(&self) -> Vec<StepLimit> {
        self.step_limits().unwrap_or_default()
    }
}

impl<const D: usize> Flow<D> {
    /// Friction from the end of the step, where it is taken so.
    fn rub(&mut self, earlier: &[Vect<D>], dt: f64) -> Result<(), StepError> {
        let Some(mut implicit) = self.implicit.take() else {
            return Ok(());
        };
        let start = Instant::now();
        let done = implicit.apply(&mut self.world, earlier, dt);
        self.implicit = Some(implicit);
        if let Some(last) = self.timings.last_mut() {
            last.spent += start.elapsed();
        }
        done
    }

    /// Water moves through pores, driven by what the kick has done.
    fn seep(&mut self, earlier: &[Vect<D>], dt: f64) -> Result<(), StepError> {
        let Some(seepage) = &mut self.seepage else {
            return Ok(());
        };
        let start = Instant::now();
        let done = seepage.advance(&mut self.world, earlier, dt);
        let timing = self.timings.iter_mut().find(|t| t.name == SEEPAGE_NAME);
        if let Some(timing) = timing {
            timing.spent += start.elapsed();
        }
        done
    }

    fn run_stages(
        &mut self,
        wanted: impl Fn(&dyn Stage<World<D>>) -> bool,
    ) -> Result<(), StepError> {
        let start = Instant::now();
        crate::step::guard::positions(&self.world)?;
        self.world.refresh_lists()?;
        self.timings[LISTS].spent += start.elapsed();
        self.moved = false;
        let restored = std::mem::take(&mut self.restored);
        let state = match restored {
            true => self.state_columns(),
            false => Vec::new(),
        };
        // What only writes state has been done: a solve would start from its own result.
        let done = |stage: &dyn Stage<World<D>>| {
            let writes = stage.access().writes;
            restored && !writes.is_empty() && writes.iter().all(|f| state.contains(&f.name))
        };
        for (k, stage) in self.stages.iter_mut().enumerate() {
            if !wanted(&**stage) || done(&**stage) {
                continue;
            }
            let start = Instant::now();
            if cfg!(debug_assertions) {
                self.world.free.watch(&stage.access());
            }
            let ran = stage.run(&mut self.world);
            self.world.free.unwatch(&stage.name()).and(ran)?;
            self.timings[MOTION + 1 + k].spent += start.elapsed();
        }
        Ok(())
    }

    /// Particles and walls follow their velocities for a time.
    fn advance(&mut self, dt: f64) -> Result<(), StepError> {
        let mut position = self.world.free.take(fields::POSITION)?;
        let velocity = self.world.free.get(fields::VELOCITY)?;
        let all = position.par_iter_mut().zip(velocity).with_min_len(2048);
        match self.world.free.get(fields::SHIFT_VELOCITY) {
            Err(_) => all.for_each(|(x, u)| *x += u * dt),
            Ok(shift) => all.zip(shift).for_each(|((x, u), s)| *x += (u + s) * dt),
        }
        self.world.free.put(fields::POSITION, position)?;
        self.displace(dt)?;
        self.moved = true;
        self.world.time += dt;
        if let Some(walls) = &self.walls {
            let time = self.world.time;
            let moved = lock(walls).move_to(&mut self.world.walls, time);
            moved.map_err(|e| StepError::Stage {
                stage: "wall motion".into(),
                reason: e.to_string(),
            })?;
        }
        Ok(())
    }

    /// Adds the way of a drift to the displacements, where they are kept.
    fn displace(&mut self, dt: f64) -> Result<(), StepError> {
        let free = &mut self.world.free;
        if !free.has(fields::DISPLACEMENT.name) {
            return Ok(());
        }
        let mut displacement = free.take(fields::DISPLACEMENT)?;
        let velocity = free.get(fields::VELOCITY)?;
        let all = displacement.par_iter_mut().zip(velocity).with_min_len(2048);
        match free.get(fields::SHIFT_VELOCITY) {
            Err(_) => all.for_each(|(d, u)| *d += u * dt),
            Ok(shift) => all.zip(shift).for_each(|((d, u), s)| *d += (u + s) * dt),
        }
        Ok(free.put(fields::DISPLACEMENT, displacement)?)
    }

    /// Remembered stresses follow the velocities of the drift that begins.
    fn deform(&mut self, dt: f64) -> Result<(), StepError> {
        let Some(mut elastic) = self.elastic.take() else {
            return Ok(());
        };
        let given = [
            fields::RENORMALISATION,
            fields::DENSITY,
            fields::VOLUME,
            fields::PRESSURE,
        ];
        let gives_state = |a: &Access| given.iter().any(|f| a.writes.contains(&f.any()));
        let moved = match self.moved {
            true => self.run_stages(|stage| gives_state(&stage.access())),
            false => Ok(()),
        };
        let done = moved.and_then(|()| elastic.apply(&mut self.world, dt));
        self.elastic = Some(elastic);
        done
    }

    fn compress(&mut self, dilatation: &mut Dilatation<D>, dt: f64) -> Result<(), StepError> {
        self.refresh_lists_and_derived()?;
        if let Some(walls) = &self.walls {
            lock(walls).geometry(&mut self.world)?;
        }
        dilatation.apply(&mut self.world, dt)
    }

    /// Largest extent of the particles along any axis, m.
    pub(crate) fn extent(&self) -> f64 {
        let Ok(position) = self.world.free.get(fields::POSITION) else {
            return 0.0;
        };
        (0..D)
            .map(|k| {
                let all = || position.iter().map(|x| x[k]);
                all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
            })
            .fold(0.0, f64::max)
    }

    /// The terms that push particles, included friction that is solved for and what has steps of its own.
    pub(crate) fn forces(&self) -> Vec<&dyn Interaction<D>> {
        let terms = self.terms.iter().map(|t| &**t);
        let own_steps = self.sub_steps.iter().map(|sub| &*sub.of.term);
        terms
            .chain(own_steps)
            .chain(self.solved.as_deref())
            .collect()
    }

    /// Measures the forces on the wanted walls at the state of the last evaluation; those on others are NaN.
    ///
    /// # Errors
    /// If a term misses a column.
    pub fn measure_wall_forces(&mut self, wanted: impl Fn(&str) -> bool) -> Result<(), StepError> {
        if !self.world.free.has(fields::ACCELERATION.name) || self.world.lists.builds == 0 {
            return Ok(());
        }
        let wanted: Vec<bool> = self.world.walls.names.iter().map(|n| wanted(n)).collect();
        let mut forces = wall_forces(&self.world, &self.forces(), &wanted)?;
        if let Some(coulomb) = &self.coulomb {
            let walls = forces.iter_mut().zip(&coulomb.forces);
            walls.for_each(|(whole, friction)| whole.add(friction));
        }
        self.world.walls.forces = forces;
        Ok(())
    }

    /// Particles behind a wall.
    ///
    /// # Errors
    /// If there is no position column.
    pub fn escaped(&self) -> Result<usize, StepError> {
        let Some(walls) = &self.walls else {
            return Ok(0);
        };
        let walls = lock(walls);
        let position = self.world.free.get(fields::POSITION)?;
        Ok(position.iter().filter(|x| !walls.contains(x)).count())
    }

    /// Least and largest K/ρ₀, if the formulation has a density constant.
    pub(crate) fn density_constant_range(&self) -> Option<[f64; 2]> {
        let constant = self.world.free.get(fields::DENSITY_CONSTANT).ok()?;
        let phase = self.world.free.get(fields::PHASE).ok();
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for (i, k) in constant.iter().enumerate() {
            let law = &self.laws[phase.map_or(0, |p| p[i] as usize)];
            let ratio = k / law.reference().density;
            range = [range[0].min(ratio), range[1].max(ratio)];
        }
        Some(range)
    }

    /// Names of the columns that the stages of the plan write.
    pub(crate) fn written_by_stages(&self) -> Vec<&'static str> {
        let writes = self.stages.iter().flat_map(|s| s.access().writes);
        writes.map(|f| f.name).collect()
    }

    /// Names of the columns that carry history, in order of allocation.
    pub(crate) fn state_columns(&self) -> Vec<&'static str> {
        let columns = self.world.free.columns();
        let state = columns.filter(|(_, _, role, ..)| *role == Role::State);
        state.map(|(name, ..)| name).collect()
    }
}
