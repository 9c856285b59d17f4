//! Particles that leave the flow.

use rayon::prelude::*;
use sph_contribution::even_out;
use sph_core::{StepError, Vect, fields};
use sph_neighbours::Words;
use sph_scene::Scene;

use crate::Flow;
use crate::step::outlets::OutletTotals;

struct LeavingParticle<const D: usize> {
    identity: u32,
    /// Number of the count in which it is.
    count: usize,
    position: Vect<D>,
    mass: f64,
}

impl<const D: usize> Words for LeavingParticle<D> {
    fn write(&self, to: &mut Vec<u64>) {
        to.extend([u64::from(self.identity), self.count as u64]);
        let numbers = [&self.mass].into_iter().chain(self.position.iter());
        to.extend(numbers.map(|x| x.to_bits()));
    }

    fn read(from: &[u64]) -> Self {
        LeavingParticle {
            identity: from[0] as u32,
            count: from[1] as usize,
            mass: f64::from_bits(from[2]),
            position: Vect::from_fn(|k, _| f64::from_bits(from[3 + k])),
        }
    }
}

impl<const D: usize> Flow<D> {
    /// Takes out the particles that are in an outlet or have passed an open face at the end of a step of `dt` seconds, and
    /// counts them in their order.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn let_out(&mut self, dt: f64) -> Result<(), StepError> {
        // First the gates that read wall contacts, which are by slots.
        self.by_gates(dt)?;
        self.by_outlets(dt)
    }

    /// Counts the exits of all gates behind the outlets, and behind these the border of the domain where walls end freely.
    pub fn know_exits(&mut self, scene: &Scene) {
        let taken = &mut self.world.free.removed;
        let exits = self.gates.iter().flat_map(|gate| gate.exits());
        for (exit, name) in (self.outlets.all.len()..).zip(exits) {
            taken.extend(self.outlets.label(&format!("open.{name}"), exit, scene));
        }
        self.outlets.named = self.outlets.labels.len();
        if self.walls.as_ref().is_some_and(|w| w.ends_freely()) {
            let border = self.outlets.named / scene.phase.len().max(1);
            self.outlets.border = Some(border);
            taken.extend(self.outlets.label("domain", border, scene));
        }
    }

    fn by_gates(&mut self, dt: f64) -> Result<(), StepError> {
        let mut first = self.outlets.all.len();
        for k in 0..self.gates.len() {
            let gate = &mut self.gates[k];
            let exits = gate.exits().len();
            if exits == 0 {
                continue;
            }
            self.world.free.watch([&self.columns.gates[k]]);
            let gone = gate.departures(&mut self.world, dt);
            self.world.free.unwatch(|| gate.name())?;
            self.take_out(&gone?, first)?;
            first += exits;
        }
        Ok(())
    }

    fn take_out(&mut self, gone: &[(u32, usize)], first: usize) -> Result<(), StepError> {
        if !self.any_rank(!gone.is_empty())? {
            return Ok(());
        }
        self.count_leavers(gone.iter().map(|(p, exit)| (*p as usize, first + exit)))?;
        if !gone.is_empty() {
            let free = &mut self.world.free;
            let mut leaves = vec![false; free.len()];
            gone.iter().for_each(|(p, _)| leaves[*p as usize] = true);
            free.take_out(&leaves);
        }
        Ok(())
    }

    fn by_outlets(&mut self, dt: f64) -> Result<(), StepError> {
        let (all, border) = (&self.outlets.all, self.outlets.border);
        if all.is_empty() && border.is_none() {
            return Ok(());
        }
        let free = &self.world.free;
        let (position, velocity) = (free.get(fields::POSITION)?, free.get(fields::VELOCITY)?);
        let phase = free.get(fields::PHASE).ok();
        // A particle as fast as sound was not spilled: it ends the run.
        let slow = |k: usize| {
            let law = &self.laws[phase.map_or(0, |p| p[k] as usize)];
            velocity[k].norm() < law.reference().sound_speed
        };
        // Before a drift within the next step takes it across.
        let soon = |k: usize, x: &Vect<D>| x + velocity[k] * (2.0 * dt);
        let domain = &self.world.domain;
        let out = |k, x: &Vect<D>| border.filter(|_| !domain.contains(&soon(k, x)) && slow(k));
        let by = |(k, x): (usize, &Vect<D>)| {
            let outlet = all.iter().position(|o| o.contains(&(*x).into()));
            outlet.or_else(|| out(k, x))
        };
        let places = || position.par_iter().enumerate().with_min_len(2048).map(by);
        let some = places().any(|outlet| outlet.is_some());
        let left: Vec<Option<usize>> = if some { places().collect() } else { Vec::new() };
        if !self.any_rank(some)? {
            return Ok(());
        }
        let leavers = left.iter().enumerate();
        let leavers = leavers.filter_map(|(k, outlet)| Some((k, (*outlet)?)));
        let places = self.count_leavers(leavers)?;
        even_out(&mut self.world, &places, 1.0)?;
        if some {
            let leaves: Vec<bool> = left.iter().map(Option::is_some).collect();
            self.world.free.take_out(&leaves);
        }
        Ok(())
    }

    /// Counts the particles that leave by each exit, on all ranks, and gives their places, in the order of identities.
    fn count_leavers(
        &mut self,
        left: impl Iterator<Item = (usize, usize)>,
    ) -> Result<Vec<Vect<D>>, StepError> {
        let free = &self.world.free;
        let (identity, mass) = (free.get(fields::IDENTITY)?, free.get(fields::MASS)?);
        let position = free.get(fields::POSITION)?;
        let phase = free.get(fields::PHASE).ok();
        let owned = self.world.owned();
        let phases = self.laws.len();
        // Copies of others' particles leave as on their owners, which count them.
        let left = left.filter(|(k, _)| owned.has(*k));
        let leavers = left.map(|(k, exit)| LeavingParticle {
            identity: identity[k],
            count: exit * phases + phase.map_or(0, |p| p[k] as usize),
            position: position[k],
            mass: mass[k],
        });
        let mut leavers = self.world.of_all(leavers.collect())?;
        leavers.sort_unstable_by_key(|leaver| leaver.identity);
        for leaver in &leavers {
            let count = &mut self.world.free.removed[leaver.count];
            count.mass += leaver.mass;
            count.particles += 1;
        }
        Ok(leavers.iter().map(|leaver| leaver.position).collect())
    }

    /// Counts of a resumed run: mass as bits, and particles.
    pub fn recount(&mut self, left: &[[u64; 2]]) {
        for (count, [mass, particles]) in self.world.free.removed.iter_mut().zip(left) {
            (count.mass, count.particles) = (f64::from_bits(*mass), *particles);
        }
    }

    /// Mass that has left, kg.
    pub fn mass_left(&self) -> f64 {
        self.world.free.removed.iter().map(|t| t.mass).sum()
    }

    /// Mass and particles that left, by the labels of the outlets and phases.
    pub fn left(&self) -> impl Iterator<Item = (&String, OutletTotals)> {
        let taken = self.world.free.removed.iter().map(|t| OutletTotals {
            mass: t.mass,
            particles: t.particles,
        });
        self.outlets.labels.iter().zip(taken)
    }
}
