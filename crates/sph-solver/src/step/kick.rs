//! The kick: velocities and transported scalars follow their rates.

use std::time::Instant;

use rayon::prelude::*;
use sph_core::{StepError, fields};

use crate::step::clocks::MOTION;
use crate::step::flow::Flow;
use crate::step::stages::lock;

/// Particles that one thread takes at least.
const BATCH: usize = 2048;

impl<const D: usize> Flow<D> {
    /// Velocities and evolved scalars: value += Δt rate, and all that works besides.
    pub(crate) fn kick_over(&mut self, dt: f64) -> Result<(), StepError> {
        self.load_walls()?;
        self.before_kick()?;
        let start = Instant::now();
        if !self.works.iter().any(|w| w.kicks()) {
            let mut velocity = self.world.free.take(fields::VELOCITY)?;
            let acceleration = self.world.free.get(fields::ACCELERATION)?;
            let all = velocity.par_iter_mut().zip(acceleration);
            all.with_min_len(BATCH).for_each(|(u, a)| *u += a * dt);
            self.world.free.put(fields::VELOCITY, velocity)?;
        }
        for evolved in &self.evolved {
            let mut value = self.world.free.take(evolved.value)?;
            let rate = self.world.free.get(evolved.rate)?;
            let all = value.par_iter_mut().zip(rate).with_min_len(BATCH);
            all.for_each(|(v, r)| *v += r * dt);
            self.world.free.put(evolved.value, value)?;
        }
        self.timings[MOTION].spent += start.elapsed();
        self.each_work(|work, world| match work.kicks() {
            true => work.kick(world, dt),
            false => Ok(()),
        })?;
        self.each_work(|work, world| work.after_kick(world, dt))
    }

    /// Measures what the fluid does to walls whose movers ask for it.
    fn load_walls(&mut self) -> Result<(), StepError> {
        let Some(walls) = &self.walls else {
            return Ok(());
        };
        let names = &self.world.walls.names;
        let felt: Vec<String> = {
            let walls = lock(walls);
            let all = names.iter().enumerate();
            all.filter(|(k, _)| walls.feels(*k))
                .map(|(_, n)| n.clone())
                .collect()
        };
        match felt.is_empty() {
            true => Ok(()),
            false => self.measure_wall_forces(|name| felt.iter().any(|n| n == name)),
        }
    }

    /// What is asked before a kick; it may bind all terms, so that it reads their columns, too.
    fn before_kick(&mut self) -> Result<(), StepError> {
        let terms = self.terms.clone();
        let outside = self.outside.clone();
        let forces: Vec<_> = (terms.iter().map(|t| &**t))
            .chain(outside.iter().map(|f| &**f))
            .collect();
        let reads = || forces.iter().map(|t| t.access());
        self.each_work_with(reads, |work, world| work.before_kick(world, &forces))
    }
}
