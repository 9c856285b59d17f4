//! Elements that may be near each particle, kept until particle and walls have moved, and the pairs that they hide.

use rayon::prelude::*;
use sph_core::{Slots, StepError, Vect, fields};
use sph_neighbours::{Hidden, HiddenPairs, World};

use crate::treatment::outline::Outline;
use crate::treatment::stage_error;
use crate::{NearElement, NearRows, WallMesh};

/// Range of the search for elements beyond that of the neighbour lists, over the support: a row stands until particle
/// and walls have come this much nearer, while the lists come and go.
///
/// Longer rows cost every γ, which has to leave out elements beyond the support; shorter ones are looked for more
/// often.
const SKIN: f64 = 0.3;
/// Particles whose elements one task looks for.
const BATCH: usize = 256;

/// Elements that may be within the support of a particle until the neighbour lists are rebuilt.
///
/// Each particle has a row of its own, found for the place where it was then: after every build of the lists only those
/// that moved farther than the skin since are looked up anew. The elements of a row beyond the support depend on this
/// history, and no result does.
#[derive(Debug, Default)]
pub(crate) struct NearLists<const D: usize> {
    built_for: u64,
    pub version: u64,
    /// Particles with an element near, ascending.
    pub particles: Vec<u32>,
    /// Places of `particles` that may see a free end, ascending.
    pub rims: Vec<u32>,
    /// Places of `particles`, ascending, and the shells that they are behind at the present positions.
    pub behind: Vec<(u32, u32)>,
    rows: Vec<Row<D>>,
    identities: Vec<u32>,
    elements: Vec<NearElement<D>>,
    /// Largest travel of a wall, m: the sum over all builds.
    travelled: f64,
    /// Places of the nodes at the last build, m; empty where no wall ever moves.
    nodes: Vec<Vect<D>>,
    room: Scratch<D>,
}

#[derive(Debug, Default)]
struct Scratch<const D: usize> {
    sorted: Vec<Row<D>>,
    stale: Vec<u32>,
    found: Vec<TaskResults<D>>,
}

#[derive(Debug, Default)]
struct TaskResults<const D: usize> {
    places: Vec<Vect<D>>,
    rows: NearRows<D>,
}

/// Elements of a particle, and its position when they were found.
#[derive(Clone, Copy, Debug)]
struct Row<const D: usize> {
    place: Vect<D>,
    /// [`NearLists::travelled`] then, m.
    travelled: f64,
    from: u32,
    count: u32,
}

impl<const D: usize> Row<D> {
    fn none() -> Self {
        Row {
            place: Vect::repeat(f64::NAN),
            travelled: 0.0,
            from: 0,
            count: 0,
        }
    }

    /// True if particle and walls may have come nearer by more than `skin` since it was found.
    fn is_stale(&self, place: &Vect<D>, travelled: f64, skin: f64) -> bool {
        let moved = (place - self.place).norm() + (travelled - self.travelled);
        moved.is_nan() || moved > skin
    }
}

impl<const D: usize> NearLists<D> {
    /// Finds the elements that are missing in the lists built since, for particles and walls where the neighbour lists
    /// found them: rows stand as long as these, wherever the walls move meanwhile.
    pub fn refresh<M: WallMesh<D>>(
        &mut self,
        outline: &mut Outline<D, M>,
        world: &World<D>,
    ) -> Result<(), StepError> {
        if self.built_for == world.lists.builds {
            return Ok(());
        }
        self.built_for = world.lists.builds;
        self.version += 1;
        let radius = world.reach() + SKIN * outline.support;
        let radius = radius.min(outline.mesh.walls().reach);
        let skin = (radius - world.reach()).max(0.0);
        let positions = &world.lists.reference;
        let identities = world.free.get(fields::IDENTITY).ok();
        let moves = outline.moves();
        // Places are of these lists.
        self.behind.clear();
        let search = |mesh: &M| {
            if moves {
                self.travel(mesh.places());
            }
            self.follow(identities, positions.len());
            self.search(mesh, positions, radius, skin);
            self.find_rims(mesh);
        };
        let searched = outline.at_lists(world.lists.time, search);
        searched.map_err(stage_error)
    }

    fn find_rims<M: WallMesh<D>>(&mut self, mesh: &M) {
        // Its memory is used again: no build of the lists allocates.
        let mut rims = std::mem::take(&mut self.rims);
        rims.clear();
        if mesh.shells().any() {
            let at_rim = |near: &NearElement<D>| mesh.shells().is_rim(near.index());
            let sees = |place: &u32| self.row(*place as usize).iter().any(at_rim);
            rims.extend((0..self.particles.len() as u32).filter(sees));
        }
        self.rims = rims;
    }

    /// Adds how far the nodes have moved since the last build.
    fn travel(&mut self, nodes: Vec<Vect<D>>) {
        let steps = nodes.iter().zip(&self.nodes);
        let farthest = steps.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        self.travelled += farthest;
        self.nodes = nodes;
    }

    /// Gives every particle the row that it had, wherever it was sorted to; those that were not there before have none.
    fn follow(&mut self, identities: Option<&[u32]>, particles: usize) {
        let Some(identities) = identities else {
            self.rows.clear();
            self.rows.resize(particles, Row::none());
            return;
        };
        if *identities == self.identities[..] {
            return;
        }
        let slots = Slots::from_identities(&self.identities);
        let row = |&id: &u32| {
            let slot = slots.slot(id);
            slot.map_or(Row::none(), |slot| self.rows[slot as usize])
        };
        let sorted = identities.par_iter().with_min_len(1024).map(row);
        sorted.collect_into_vec(&mut self.room.sorted);
        std::mem::swap(&mut self.rows, &mut self.room.sorted);
        self.identities.clear();
        self.identities.extend_from_slice(identities);
    }

    fn search<M: WallMesh<D>>(&mut self, mesh: &M, positions: &[Vect<D>], radius: f64, skin: f64) {
        let travelled = self.travelled;
        let mut room = std::mem::take(&mut self.room);
        room.stale.clear();
        for (i, (row, x)) in self.rows.iter_mut().zip(positions).enumerate() {
            if row.is_stale(x, travelled, skin) {
                row.count = 0;
                room.stale.push(i as u32);
            }
        }
        let batches = room.stale.par_chunks(BATCH);
        let tasks = batches.len();
        room.found
            .resize_with(tasks.max(room.found.len()), TaskResults::default);
        let found = &mut room.found[..tasks];
        batches.zip(&mut *found).for_each(|(batch, found)| {
            found.places.clear();
            let places = batch.iter().map(|&i| positions[i as usize]);
            found.places.extend(places);
            found.rows.counts.clear();
            found.rows.elements.clear();
            mesh.near_all(&found.places, radius, &mut found.rows);
            // Elements at free ends are looked at one by one.
            if !mesh.shells().any() {
                mesh.merge(&mut found.rows);
            }
        });
        let more = found.iter().map(|found| found.rows.elements.len()).sum();
        self.make_room(more);
        // A search for most particles comes once: its memory is not kept, and given back on the way.
        let most = 2 * room.stale.len() > self.rows.len();
        if most {
            self.elements.reserve_exact(more);
        }
        let mut from = self.elements.len() as u32;
        for (batch, found) in room.stale.chunks(BATCH).zip(&mut *found) {
            let rows = &mut found.rows;
            self.elements.extend_from_slice(&rows.elements);
            if most {
                rows.elements = Vec::new();
            }
            for (&i, &count) in batch.iter().zip(&rows.counts) {
                self.rows[i as usize] = Row {
                    place: positions[i as usize],
                    travelled,
                    from,
                    count,
                };
                from += count;
            }
        }
        if most {
            room.found = Vec::new();
        }
        self.room = room;
        self.particles.clear();
        let rows = self.rows.iter().zip(0u32..);
        let near = rows.filter(|(row, _)| row.count > 0);
        self.particles.extend(near.map(|(_, i)| i));
    }

    /// Discards elements that no row holds, where they are more than those in rows.
    fn make_room(&mut self, more: usize) {
        let held: usize = self.rows.iter().map(|row| row.count as usize).sum();
        if self.elements.len() <= 2 * held {
            return;
        }
        let mut kept = Vec::with_capacity(held + more);
        for row in &mut self.rows {
            let from = row.from as usize;
            row.from = kept.len() as u32;
            kept.extend_from_slice(&self.elements[from..from + row.count as usize]);
        }
        self.elements = kept;
    }

    /// The elements near the particle at a place of `particles`.
    pub fn row(&self, place: usize) -> &[NearElement<D>] {
        let row = &self.rows[self.particles[place] as usize];
        &self.elements[row.from as usize..(row.from + row.count) as usize]
    }

    /// Pairs with a shell between them, where particles are `at`: those that are `behind` it and all that the way to them leads
    /// through it, its elements and its points.
    pub fn hidden<M: WallMesh<D>>(
        &self,
        mesh: &M,
        world: &World<D>,
        behind: &[(u32, u32)],
        at: impl Fn(usize) -> Vect<D>,
    ) -> Hidden {
        let support2 = world.kernel.support_radius().powi(2);
        let [mut particles, mut points, mut at_points, mut at_elements] = [const { Vec::new() }; 4];
        for &(place, shell) in behind {
            let particle = self.particles[place as usize];
            let x = &at(particle as usize);
            let row = self.row(place as usize).iter();
            let own = row.filter(|near| mesh.shells().shell_of(near.index()) == shell);
            for other in self.around(world, particle) {
                let way: Vect<D> = world.domain.nearest_image(at(other as usize) - x);
                let near = other != particle && way.norm_squared() < support2;
                if near && own.clone().any(|near| mesh.is_crossed(*near, x, &way)) {
                    particles.extend([[particle, other], [other, particle]]);
                }
            }
            for near in own {
                let element = near.index();
                at_elements.push([element as u32, particle]);
                let in_density = world.walls.points.in_density();
                if in_density || world.walls.at_corners {
                    for corner in world.walls.elements.corners[element] {
                        at_points.push([corner, particle]);
                        if in_density {
                            points.push([particle, corner]);
                        }
                    }
                }
            }
        }
        Hidden {
            particles: HiddenPairs::from_pairs(particles),
            points: HiddenPairs::from_pairs(points),
            at_points: HiddenPairs::from_pairs(at_points),
            at_elements: HiddenPairs::from_pairs(at_elements),
        }
    }

    /// Neighbours that a particle may have within its support; all where no sum of it is needed.
    fn around<'a>(&self, world: &'a World<D>, particle: u32) -> impl Iterator<Item = u32> + 'a {
        let listed = world.lists.free.candidates(particle as usize);
        let all = match listed.is_empty() {
            true => 0..world.free.len() as u32,
            false => 0..0,
        };
        listed.iter().copied().chain(all)
    }

    /// The shells that the particle at a place of `particles` is behind.
    pub fn behind(&self, place: usize) -> &[(u32, u32)] {
        let from = self.behind.partition_point(|(p, _)| (*p as usize) < place);
        let row = &self.behind[from..];
        &row[..row.partition_point(|(p, _)| *p as usize == place)]
    }
}
