//! Particles that leave the flow.

use rayon::prelude::*;
use sph_contribution::even_out;
use sph_core::{StepError, Taken, Vect, fields};
use sph_scene::Scene;

use crate::Flow;
use crate::step::outlets::Left;
use crate::step::stages::lock;

impl<const D: usize> Flow<D> {
    /// Takes out the particles that are in an outlet or have passed an open face at the end of a step of `dt` seconds, and
    /// counts them in their order.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn let_out(&mut self, dt: f64) -> Result<(), StepError> {
        // First those who look at wall contacts, which are by slots.
        self.by_gates(dt)?;
        self.by_outlets(dt)
    }

    /// Counts the exits of all gates behind the outlets, and behind these the border of the domain where walls end freely.
    pub fn know_exits(&mut self, scene: &Scene) {
        let mut taken = self.world.free.taken().to_vec();
        let exits = self.gates.iter().flat_map(|gate| gate.exits());
        for (exit, name) in (self.outlets.all.len() as u32..).zip(exits) {
            for (phase, of) in scene.phase.keys().enumerate() {
                self.outlets.labels.push(format!("open.{name}.{of}"));
                taken.push(Taken {
                    outlet: exit,
                    phase: phase as u32,
                    ..Taken::default()
                });
            }
        }
        self.outlets.named = self.outlets.labels.len();
        if self.walls.as_ref().is_some_and(|w| lock(w).ends_freely()) {
            let phases = scene.phase.len().max(1);
            let border = self.outlets.named / phases;
            self.outlets.border = Some(border);
            for (phase, of) in scene.phase.keys().enumerate() {
                self.outlets.labels.push(format!("domain.{of}"));
                taken.push(Taken {
                    outlet: border as u32,
                    phase: phase as u32,
                    ..Taken::default()
                });
            }
        }
        self.world.free.set_taken(taken);
    }

    /// Takes out whom gates let out, and counts them.
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
        let leavers = gone.iter().map(|(p, exit)| (*p as usize, first + exit));
        self.count_leavers(leavers)?;
        if !gone.is_empty() {
            let free = &mut self.world.free;
            let mut leaves = vec![false; free.len()];
            gone.iter().for_each(|(p, _)| leaves[*p as usize] = true);
            free.take_out(&leaves);
        }
        Ok(())
    }

    /// Takes out who is in an outlet.
    fn by_outlets(&mut self, dt: f64) -> Result<(), StepError> {
        let (all, border) = (&self.outlets.all, self.outlets.border);
        if all.is_empty() && border.is_none() {
            return Ok(());
        }
        let free = &self.world.free;
        let (position, velocity) = (free.get(fields::POSITION)?, free.get(fields::VELOCITY)?);
        let phase = free.get(fields::PHASE).ok();
        // What flies as fast as sound was not spilled: it ends the run.
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
        let left: Vec<Option<usize>> = match some {
            true => places().collect(),
            false => Vec::new(),
        };
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

    /// Counts who leaves by which exit, on all ranks, and gives their places, in the order of identities.
    fn count_leavers(
        &mut self,
        left: impl Iterator<Item = (usize, usize)>,
    ) -> Result<Vec<Vect<D>>, StepError> {
        let free = &self.world.free;
        let (identity, mass) = (free.get(fields::IDENTITY)?, free.get(fields::MASS)?);
        let position = free.get(fields::POSITION)?;
        let phase = free.get(fields::PHASE).ok();
        let own = self.world.team.as_ref().map(|team| team.own(free));
        let phases = self.laws.len();
        // Copies of others' particles leave as their owners do, who count them.
        let counts = |k: usize| own.as_ref().is_none_or(|own| own[k]);
        let left = left.filter(|(k, _)| counts(*k));
        let leavers = left.flat_map(|(k, exit)| {
            let place = exit * phases + phase.map_or(0, |p| p[k] as usize);
            let numbers = position[k].iter().chain([&mass[k]]).map(|x| x.to_bits());
            [u64::from(identity[k]), place as u64]
                .into_iter()
                .chain(numbers)
        });
        let mut leavers: Vec<u64> = leavers.collect();
        if let Some(team) = &self.world.team {
            leavers = team.gather(&leavers)?;
        }
        let mut leavers: Vec<&[u64]> = leavers.chunks_exact(D + 3).collect();
        leavers.sort_unstable();
        let mut taken = self.world.free.taken().to_vec();
        for leaver in &leavers {
            let count = &mut taken[leaver[1] as usize];
            count.mass += f64::from_bits(leaver[D + 2]);
            count.particles += 1;
        }
        self.world.free.set_taken(taken);
        let place = |leaver: &&[u64]| Vect::from_fn(|k, _| f64::from_bits(leaver[2 + k]));
        Ok(leavers.iter().map(place).collect())
    }

    /// What a resumed run has counted: mass as bits, and particles.
    pub fn recount(&mut self, left: &[[u64; 2]]) {
        let mut taken = self.world.free.taken().to_vec();
        for (count, [mass, particles]) in taken.iter_mut().zip(left) {
            (count.mass, count.particles) = (f64::from_bits(*mass), *particles);
        }
        self.world.free.set_taken(taken);
    }

    /// Mass that has left, kg.
    pub fn mass_left(&self) -> f64 {
        self.world.free.taken().iter().map(|t| t.mass).sum()
    }

    /// What has left, by the labels of the outlets and phases.
    pub fn left(&self) -> impl Iterator<Item = (&String, Left)> {
        let taken = self.world.free.taken().iter().map(|t| Left {
            mass: t.mass,
            particles: t.particles,
        });
        self.outlets.labels.iter().zip(taken)
    }
}
