//! The drift: particles and walls follow their velocities.

use std::time::Instant;

use rayon::prelude::*;
use sph_contribution::StepPhase;
use sph_core::{AnyField, Field, FieldError, StepError, Vector, fields};

use crate::step::flow::{Flow, MOTION};
use crate::step::hooks::{Boundary, writes_any};

const BATCH: usize = 2048;

/// The stage in which walls move.
pub const WALL_MOTION: &str = "wall motion";

/// Data of hooks before a drift at the present positions.
const STATE: [AnyField; 4] = [
    fields::RENORMALISATION.any(),
    fields::DENSITY.any(),
    fields::VOLUME.any(),
    fields::PRESSURE.any(),
];

impl<const D: usize> Flow<D> {
    /// Positions: r += Δt u, and all hooks.
    pub(crate) fn drift_over(&mut self, dt: f64) -> Result<(), StepError> {
        self.run_hooks(StepPhase::BeforeWalls, dt)?;
        let start = Instant::now();
        if let Some(walls) = &mut self.walls {
            walls.constrain(&mut self.world, dt)?;
        }
        self.timings[MOTION].spent += start.elapsed();
        self.observe(Boundary::Constrained, dt)?;
        if self.moved && self.fresh_state {
            self.run_stages(|stage| writes_any(stage, &STATE))?;
        }
        self.run_hooks(StepPhase::BeforeDrift, dt)?;
        self.observe(Boundary::Drifts, dt)?;
        match self.hooks.during(StepPhase::MidDrift).is_empty() {
            true => self.advance(dt)?,
            false => {
                // Hooks in the middle are of second order.
                self.advance(0.5 * dt)?;
                self.look_around()?;
                self.run_hooks(StepPhase::MidDrift, dt)?;
                self.advance(0.5 * dt)?;
            }
        }
        self.run_hooks(StepPhase::AfterDrift, dt)
    }

    /// Lists, wall contacts and γ of the present positions.
    fn look_around(&mut self) -> Result<(), StepError> {
        let start = Instant::now();
        self.refresh_lists_and_derived()?;
        if let Some(walls) = &mut self.walls {
            walls.geometry(&mut self.world)?;
        }
        self.timings[MOTION].spent += start.elapsed();
        Ok(())
    }

    fn advance(&mut self, dt: f64) -> Result<(), StepError> {
        let start = Instant::now();
        self.carry(fields::POSITION, dt)?;
        if self.world.free.has(fields::DISPLACEMENT.name) {
            self.carry(fields::DISPLACEMENT, dt)?;
        }
        self.moved = true;
        let time = self.world.time;
        self.world.time += dt;
        if let Some(walls) = &mut self.walls {
            let gravity = self.world.gravity;
            let set = &mut self.world.walls;
            // Probes may have measured other walls since the kick.
            std::mem::swap(&mut set.forces, &mut self.loads);
            let moved = walls.advance(set, gravity, time, dt);
            std::mem::swap(&mut set.forces, &mut self.loads);
            moved.map_err(|e| StepError::stage(WALL_MOTION, e.to_string()))?;
        }
        self.timings[MOTION].spent += start.elapsed();
        Ok(())
    }

    /// Adds the way of a drift to positions or displacements.
    fn carry(&mut self, field: Field<Vector>, dt: f64) -> Result<(), FieldError> {
        let free = &mut self.world.free;
        let mut places = free.take(field)?;
        let velocity = free.get(fields::VELOCITY)?;
        let all = places.par_iter_mut().zip(velocity).with_min_len(BATCH);
        match free.get(fields::SHIFT_VELOCITY) {
            Err(_) => all.for_each(|(x, u)| *x += u * dt),
            Ok(shift) => all.zip(shift).for_each(|((x, u), s)| *x += (u + s) * dt),
        }
        free.put(field, places)
    }
}
