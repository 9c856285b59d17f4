//! Densities where particles come to see past a free end, or lose sight of the fluid there.

use sph_core::{StepError, Vect, fields};
use sph_neighbours::{ContactBlock, HiddenPairs, World};

use crate::treatment::near::NearLists;
use crate::treatment::outline::Outline;
use crate::{Gammas, SeenElement, WallMesh};

/// Position of a particle at the end of a drift, seen from the wall near it.
struct DriftEnd<const D: usize> {
    /// Place in the near lists.
    place: u32,
    position: Vect<D>,
    /// Way there, m.
    way: Vect<D>,
}

impl<const D: usize> NearLists<D> {
    /// Changes the constants K of ρ = (K + m Σ w)/γ by the change of γ and of the sums in a drift that is due to walls
    /// hiding less or more: behind a free end water may come into sight, or nothing, and neither is a change of
    /// density.
    ///
    /// ```text
    /// ΔK = ρ (Δγ − ∇γ·Δr) − m (Σ w of particles that come into gauge − Σ w of particles that go out of gauge)
    /// ```
    ///
    /// where ∇γ is that of the elements, the mean over the way. With the walls at rest and no particle near a free end
    /// or behind a wall nothing is asked.
    pub fn update_constants<M: WallMesh<D>>(
        &self,
        outline: &Outline<D, M>,
        integrals: &M::Integrals,
        world: &mut World<D>,
        dt: f64,
    ) -> Result<(), StepError> {
        let some = !(self.rims.is_empty() && self.behind.is_empty());
        if !some || !world.free.has(fields::DENSITY_CONSTANT.name) {
            return Ok(());
        }
        let mut constant = world.free.take(fields::DENSITY_CONSTANT)?;
        let later = self.later(outline, world, dt)?;
        let (mesh, mut found) = (&outline.mesh, Gammas::default());
        let (mut room, mut block) = (M::Scratch::default(), ContactBlock::default());
        let ends = later.iter();
        let rows = ends.map(|l| (&l.position, self.row(l.place as usize)));
        mesh.gammas(integrals, rows, &mut room, &mut block, &mut found);
        let density = world.free.get(fields::DENSITY)?;
        let gamma = world.free.get(fields::RENORMALISATION)?;
        let mut from = 0;
        for (later, &(gamma_there, end)) in later.iter().zip(&found.all) {
            let particle = self.particles[later.place as usize] as usize;
            let here = world.walls.contacts.of_particle(particle).iter();
            let all = here.chain(block.row(from..end).iter());
            let steepness = all.fold(Vect::zeros(), |sum: Vect<D>, c| sum + c.gradient) * 0.5;
            let unveiled = gamma_there - gamma[particle] - steepness.dot(&later.way);
            constant[particle] += density[particle] * unveiled;
            from = end;
        }
        let place = |(k, shell): &(u32, u32)| (later[*k as usize].place, *shell);
        let behind: Vec<(u32, u32)> = found.behind.iter().map(place).collect();
        let positions = world.free.get(fields::POSITION)?;
        let velocity = world.free.get(fields::VELOCITY)?;
        let shift = world.free.get(fields::SHIFT_VELOCITY).ok();
        let at = |k: usize| {
            let own = later.binary_search_by_key(&(k as u32), |l| self.particles[l.place as usize]);
            let moved =
                |u: Vect<D>| positions[k] + (u + shift.map_or(Vect::zeros(), |s| s[k])) * dt;
            own.map_or_else(|_| moved(velocity[k]), |l| later[l].position)
        };
        let there = self.hidden(mesh, world, &behind, at);
        let now = &world.lists.hidden;
        let mass = world.free.get(fields::MASS)?;
        let w = |apart: Vect<D>| {
            let apart = world.domain.nearest_image(apart);
            let mut w = [0.0];
            world.kernel.value(&[apart.norm_squared()], &mut w);
            w[0]
        };
        each_change(&now.particles, &there.particles, |i, j, sign| {
            constant[i] += sign * mass[i] * w(at(i) - at(j));
        });
        let points = &world.walls.points;
        each_change(&now.points, &there.points, |i, v, sign| {
            constant[i] += sign * mass[i] * points.share[v] * w(at(i) - points.position[v]);
        });
        Ok(world.free.put(fields::DENSITY_CONSTANT, constant)?)
    }

    /// Those near a rim and those behind a wall, in the order of the particles.
    fn later<M: WallMesh<D>>(
        &self,
        outline: &Outline<D, M>,
        world: &World<D>,
        dt: f64,
    ) -> Result<Vec<DriftEnd<D>>, StepError> {
        let positions = world.free.get(fields::POSITION)?;
        let velocity = world.free.get(fields::VELOCITY)?;
        let shift = world.free.get(fields::SHIFT_VELOCITY).ok();
        let behind = self.behind.iter().map(|(place, _)| *place);
        // The elements of a row beyond the support depend on its history.
        let near_rim = |place: &u32| {
            let mesh = &outline.mesh;
            let x = &positions[self.particles[*place as usize] as usize];
            let row = self.row(*place as usize).iter();
            let rims = row.filter(|near| mesh.shells().is_rim(near.index()));
            let seen = mesh.seen(x, rims);
            SeenElement::signed_distance(&seen, [0.0; D], outline.support).is_some()
        };
        let rims = self.rims.iter().copied().filter(near_rim);
        let mut places: Vec<u32> = rims.chain(behind).collect();
        places.sort_unstable();
        places.dedup();
        let later = |place: u32| {
            let particle = self.particles[place as usize] as usize;
            let x = &positions[particle];
            let wall = self.row(place as usize).iter().find_map(|near| {
                let mesh = &outline.mesh;
                let shell = mesh.shells().shell_of(near.index());
                (shell > 0).then(|| mesh.wall_of(*near))
            });
            let mut u = velocity[particle];
            u -= wall.map_or(Vect::zeros(), |wall| outline.movement(wall, x).velocity);
            u += shift.map_or(Vect::zeros(), |s| s[particle]);
            DriftEnd {
                place,
                position: x + u * dt,
                way: u * dt,
            }
        };
        Ok(places.into_iter().map(later).collect())
    }
}

/// Calls `of` with all pairs that are in one of the two only: 1 if they lose sight of each other, −1 if they come into sight.
fn each_change(now: &HiddenPairs, there: &HiddenPairs, mut of: impl FnMut(usize, usize, f64)) {
    for (some, others, sign) in [(now, there, -1.0), (there, now, 1.0)] {
        for &[i, j] in some.pairs() {
            if !others.has(i as usize, j) {
                of(i as usize, j as usize, sign);
            }
        }
    }
}
