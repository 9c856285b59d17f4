//! What every particle exerts on which wall.

use std::ops::Range;

use rayon::prelude::*;
use sph_core::{StepError, Vect, fields};

use crate::packed::{Packed, pack};
use crate::sweep::{Room, Sweep};
use crate::term::Rates;
use crate::{
    CHUNK, Cluster, ContactBlock, ContactRow, Interaction, Row, RowTerm, Scratch, There, Walled,
    World,
};

/// What a particle exerts on a wall.
#[derive(Clone, Copy, Debug)]
pub struct WallPart<const D: usize> {
    /// The particle.
    pub particle: u32,
    /// The wall.
    pub wall: u32,
    /// Force, N (N/m in two dimensions).
    pub force: Vect<D>,
}

/// What the wanted particles exert on the walls that they see, by particle and wall: the parts of
/// [`wall_forces`](crate::wall_forces).
///
/// # Errors
/// If a term misses a column.
pub fn wall_parts<const D: usize>(
    world: &World<D>,
    terms: &[&dyn Interaction<D>],
    wanted: impl Fn(usize) -> bool + Sync,
) -> Result<Vec<WallPart<D>>, StepError> {
    let bound = terms.iter().map(|t| t.bind(world));
    let bound = bound.collect::<Result<Vec<_>, _>>()?;
    let mut states: Vec<There<D>> = Vec::new();
    pack(world, &mut states, Packed::of(terms.iter().copied()))?;
    let sweep = Sweep::new(world, &states, &*world.kernel)?;
    let mass = world.free.get(fields::MASS)?;
    let contacts = &world.walls.contacts;
    // Asked once for everybody: clusters ask again and again.
    let mut asked = vec![false; sweep.particles()];
    let mut ask = |i: usize| asked[i] = wanted(i);
    match world.walls.points.in_sums() && !world.lists.wall.is_empty() {
        true => (0..sweep.particles())
            .filter(|i| !contacts.of(*i).is_empty() || !world.lists.wall.row(*i).is_empty())
            .for_each(&mut ask),
        false => contacts.particles.iter().for_each(|i| ask(*i as usize)),
    }
    let wanted = |i: usize| asked[i];
    let blocks = (0..sweep.particles().div_ceil(CHUNK)).into_par_iter();
    let shelf = || (world.lists.shelf.lend::<Room<D>>(), Apart::default());
    let parts = blocks.map_init(shelf, |(room, apart), block| {
        let mut parts = Vec::new();
        sweep.each_wanted(block, wanted, &mut room.0, |cluster| {
            apart.take(world, cluster, wanted);
            apart.sum(cluster, &bound);
            apart.leave(mass, &mut parts);
        });
        parts
    });
    Ok(parts.collect::<Vec<_>>().concat())
}

/// The walls before the members of a cluster, one by one.
struct Apart<const D: usize> {
    near: Vec<Near<D>>,
    pieces: Vec<Piece<D>>,
    /// What all terms make of every member with every choice of walls.
    rates: Vec<Rates<D>>,
    walls: Vec<u32>,
}

/// A member of a cluster that sees walls.
struct Near<const D: usize> {
    member: usize,
    particle: usize,
    points: Scratch<D>,
    /// Its walls among the pieces.
    pieces: Range<usize>,
}

/// What a member sees of one wall; of the only one that it sees there is no copy.
struct Piece<const D: usize> {
    wall: u32,
    points: Scratch<D>,
    contacts: ContactBlock<D>,
    /// Its share in what 1/γ adds.
    share: f64,
}

impl<const D: usize> Default for Apart<D> {
    fn default() -> Self {
        Apart {
            near: Vec::new(),
            pieces: Vec::new(),
            rates: Vec::new(),
            walls: Vec::new(),
        }
    }
}

fn all<const D: usize>(contacts: &ContactBlock<D>) -> ContactRow<'_, D> {
    contacts.row(0..contacts.planes())
}

/// Σ |∇γ_as|, 1/m.
fn size<const D: usize>(contacts: ContactRow<'_, D>) -> f64 {
    contacts.iter().map(|c| c.gradient.norm()).sum()
}

impl<const D: usize> Apart<D> {
    /// Looks at the walls of the wanted members of a cluster.
    fn take(&mut self, world: &World<D>, cluster: &Cluster<'_, D>, wanted: impl Fn(usize) -> bool) {
        let set = &world.walls;
        self.near.clear();
        self.pieces.clear();
        for (member, particle) in cluster.members().enumerate().filter(|(_, i)| wanted(*i)) {
            let own = cluster.walls(member);
            let of_points = own.wall.index.iter().map(|v| set.points.wall[*v as usize]);
            let of_contacts = own.contacts.iter();
            let of_contacts = of_contacts.map(|c| set.elements.wall[c.element as usize]);
            self.walls.clear();
            for wall in of_points.chain(of_contacts) {
                if !self.walls.contains(&wall) {
                    self.walls.push(wall);
                }
            }
            self.walls.sort_unstable();
            let points = cluster.buffers.walls[member].only(|_| true);
            let from = self.pieces.len();
            let alone = self.walls.len() == 1;
            let gradient = size(own.contacts);
            let piece = |wall: &u32| {
                let mut piece = Piece {
                    wall: *wall,
                    points: Scratch::new(),
                    contacts: ContactBlock::default(),
                    share: f64::from(u8::from(gradient > 0.0)),
                };
                if !alone {
                    piece.points = points.only(|v| set.points.wall[v as usize] == *wall);
                    let of_it = |s: u32| set.elements.wall[s as usize] == *wall;
                    piece.contacts.push_row(own.contacts, of_it);
                    piece.share *= size(all(&piece.contacts)) / gradient.max(f64::MIN_POSITIVE);
                }
                piece
            };
            self.pieces.extend(self.walls.iter().map(piece));
            self.near.push(Near {
                member,
                particle,
                points,
                pieces: from..self.pieces.len(),
            });
        }
    }

    /// Sums all terms for every member: without walls, the same with γ = 1, with every wall alone, and with all of them.
    fn sum(&mut self, cluster: &mut Cluster<'_, D>, terms: &[Box<dyn RowTerm<D> + '_>]) {
        let none = (Row::empty(), ContactRow::NONE);
        let contacts = cluster.contacts;
        let mut walled = Vec::with_capacity(self.pieces.len() + 3 * self.near.len());
        for near in &self.near {
            let gamma = cluster.renormalisation.map(|g| g[near.particle]);
            let mut with = |(points, contacts), gamma: Option<f64>| {
                walled.push(Walled {
                    member: near.member,
                    points,
                    contacts,
                    inverse_renormalisation: gamma.map_or(1.0, |g| 1.0 / g),
                });
            };
            with(none, gamma);
            with(none, None);
            let pieces = &self.pieces[near.pieces.clone()];
            if pieces.len() > 1 {
                pieces
                    .iter()
                    .for_each(|p| with((p.points.row(), all(&p.contacts)), gamma));
            }
            with((near.points.row(), contacts.of(near.particle)), gamma);
        }
        self.rates.clear();
        self.rates.resize(walled.len(), Rates::of(Vect::zeros()));
        terms
            .iter()
            .for_each(|t| t.cluster_walled(cluster, &walled, &mut self.rates));
    }

    /// Each wall has what its own points and elements add. What is left is shared as ∇γ is.
    fn leave(&self, mass: &[f64], parts: &mut Vec<WallPart<D>>) {
        let mut rates = self.rates.iter().map(|r| r.acceleration);
        let mut next = || rates.next().unwrap_or_else(Vect::zeros);
        for near in &self.near {
            let pieces = &self.pieces[near.pieces.clone()];
            let (fluid, bare) = (next(), next());
            let first = parts.len();
            let part = |piece: &Piece<D>, force| WallPart {
                particle: near.particle as u32,
                wall: piece.wall,
                force,
            };
            let whole = match pieces {
                [only] => {
                    let whole = next();
                    parts.push(part(only, whole - fluid));
                    whole
                }
                _ => {
                    parts.extend(pieces.iter().map(|piece| part(piece, next() - fluid)));
                    next()
                }
            };
            let own = &mut parts[first..];
            let rest = own.iter().fold(whole - bare, |rest, own| rest - own.force);
            for (own, piece) in own.iter_mut().zip(pieces) {
                own.force = (own.force + rest * piece.share) * -mass[near.particle];
            }
        }
    }
}
