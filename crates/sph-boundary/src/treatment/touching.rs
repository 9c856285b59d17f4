//! Walls that meet: a penalty on the distance between their surfaces, in as many parts of a step as it needs.

use std::collections::BTreeMap;

use sph_core::Vect;
use sph_neighbours::{WallForce, cross};

use crate::treatment::contact::{DEPTH, SurfacePair, ordered};
use crate::treatment::outline::Outline;
use crate::{BoundaryError, Load, Result, RigidState, Touch, WallMesh};

/// Both surfaces of a pair are looked at from the other.
const SHARE: f64 = 0.5;
/// Parts per radian of the fastest swing of a body on its contacts: an impact is then right to (1/10)²/8 of its energy.
const PARTS: f64 = 10.0;
const MOST_PARTS: f64 = 20_000.0;
/// Depth to which the weight of all bodies together presses a face into the gap, over the spacing.
const SINKS: f64 = 0.025;
/// Share of the stiffness of the stiffest body that all contacts have, for its effect on a light one in its way: it
/// stops a fortieth of the speed that the body's own contacts stop.
const OF_STIFFEST: f64 = 1.0 / 1600.0;

impl Touch {
    /// The law of two walls, one of which may be fixed, with at least `least` N/m on the smaller face.
    fn between(pair: [Option<Touch>; 2], least: f64) -> Self {
        let both = |a: Touch, b: Touch| Touch {
            mass: a.mass * b.mass / (a.mass + b.mass),
            face: a.face.min(b.face),
            stiffness: a.stiffness.min(b.stiffness),
            restitution: a.restitution.min(b.restitution),
            friction: (a.friction * b.friction).sqrt(),
            ..a
        };
        let stiff = |law: Touch| Touch {
            stiffness: law.stiffness.max(least / law.face),
            ..law
        };
        let law = pair.into_iter().flatten().reduce(both);
        law.map(stiff).unwrap_or_default()
    }

    /// The force on the first of a pair, N, from an area that is one of `all` at which the pair touches; `missing` m of
    /// the gap, at a velocity against the second.
    fn force<const D: usize>(
        &self,
        away: &Vect<D>,
        missing: f64,
        velocity: &Vect<D>,
        [area, all]: [f64; 2],
    ) -> Vect<D> {
        let critical = 2.0 * (self.stiffness * self.mass / all).sqrt();
        let parting = velocity.dot(away);
        let left = match parting > 0.0 {
            true => self.restitution * self.restitution,
            false => 1.0,
        };
        let push = area * left * self.stiffness * missing;
        let along = velocity - away * parting;
        let speed = along.norm();
        if speed == 0.0 {
            return away * push;
        }
        let rub = (self.friction * push).min(critical * area * speed);
        away * push - along * (rub / speed)
    }
}

pub(crate) struct Touching<const D: usize> {
    near: Vec<SurfacePair<D>>,
    /// Of the pairs, and the number of that of each piece.
    laws: Vec<Touch>,
    law_of: Vec<usize>,
    /// Distances at which the pairs begin to push, m.
    gaps: Vec<f64>,
    /// ω² of the fastest swing at most, 1/s².
    swing: f64,
}

impl<const D: usize> Touching<D> {
    /// In how many parts a step is taken; contacts get softer where that were too many.
    fn parts(&mut self, dt: f64) -> u32 {
        let parts = (PARTS * self.swing.sqrt() * dt).ceil().max(1.0);
        if parts > MOST_PARTS {
            let softer = (MOST_PARTS / parts).powi(2);
            self.laws.iter_mut().for_each(|l| l.stiffness *= softer);
        }
        parts.min(MOST_PARTS) as u32
    }

    /// Forces between the walls, by the first of the walls that move together; `velocity` is that of the first of
    /// a pair against the second.
    fn forces(&self, velocity: &[Vect<D>], forces: &mut [WallForce<D>]) {
        forces.fill(WallForce::zero());
        let missing = |n: usize| self.gaps[self.law_of[n]] - self.near[n].height;
        let mut areas = vec![0.0; self.laws.len()];
        for (n, near) in self.near.iter().enumerate() {
            if missing(n) > 0.0 {
                areas[self.law_of[n]] += SHARE * near.area;
            }
        }
        for (n, near) in self.near.iter().enumerate() {
            let (law, missing) = (self.law_of[n], missing(n));
            if missing <= 0.0 {
                continue;
            }
            let area = [SHARE * near.area, areas[law]];
            let force = self.laws[law].force(&near.away, missing, &velocity[n], area);
            let places = [near.place, near.place - near.image];
            for ((k, force), place) in near.pair.into_iter().zip([force, -force]).zip(places) {
                forces[k].add(&WallForce {
                    force,
                    moment: cross(&place, &force),
                    ..WallForce::zero()
                });
            }
        }
    }
}

impl<const D: usize, M: WallMesh<D>> Outline<D, M> {
    fn touching(&self, gravity: Vect<D>, dt: f64) -> Option<Touching<D>> {
        let touches = self.touches();
        if touches.iter().all(Option::is_none) {
            return None;
        }
        let mut near = self.near_pairs(&touches);
        let velocities = self.closing(&self.now.states, &near);
        let mut velocity = velocities.iter();
        // Twice the way of the present velocity, and a tenth of the spacing for accelerations.
        near.retain(|n| {
            let parting = velocity.next().map_or(0.0, |v| v.dot(&n.away));
            n.height + 2.0 * dt * parting.min(0.0) - 0.1 * self.spacing < self.gap(n.pair)
        });
        if near.is_empty() {
            return None;
        }
        let heads = (0..touches.len()).filter(|k| self.groups[*k] == *k);
        let bodies: Vec<Touch> = heads.filter_map(|k| touches[k]).collect();
        let weight = bodies.iter().map(|t| t.mass).sum::<f64>() * gravity.norm();
        let stiffest = bodies.iter().map(|t| t.stiffness * t.face);
        let stiffest = stiffest.fold(0.0, f64::max);
        let least = (weight / (SINKS * self.spacing)).max(OF_STIFFEST * stiffest);
        let mut pairs = BTreeMap::<[usize; 2], usize>::new();
        let (mut laws, mut gaps) = (Vec::new(), Vec::new());
        let number = |n: &SurfacePair<D>| {
            *pairs.entry(ordered(n.pair)).or_insert_with(|| {
                gaps.push(self.gap(n.pair));
                laws.push(Touch::between(n.pair.map(|k| touches[k]), least));
                laws.len() - 1
            })
        };
        let law_of: Vec<usize> = near.iter().map(number).collect();
        let mut swings = vec![0.0; self.specs.len()];
        for (n, law) in near.iter().zip(&law_of) {
            let stiffness = SHARE * n.area * laws[*law].stiffness;
            for (k, image) in n.pair.into_iter().zip([Vect::zeros(), n.image]) {
                let Some(touch) = touches[k] else { continue };
                let arm = n.place - image - self.now.states[k].place();
                // (a − b)² ≤ 2 a² + 2 b².
                let inverse = 1.0 / touch.mass + arm.norm_squared() / touch.inertia;
                swings[k] += 2.0 * stiffness * inverse;
            }
        }
        Some(Touching {
            near,
            laws,
            law_of,
            gaps,
            swing: swings.into_iter().fold(0.0, f64::max),
        })
    }

    /// Velocities of the first of each pair against the second, m/s.
    fn closing(&self, states: &[RigidState<D>], near: &[SurfacePair<D>]) -> Vec<Vect<D>> {
        let one = |n: &SurfacePair<D>| {
            let of = |k: usize, x: Vect<D>| self.movement_in(&states[k], k, &x).velocity;
            of(n.walls[0], n.place) - of(n.walls[1], n.place - n.image)
        };
        near.iter().map(one).collect()
    }

    /// The states after a step with these loads, without contact; contacts are added to the loads.
    ///
    /// # Errors
    /// A wall whose state is no number; walls that go through each other.
    pub(crate) fn free_states(
        &self,
        loads: &mut [Load<D>],
        gravity: Vect<D>,
        [time, dt]: [f64; 2],
    ) -> Result<Vec<RigidState<D>>> {
        let Some(mut touching) = self.touching(gravity, dt) else {
            return self.after(&self.now.states, loads, [time, dt]);
        };
        let parts = touching.parts(dt);
        let part = dt / f64::from(parts);
        let [mut forces, mut sums] = [(); 2].map(|()| vec![WallForce::zero(); loads.len()]);
        let heights: Vec<f64> = touching.near.iter().map(|n| n.height).collect();
        let mut states = self.now.states.clone();
        let mut velocity = self.closing(&states, &touching.near);
        for n in 0..parts {
            touching.forces(&velocity, &mut forces);
            for ((load, force), sum) in loads.iter_mut().zip(&forces).zip(&mut sums) {
                (load.contact_force, load.contact_moment) = (force.force, force.moment);
                sum.add(force);
            }
            states = self.after(&states, loads, [time + part * f64::from(n), part])?;
            velocity = self.closing(&states, &touching.near);
            for (near, velocity) in touching.near.iter_mut().zip(&velocity) {
                near.go(&(velocity * part));
            }
        }
        for (near, before) in touching.near.iter().zip(heights) {
            if near.height < before.min(-0.5 * DEPTH * self.spacing) {
                let [wall, other] = near.walls.map(|k| self.name(k));
                let why = format!(
                    "goes through wall `{other}`: it is too fast or too heavy for a contact as stiff as the speed of sound \
                     allows; raise `speed_of_sound`"
                );
                return Err(BoundaryError::unfit(wall, why));
            }
        }
        // The acceleration in the pressure at the walls is that of one step with the mean of the contacts.
        for (load, sum) in loads.iter_mut().zip(&sums) {
            let mean = 1.0 / f64::from(parts);
            load.contact_force = sum.force * mean;
            load.contact_moment = sum.moment.map(|m| m * mean);
        }
        let mut whole = self.after(&self.now.states, loads, [time, dt])?;
        for (k, state) in whole.iter_mut().enumerate() {
            if self.specs[k].mover.is_some() {
                state.pose = states[k].pose;
                state.velocity = states[k].velocity;
                state.angular_velocity = states[k].angular_velocity;
            }
        }
        Ok(whole)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By small steps: the share that is left is the given one, also of a body far heavier than that
    /// whose contact it is.
    #[test]
    fn an_impact_leaves_the_share_that_was_asked_for() {
        for (restitution, mass) in [(1.0, 1.0), (0.5, 1.0), (0.2, 1e4), (0.0, 1e4)] {
            let touch = Touch {
                mass: 1.0,
                face: 1.0,
                stiffness: 1.0,
                restitution,
                ..Touch::default()
            };
            let law = Touch::between([Some(touch), None], 0.0);
            let (mut x, mut v, dt) = (0.0, Vect::<2>::new(-1.0, 0.0), 1e-3 * f64::sqrt(mass));
            for _ in 0..10_000 {
                if x < 0.0 {
                    v += law.force(&Vect::<2>::x(), -x, &v, [1.0, 1.0]) * (dt / mass);
                }
                x += dt * v[0];
            }
            assert!((v[0] - restitution).abs() < 2e-3, "{restitution}: {v}");
        }
    }
}
