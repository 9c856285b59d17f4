//! Walls of elements with exact γ: mesh, integrals, contacts and means, as treatments share them.

use rayon::prelude::*;
use sph_core::{StepError, Vect, fields};
use sph_neighbours::{ContactBlock, WallSet, World};

use crate::treatment::near::NearLists;
use crate::treatment::outline::Outline;
use crate::treatment::shepard::{WallMean, wall_means};
use crate::treatment::{Staged, stage_error};
use crate::{BoundaryError, Gammas, Result, WallMesh, WallSetup};

/// Walls of elements as both treatments have them: mesh, integrals, contacts.
#[derive(Debug)]
pub(crate) struct SetUp<const D: usize, M: WallMesh<D>> {
    pub outline: Outline<D, M>,
    integrals: M::Integrals,
    near: NearLists<D>,
    /// Version of the near lists, moves and positions for which the contacts were found.
    found_for: ((u64, u64), Vec<Vect<D>>),
    /// The last results, batch by batch; kept for their memory.
    found: Vec<BatchResults<M::Scratch>>,
    /// Least height of the particles of the near lists over the planes of their contacts, m; ∞ for
    /// those on no plane's fluid side.
    clearance: Vec<f64>,
    /// The last state of the fluid at points and elements; kept for its memory.
    means: [Vec<WallMean>; 2],
    around: Vec<u32>,
}

/// Particles that one task works through.
const BATCH: usize = 64;

#[derive(Debug, Default)]
struct BatchResults<R> {
    gammas: Gammas,
    clearance: Vec<f64>,
    room: R,
}

impl<R> BatchResults<R> {
    fn clear(&mut self) {
        self.gammas.clear();
        self.clearance.clear();
    }
}

pub(crate) fn not_built() -> StepError {
    stage_error("the walls were not built")
}

impl<const D: usize, M: WallMesh<D>> SetUp<D, M> {
    /// Positions, normals and movements of points and elements.
    pub fn place(&mut self, walls: &mut WallSet<D>) {
        let bends = self.outline.bends();
        if walls.points.in_density() || bends {
            // All anew: shares follow from the time alone, whatever places a wall has been to.
            for (v, node) in self.outline.mesh.nodes().iter().enumerate() {
                walls.points.share[v] = node.theta * node.size;
            }
        }
        if walls.points.in_density() {
            for (v, share) in self.outline.covered() {
                walls.points.share[v] = share;
            }
        }
        let outline = &self.outline;
        outline.write(walls);
        for (v, node) in outline.mesh.nodes().iter().enumerate() {
            outline.put_point(walls, v, node.wall, node.position.into());
            walls.points.viscous_velocity[v] = walls.points.velocity[v];
        }
        for ((_, own), normal) in walls.points.slip.iter_mut().zip(outline.mesh.normals()) {
            *own = normal;
        }
        for (s, element) in outline.mesh.elements().iter().enumerate() {
            let (centre, movement) = outline.seen(walls, element.wall, element.centre.into());
            let elements = &mut walls.elements;
            elements.centre[s] = centre;
            elements.normal[s] = element.normal.into();
            elements.velocity[s] = movement.velocity;
            if bends {
                elements.measure[s] = element.measure;
            }
            if let Some(acceleration) = elements.acceleration.get_mut(s) {
                *acceleration = movement.acceleration;
            }
            if let Some(turning) = elements.turning.get_mut(s) {
                let corners = outline.mesh.walls().mesh.corners(s).map(Vect::from);
                let at = |corner| outline.movement(element.wall, &corner).velocity;
                *turning = corners.map(|corner| at(corner) - movement.velocity);
            }
        }
    }

    /// True if the contacts were found for these very positions of particles and walls.
    fn is_fresh(&mut self, positions: &[Vect<D>]) -> bool {
        let here = self.near.particles.iter().map(|p| positions[*p as usize]);
        let now = (self.near.version, self.outline.moved);
        let (of, known) = &mut self.found_for;
        let fresh = *of == now && here.clone().eq(known.iter().copied());
        if !fresh {
            *of = now;
            known.clear();
            known.extend(here);
        }
        fresh
    }

    /// Finds γ and contacts of all particles of the near lists, a block per batch; none of those that are `idle`, whose sums
    /// no reader.
    fn find(
        &mut self,
        positions: &[Vect<D>],
        idle: Option<&[bool]>,
        blocks: &mut Vec<ContactBlock<D>>,
    ) {
        let (near, mesh, integrals) = (&self.near, &self.outline.mesh, &self.integrals);
        let batches = near.particles.par_chunks(BATCH);
        self.found.resize_with(batches.len(), BatchResults::default);
        blocks.resize_with(batches.len(), ContactBlock::default);
        let all = self.found.par_iter_mut().zip(blocks).zip(batches);
        all.enumerate().for_each(|(b, ((found, contacts), batch))| {
            found.clear();
            contacts.clear();
            let is_idle = |particle: u32| idle.is_some_and(|idle| idle[particle as usize]);
            // Also an idle one may be hidden from others.
            let elements = |k: usize, particle| match is_idle(particle) && !mesh.shells().any() {
                true => &[],
                false => near.row(b * BATCH + k),
            };
            let all = batch.iter().enumerate();
            let all = all.map(|(k, &p)| (&positions[p as usize], elements(k, p)));
            let BatchResults { gammas, room, .. } = found;
            mesh.gammas(integrals, all, room, contacts, gammas);
            let mut from = 0;
            for (k, ((_, end), particle)) in gammas.all.iter().zip(batch).enumerate() {
                let own = contacts.row(from..*end);
                let heights = own.distances().filter(|d| *d > 0.0);
                let place = &positions[*particle as usize];
                found.clearance.push(match is_idle(*particle) {
                    true => mesh.clearance(place, near.row(b * BATCH + k)),
                    false => heights.fold(f64::INFINITY, f64::min),
                });
                from = *end;
            }
        });
        self.clearance.clear();
        let least = self.found.iter().flat_map(|f| &f.clearance);
        self.clearance.extend(least);
        let behind = &mut self.near.behind;
        behind.clear();
        for (b, found) in self.found.iter().enumerate() {
            let place = |k: u32| (b * BATCH) as u32 + k;
            behind.extend(found.gammas.behind.iter().map(|(k, s)| (place(*k), *s)));
        }
        // A particle in front of them is no contact, and its distance was not measured.
        for (place, _) in behind {
            self.clearance[*place as usize] = 0.0;
        }
    }

    /// Meshes the walls at time 0 by elements of a size, m.
    pub fn build(
        setup: &WallSetup<'_, D>,
        vertices: bool,
        size: f64,
    ) -> Result<(Self, WallSet<D>)> {
        let shape = setup.kernel.polynomial().ok_or_else(|| {
            BoundaryError::kernel(format!(
                "`{}` gives no radial moments, and semi-analytical walls integrate them",
                setup.kernel.name()
            ))
        })?;
        let integrals = M::integrals(shape, setup.smoothing_length)?;
        let support = setup.kernel.support() * setup.smoothing_length;
        let outline = Outline::<D, M>::new(setup, support, size)?;
        let mut walls = WallSet {
            names: outline.mesh.names().to_vec(),
            points: outline.points(),
            elements: outline.elements(),
            at_corners: D == 3 && !setup.walls.iter().any(|wall| wall.open),
            ..WallSet::default()
        };
        if !vertices {
            walls.points.corners = walls.points.position.len();
            walls.points.share.fill(0.0);
        }
        let mut set_up = SetUp {
            outline,
            integrals,
            near: NearLists::default(),
            found_for: Default::default(),
            found: Vec::new(),
            clearance: Vec::new(),
            means: Default::default(),
            around: Vec::new(),
        };
        set_up.place(&mut walls);
        Ok((set_up, walls))
    }

    pub fn geometry(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        self.near.refresh(&mut self.outline, world)?;
        if self.is_fresh(world.free.get(fields::POSITION)?) {
            return Ok(());
        }
        let mut renormalisation = world.free.take(fields::RENORMALISATION)?;
        renormalisation.fill(1.0);
        let positions = world.free.get(fields::POSITION)?;
        // Wall functions and scalars transported to walls read the contacts of every particle, and not in sums.
        let read = !(world.walls.elements.wall_function.is_empty() && world.transported.is_empty());
        let idle = if read { None } else { world.idle() };
        let contacts = &mut world.walls.contacts;
        let mut blocks = contacts.take_blocks(positions.len());
        self.find(positions, idle.as_deref(), &mut blocks);
        contacts.put_blocks(blocks);
        let batches = self.near.particles.chunks(BATCH).zip(&self.found);
        for (b, (batch, found)) in batches.enumerate() {
            let mut start = 0;
            for (&particle, &(gamma, end)) in batch.iter().zip(&found.gammas.all) {
                renormalisation[particle as usize] = gamma;
                if idle.as_ref().is_none_or(|idle| !idle[particle as usize]) {
                    contacts.place(particle, b, start..end);
                }
                start = end;
            }
        }
        // Until the state is found anew, contacts have the last one.
        world.walls.update_contacts();
        world.free.put(fields::RENORMALISATION, renormalisation)?;
        let (near, positions) = (&self.near, world.free.get(fields::POSITION)?);
        let mesh = &self.outline.mesh;
        world.lists.hidden = near.hidden(mesh, world, &near.behind, |k| positions[k]);
        Ok(())
    }

    /// Keeps particles off the walls, by a share of the spacing at least.
    pub fn constrain(&mut self, world: &mut World<D>, dt: f64, least: f64) -> Staged {
        // Heights over the planes of all elements in reach bound the distances from below.
        let clearance = |place: usize| self.clearance.get(place).copied().unwrap_or(0.0);
        let (near, outline) = (&self.near, &self.outline);
        let struck = near.constrain((outline, least), (world, dt), clearance)?;
        near.update_constants(outline, &self.integrals, world, dt)?;
        self.outline.struck = struck;
        Ok(())
    }

    /// Pressures and volumes at points, elements and contacts.
    pub fn state(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let [at_points, at_elements] = &mut self.means;
        let whole = self.outline.spacing.powi(D as i32);
        let (points, elements) = (&world.walls.points, &world.walls.elements);
        let (lists, at_corners) = (&world.lists, world.walls.at_corners);
        let nodes = self.outline.mesh.nodes().len();
        if points.in_density() || at_corners {
            let list = match at_corners {
                true => lists.of_corners(points),
                false => &lists.of_points,
            };
            let list = (list, &lists.hidden.at_points);
            let targets = (&points.position[..nodes], &points.acceleration[..]);
            wall_means(world, targets, list, whole, at_points)?;
        }
        if !at_corners {
            let list = (&lists.of_elements, &lists.hidden.at_elements);
            let targets = (&elements.centre[..], &elements.acceleration[..]);
            wall_means(world, targets, list, whole, at_elements)?;
        }
        let walls = &mut world.walls;
        for (v, mean) in at_points.iter().enumerate() {
            walls.points.pressure[v] = mean.pressure;
            walls.points.volume[v] = mean.volume;
        }
        for (s, mean) in at_elements.iter().enumerate() {
            walls.elements.pressure[s] = mean.pressure;
            walls.elements.volume[s] = mean.volume;
        }
        match at_corners {
            true => walls.average_corners(),
            false if walls.points.corners > 0 => pressure_at_corners(walls, &mut self.around),
            false => {}
        }
        walls.update_contacts();
        Ok(())
    }
}

/// Means over the elements around each corner, for pictures.
fn pressure_at_corners<const D: usize>(walls: &mut WallSet<D>, around: &mut Vec<u32>) {
    let (points, elements) = (&mut walls.points, &walls.elements);
    around.clear();
    around.resize(points.pressure.len(), 0);
    points.pressure[..points.corners].fill(0.0);
    for (corners, pressure) in elements.corners.iter().zip(&elements.pressure) {
        for corner in corners.map(|c| c as usize) {
            around[corner] += 1;
            points.pressure[corner] += pressure;
        }
    }
    let corners = points.corners;
    for (pressure, n) in points.pressure[..corners].iter_mut().zip(around) {
        *pressure /= f64::from((*n).max(1));
    }
}
