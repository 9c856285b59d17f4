//! The kick: velocities and transported scalars follow their rates.

use std::time::Instant;

use rayon::prelude::*;
use sph_contribution::Forces;
use sph_core::{StepError, fields};
use sph_neighbours::{WallForce, facing_forces, reactions};

use crate::step::books::Books;
use crate::step::clocks::MOTION;
use crate::step::flow::Flow;
use crate::step::stages::lock;

/// Particles that one thread takes at least.
const BATCH: usize = 2048;

impl<const D: usize> Flow<D> {
    /// Velocities and evolved scalars: value += Δt rate, and all that works besides.
    pub(crate) fn kick_over(&mut self, dt: f64) -> Result<(), StepError> {
        let felt = self.felt();
        self.load_walls(&felt)?;
        self.look_before_walls()?;
        self.before_kick()?;
        if let Some(books) = &mut self.books {
            books.before_kick(&self.world, &self.terms, &self.kinds)?;
        }
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
        self.after_kick(dt)?;
        self.load_walls_more(&felt)
    }

    /// What works on velocities and scalars that have been advanced.
    fn after_kick(&mut self, dt: f64) -> Result<(), StepError> {
        let Some(mut books) = self.books.take() else {
            return self.each_work(|work, world| work.after_kick(world, dt));
        };
        let done = self.after_booked_kick(&mut books, dt);
        self.books = Some(books);
        done
    }

    /// The same, with the books open.
    fn after_booked_kick(&mut self, books: &mut Books<D>, dt: f64) -> Result<(), StepError> {
        let kicker = self.works.iter().position(|w| w.kicks());
        books.kicked(&self.world, dt, kicker)?;
        let mut number = 0;
        self.each_work_with(&[books.access()], |work, world| {
            work.after_kick(world, dt)?;
            books.worked(world, number)?;
            number += 1;
            Ok(())
        })?;
        books.settled(&mut self.world, dt)
    }

    /// Whether the mover of each wall asks for forces; empty if none does.
    fn felt(&self) -> Vec<bool> {
        let Some(walls) = &self.walls else {
            return Vec::new();
        };
        let walls = lock(walls);
        let names = &self.world.walls.names;
        if !(0..names.len()).any(|k| walls.feels(k)) {
            return Vec::new();
        }
        let movers: Vec<bool> = (0..names.len()).map(|k| walls.feels(k)).collect();
        let all_of_it = |name: &String| (names.iter().zip(&movers)).any(|(n, f)| *f && n == name);
        names.iter().map(all_of_it).collect()
    }

    /// Measures what the terms of the sweep do to walls whose movers ask for it, with the velocities of the sweep.
    fn load_walls(&mut self, felt: &[bool]) -> Result<(), StepError> {
        if felt.is_empty() || self.world.lists.builds == 0 {
            return Ok(());
        }
        let terms: Vec<_> = self.terms.iter().map(|t| &**t).collect();
        self.loads = reactions(&self.world, &terms, felt)?;
        let facing = facing_forces(&self.world, felt)?;
        self.loads
            .iter_mut()
            .zip(&facing)
            .for_each(|(f, more)| f.add(more));
        Ok(())
    }

    /// Measures the depth of the fluid before walls whose movers look at it.
    fn look_before_walls(&mut self) -> Result<(), StepError> {
        let Some(walls) = &self.walls else {
            return Ok(());
        };
        let sights = lock(walls).sights();
        if sights.is_empty() {
            return Ok(());
        }
        (self.loads).resize(self.world.walls.names.len(), WallForce::zero());
        for (wall, sight) in sights {
            self.loads[wall].depth = sight.depth(&self.world)?;
        }
        Ok(())
    }

    /// Adds what acts outside of the sweep: it has taken the velocities that it left.
    fn load_walls_more(&mut self, felt: &[bool]) -> Result<(), StepError> {
        if felt.is_empty() || self.world.lists.builds == 0 {
            return Ok(());
        }
        if !self.outside.is_empty() {
            let outside: Vec<_> = self.outside.iter().map(|f| &**f).collect();
            let more = reactions(&self.world, &outside, felt)?;
            let walls = self.loads.iter_mut().zip(more);
            walls.for_each(|(whole, more)| {
                whole.force += more.force;
                (0..3).for_each(|k| whole.moment[k] += more.moment[k]);
            });
        }
        for work in &self.works {
            let walls = self.loads.iter_mut().zip(work.wall_forces());
            walls.for_each(|(whole, own)| whole.add(own));
        }
        Ok(())
    }

    /// What is asked before a kick; it may bind all terms, so that it reads their columns, too.
    fn before_kick(&mut self) -> Result<(), StepError> {
        let terms = self.terms.clone();
        let outside = std::mem::take(&mut self.outside);
        let forces = Forces {
            sweep: &terms,
            outside: &outside,
        };
        let reads = std::mem::take(&mut self.columns.forces);
        let done = self.each_work_with(&reads, |work, world| work.before_kick(world, forces));
        self.columns.forces = reads;
        self.outside = outside;
        done
    }
}
