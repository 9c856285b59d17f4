//! The kick: velocities and transported scalars follow their rates.

use std::time::Instant;

use rayon::prelude::*;
use sph_contribution::StepPhase;
use sph_core::{StepError, fields};
use sph_neighbours::{WallForce, loads, reactions};

use crate::step::flow::{Flow, MOTION};
use crate::step::hooks::Boundary;

const BATCH: usize = 2048;

impl<const D: usize> Flow<D> {
    /// Velocities and evolved scalars: value += Δt rate, and all hooks.
    pub(crate) fn kick_over(&mut self, dt: f64) -> Result<(), StepError> {
        let force_requests = self.force_requests();
        if !force_requests.is_empty() && self.world.lists.builds > 0 {
            self.loads = self.wall_loads(&force_requests)?;
        }
        self.look_before_walls()?;
        self.on_walls.clear();
        self.run_hooks(StepPhase::BeforeKick, dt)?;
        self.observe(Boundary::Kicks, dt)?;
        let start = Instant::now();
        if self.hooks.kicking.is_empty() {
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
        self.run_kicks(dt)?;
        self.observe(Boundary::Kicked, dt)?;
        self.run_hooks(StepPhase::AfterKick, dt)?;
        self.observe(Boundary::KickEnds, dt)?;
        self.load_walls_more(&force_requests)
    }

    /// Marks of walls whose mover needs forces; empty if none does.
    pub fn force_requests(&self) -> Vec<bool> {
        let Some(walls) = &self.walls else {
            return Vec::new();
        };
        let names = &self.world.walls.names;
        if !(0..names.len()).any(|k| walls.needs_forces(k)) {
            return Vec::new();
        }
        let movers: Vec<bool> = (0..names.len()).map(|k| walls.needs_forces(k)).collect();
        let all_of_it = |name: &String| (names.iter().zip(&movers)).any(|(n, f)| *f && n == name);
        names.iter().map(all_of_it).collect()
    }

    /// Forces of the terms of the sweep on the requested walls, with the velocities of the sweep; of a finer flow where one
    /// has measured them.
    ///
    /// # Errors
    /// If a term misses a column.
    pub fn wall_loads(&self, force_requests: &[bool]) -> Result<Vec<WallForce<D>>, StepError> {
        let terms: Vec<_> = self.terms.iter().map(|t| &**t).collect();
        let mut loads = loads(&self.world, &terms, force_requests)?;
        for (wall, finer) in &self.finer_loads {
            loads[*wall] = *finer;
        }
        Ok(loads)
    }

    /// Measures the depth of the fluid before walls whose movers need it.
    fn look_before_walls(&mut self) -> Result<(), StepError> {
        let walls = self.walls.as_ref();
        let depth_gauges = walls.map_or(Vec::new(), |walls| walls.depth_gauges());
        if depth_gauges.is_empty() {
            return Ok(());
        }
        (self.loads).resize(self.world.walls.names.len(), WallForce::zero());
        for (wall, gauge) in depth_gauges {
            self.loads[wall].depth = gauge.depth(&self.world)?;
        }
        Ok(())
    }

    /// Adds forces from outside of the sweep, which read the velocities after it.
    fn load_walls_more(&mut self, force_requests: &[bool]) -> Result<(), StepError> {
        if force_requests.is_empty() || self.world.lists.builds == 0 {
            return Ok(());
        }
        if !self.outside.is_empty() {
            let outside: Vec<_> = self.outside.iter().map(|f| &**f).collect();
            let more = reactions(&self.world, &outside, force_requests)?;
            let walls = self.loads.iter_mut().zip(&more);
            walls.for_each(|(whole, more)| whole.add(more));
        }
        let walls = self.loads.iter_mut().zip(&self.on_walls);
        walls.for_each(|(whole, own)| whole.add(own));
        Ok(())
    }
}
