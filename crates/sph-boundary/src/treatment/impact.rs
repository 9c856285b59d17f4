//! Plastic impact: particles stay in front of walls within a step.

use nalgebra::{Matrix6, Vector6};
use rayon::prelude::*;
use sph_core::{StepError, Vect, fields};
use sph_neighbours::{FreeBody, WallForce, World};

use crate::treatment::near::NearLists;
use crate::treatment::outline::Outline;
use crate::{Hindrance, NearElement, View, WallMesh};

/// A particle is not let nearer to a wall than this share of the spacing.
///
/// The pressure keeps particles of a filled fluid at about half a spacing or more, so that the
/// constraint acts on lone particles only.
pub(crate) const LEAST_CLEARANCE: f64 = 0.25;
/// Rounds over the elements near a particle before a corner simply stops it.
const TURNS: usize = 4;

impl<const D: usize> NearLists<D> {
    /// Removes the part of the velocities that would carry a particle into a wall within `dt`.
    ///
    /// With c the nearest point of an element, e = (r − c)/|r − c| and d = |r − c|: if d + Δt (u − u_w)·e falls below
    /// the `least` share of a spacing, the velocity along e is raised to what ends there, at most to that of the wall.
    /// A plastic impact: the pressure of a lone particle, whose density sum is far below ρ₀, would not stop it. What
    /// several elements ask is met in turns; a particle that a sharp corner still holds then goes with the wall.
    ///
    /// `height` gives a lower bound of the distance of the particle at a place of `particles`
    /// from any element in front of it, m; particles out of danger are skipped.
    ///
    /// Returns the mean forces on the walls over `dt`, by their numbers; none where no reader needs forces.
    pub fn constrain<M: WallMesh<D>>(
        &self,
        (outline, least): (&Outline<D, M>, f64),
        (world, dt): (&mut World<D>, f64),
        height: impl Fn(usize) -> f64 + Sync,
    ) -> Result<Vec<WallForce<D>>, StepError> {
        let mut velocity = world.free.take(fields::VELOCITY)?;
        let position = world.free.get(fields::POSITION)?;
        let walls = &world.walls;
        let moving = walls.points.velocity.iter().chain(&walls.elements.velocity);
        let fastest = moving.map(|u| u.norm_squared()).fold(0.0, f64::max).sqrt();
        let impact = Impact {
            outline,
            spacing: world.spacing,
            least: least * world.spacing,
            fastest,
            dt,
        };
        let mut changed: Vec<(usize, Stopped<D>)> = self
            .particles
            .par_iter()
            .enumerate()
            .with_min_len(256)
            .filter_map(|(place, &p)| {
                let (p, u) = (p as usize, velocity[p as usize]);
                let danger = impact.least + dt * (u.norm() + fastest);
                // Not ">=": a height that is not a number is no safety.
                if height(place) > 1.000_001 * danger {
                    return None;
                }
                let here = (&position[p], self.behind(place));
                let u = impact.stopped(here, u, self.row(place));
                u.map(|u| (p, u))
            })
            .collect();
        let forces = match (0..outline.specs.len()).any(|wall| outline.needs_forces(wall)) {
            true => {
                for body in &world.walls.bodies {
                    give_way(body, world, &mut changed)?;
                }
                blows(outline, world, &changed, dt)?
            }
            false => Vec::new(),
        };
        for (p, corrected) in changed {
            velocity[p] = corrected.velocity;
        }
        world.free.put(fields::VELOCITY, velocity)?;
        Ok(forces)
    }
}

/// Lets a body give way to the particles that it has stopped: all leave the plastic impact with one velocity along e,
/// that of the body after it, (M + Σ m j jᵀ) Δv = −Σ m |Δu| j. As if it were infinitely heavy, a body lighter than its
/// obstacle would be thrown.
fn give_way<const D: usize>(
    body: &FreeBody<D>,
    world: &World<D>,
    changed: &mut [(usize, Stopped<D>)],
) -> Result<(), StepError> {
    let position = world.free.get(fields::POSITION)?;
    let mass = world.free.get(fields::MASS)?;
    let owned = world.owned();
    let along = |p: usize, push: &Vect<D>, image: &Vect<D>| {
        let size = push.norm();
        (body.along(&(position[p] - image), &(push / size)), size)
    };
    let mut parts = Vec::new();
    for (p, corrected) in changed.iter() {
        if !owned.has(*p) {
            continue;
        }
        for (_, push, image) in corrected.pushes.iter().filter(|(wall, ..)| body.is(*wall)) {
            let (j, size) = along(*p, push, image);
            let inertia = j * j.transpose() * mass[*p];
            let mut part = [0.0; 42];
            part[..6].copy_from_slice((j * (mass[*p] * size)).as_slice());
            part[6..].copy_from_slice(inertia.as_slice());
            parts.push(part);
        }
    }
    let sums = world.sums_of(parts.len(), &|k| Some(parts[k]))?;
    let impulse = Vector6::from_column_slice(&sums[..6]);
    if impulse == Vector6::zeros() {
        return Ok(());
    }
    let inertia = Matrix6::from_column_slice(&sums[6..]);
    let factors = (Matrix6::identity() + body.mobility * inertia).lu();
    let change = factors.solve(&(body.mobility * -impulse));
    let change = change.unwrap_or_else(Vector6::zeros);
    for (p, corrected) in changed {
        let own = corrected.pushes.iter_mut();
        for (_, push, image) in own.filter(|(wall, ..)| body.is(*wall)) {
            let (j, size) = along(*p, push, image);
            let given = *push * (j.dot(&change) / size);
            *push += given;
            corrected.velocity += given;
        }
    }
    Ok(())
}

/// Mean forces over `dt` of stopped particles on the walls of movers, summed over the pieces of each wall and over all
/// particles.
fn blows<const D: usize, M: WallMesh<D>>(
    outline: &Outline<D, M>,
    world: &World<D>,
    changed: &[(usize, Stopped<D>)],
    dt: f64,
) -> Result<Vec<WallForce<D>>, StepError> {
    let mass = world.free.get(fields::MASS)?;
    let position = world.free.get(fields::POSITION)?;
    let owned = world.owned();
    let mut each: Vec<Vec<[f64; 6]>> = vec![Vec::new(); outline.specs.len()];
    for (p, corrected) in changed.iter().filter(|(p, _)| owned.has(*p)) {
        for (wall, push, image) in &corrected.pushes {
            let force = push * (-mass[*p] / dt);
            let parts = WallForce::parts(&(position[*p] - image), &force);
            each[outline.groups[*wall]].push(parts);
        }
    }
    let whole = |(wall, blows): (usize, &Vec<[f64; 6]>)| {
        if outline.groups[wall] != wall || !outline.needs_forces(wall) {
            return Ok(WallForce::zero());
        }
        let sums = world.sums_of(blows.len(), &|k| Some(blows[k]))?;
        Ok(WallForce::from_sums(sums))
    };
    each.iter().enumerate().map(whole).collect()
}

/// The velocity of a particle that walls have stopped, and the change by each of them, m/s, with the whole periods to
/// the wall.
struct Stopped<const D: usize> {
    velocity: Vect<D>,
    /// Largest speed after any of the changes, m/s.
    fastest: f64,
    pushes: Vec<(usize, Vect<D>, Vect<D>)>,
}

struct Impact<'a, const D: usize, M: WallMesh<D>> {
    outline: &'a Outline<D, M>,
    spacing: f64,
    /// Distance from a wall to which a particle may come, m.
    least: f64,
    fastest: f64,
    dt: f64,
}

impl<const D: usize, M: WallMesh<D>> Impact<'_, D, M> {
    /// The velocity that no element objects to; none if that is the present one.
    ///
    /// Up to a speed v, only places within the least distance + Δt v hinder. Walls at rest make no particle faster; where
    /// moving ones do, farther places are searched as well.
    fn stopped(&self, here: View<'_, D>, u: Vect<D>, row: &[NearElement<D>]) -> Option<Stopped<D>> {
        let all = 4.0 * self.spacing;
        let speed = 1.000_001 * (u.norm() + self.fastest);
        let reach = self.least + self.dt * speed;
        match self.corrected(here, u, row, reach.min(all)) {
            Some(stopped) if reach < all && stopped.fastest > speed => {
                self.corrected(here, u, row, all)
            }
            other => other,
        }
    }

    fn corrected(
        &self,
        here: View<'_, D>,
        u: Vect<D>,
        row: &[NearElement<D>],
        reach: f64,
    ) -> Option<Stopped<D>> {
        let mesh = &self.outline.mesh;
        let mut hindrances = mesh.hindrances(here, row, reach);
        hindrances.retain(|h| !self.outline.specs[h.wall].open);
        if hindrances.is_empty() {
            return None;
        }
        let walls: Vec<Vect<D>> = hindrances.iter().map(|h| self.wall_velocity(h)).collect();
        let mut new = Stopped {
            velocity: u,
            fastest: 0.0,
            pushes: Vec::new(),
        };
        for turn in 0..=TURNS {
            let mut held = None;
            for (hindrance, wall) in hindrances.iter().zip(&walls) {
                if let Some(push) = self.push(&new.velocity, hindrance, wall) {
                    new.velocity += push;
                    new.fastest = new.fastest.max(new.velocity.norm());
                    new.pushes.push((hindrance.wall, push, hindrance.image));
                    held = Some((hindrance, *wall));
                }
            }
            match held {
                None => return (turn > 0).then_some(new),
                Some((by, velocity)) if turn == TURNS => {
                    let push = velocity - new.velocity;
                    new.pushes.push((by.wall, push, by.image));
                    new.velocity = velocity;
                    return Some(new);
                }
                Some(_) => {}
            }
        }
        None
    }

    fn wall_velocity(&self, hindrance: &Hindrance<D>) -> Vect<D> {
        let wall = hindrance.wall;
        let place = hindrance.place - hindrance.image;
        let movement = self.outline.movement(wall, &place);
        // Its mean over the step: where a wall turns, a point with its velocity leaves it by ½ a Δt².
        movement.velocity + movement.acceleration * (0.5 * self.dt)
    }

    fn push(&self, u: &Vect<D>, hindrance: &Hindrance<D>, wall: &Vect<D>) -> Option<Vect<D>> {
        let least = self.least;
        // The deficit of the velocity along e for an end at the least clearance.
        let missing = |e: &Vect<D>, distance: f64| {
            let allowed = ((least - distance) / self.dt).min(0.0);
            let missing = allowed - (u - wall).dot(e);
            // Rounding of an earlier correction is no impact.
            (missing > 1e-12 * (u - wall).norm()).then_some(missing)
        };
        if let Some((e, distance)) = &hindrance.only_if {
            missing(e, *distance)?;
        }
        let m = missing(&hindrance.away, hindrance.distance)?;
        Some(hindrance.away * m)
    }
}
