//! The drift: particles and walls follow their velocities.

use std::time::Instant;

use rayon::prelude::*;
use sph_core::{AnyField, StepError, fields};
use sph_probes::EnergyWork;

use crate::step::clocks::MOTION;
use crate::step::declared::writes_any;
use crate::step::flow::Flow;
use crate::step::stages::lock;

/// Particles that one thread takes at least.
const BATCH: usize = 2048;

/// The stage in which walls move.
pub(crate) const WALL_MOTION: &str = "wall motion";

/// What work before a drift may ask for at the present positions.
const STATE: [AnyField; 4] = [
    fields::RENORMALISATION.any(),
    fields::DENSITY.any(),
    fields::VOLUME.any(),
    fields::PRESSURE.any(),
];

impl<const D: usize> Flow<D> {
    /// Positions: r += Δt u, and all that works besides.
    pub(crate) fn drift_over(&mut self, dt: f64) -> Result<(), StepError> {
        self.each_work(|work, world| work.before_walls(world))?;
        self.book_turns(EnergyWork::Others)?;
        let start = Instant::now();
        if let Some(walls) = &self.walls {
            lock(walls).constrain(&mut self.world, dt)?;
        }
        self.timings[MOTION].spent += start.elapsed();
        self.book_turns(EnergyWork::Walls)?;
        if self.moved && self.works.iter().any(|w| w.needs_state_in_drifts()) {
            self.run_stages(|stage| writes_any(stage, &STATE))?;
        }
        self.each_work(|work, world| work.before_drift(world, dt))?;
        self.book_turns(EnergyWork::Others)?;
        if let Some(books) = &mut self.books {
            books.drifts(&mut self.world, dt)?;
        }
        match self.works.iter().any(|w| w.halves_drifts()) {
            false => self.advance(dt)?,
            true => {
                // What works in the middle is of second order.
                self.advance(0.5 * dt)?;
                self.look_around()?;
                self.each_work(|work, world| work.amid_drift(world, dt))?;
                self.advance(0.5 * dt)?;
            }
        }
        self.each_work(|work, world| work.after_drift(world, dt))
    }

    /// Books velocities that somebody has turned.
    fn book_turns(&mut self, of: EnergyWork) -> Result<(), StepError> {
        match &mut self.books {
            Some(books) => Ok(books.turned(&mut self.world, of)?),
            None => Ok(()),
        }
    }

    /// Lists, wall contacts and γ of the present positions.
    fn look_around(&mut self) -> Result<(), StepError> {
        let start = Instant::now();
        self.refresh_lists_and_derived()?;
        if let Some(walls) = &self.walls {
            lock(walls).geometry(&mut self.world)?;
        }
        self.timings[MOTION].spent += start.elapsed();
        Ok(())
    }

    /// Particles and walls follow their velocities for a time.
    fn advance(&mut self, dt: f64) -> Result<(), StepError> {
        let start = Instant::now();
        let mut position = self.world.free.take(fields::POSITION)?;
        let velocity = self.world.free.get(fields::VELOCITY)?;
        let all = position.par_iter_mut().zip(velocity).with_min_len(BATCH);
        match self.world.free.get(fields::SHIFT_VELOCITY) {
            Err(_) => all.for_each(|(x, u)| *x += u * dt),
            Ok(shift) => all.zip(shift).for_each(|((x, u), s)| *x += (u + s) * dt),
        }
        self.world.free.put(fields::POSITION, position)?;
        self.displace(dt)?;
        self.moved = true;
        let time = self.world.time;
        self.world.time += dt;
        if let Some(walls) = &self.walls {
            let gravity = self.world.gravity;
            let set = &mut self.world.walls;
            // Probes may have measured other walls since the kick.
            std::mem::swap(&mut set.forces, &mut self.loads);
            let moved = lock(walls).advance(set, gravity, time, dt);
            std::mem::swap(&mut set.forces, &mut self.loads);
            moved.map_err(|e| StepError::Stage {
                stage: WALL_MOTION.into(),
                reason: e.to_string(),
            })?;
        }
        self.timings[MOTION].spent += start.elapsed();
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
        let all = displacement
            .par_iter_mut()
            .zip(velocity)
            .with_min_len(BATCH);
        match free.get(fields::SHIFT_VELOCITY) {
            Err(_) => all.for_each(|(d, u)| *d += u * dt),
            Ok(shift) => all.zip(shift).for_each(|((d, u), s)| *d += (u + s) * dt),
        }
        Ok(free.put(fields::DISPLACEMENT, displacement)?)
    }
}
