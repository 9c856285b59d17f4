//! Forces of every particle on each wall.

use std::ops::Range;

use rayon::prelude::*;
use sph_core::{StepError, Vect, fields};
use sph_kernels::lanes::MOST;

use crate::terms::sweep::{Sweep, with_all};
use crate::walls::slopes::of_particle;
use crate::{
    CHUNK, Cluster, ContactBlock, ContactRow, Contacts, Interaction, Neighbourhood, Rates, RowTerm,
    Scratch, World,
};

/// Force of a particle on a wall.
#[derive(Clone, Copy, Debug)]
pub struct WallPart<const D: usize> {
    /// The particle.
    pub particle: u32,
    /// The wall.
    pub wall: u32,
    /// Force, N (N/m in two dimensions).
    pub force: Vect<D>,
}

/// Forces of the wanted particles on the walls that they see, by particle and wall: the parts of
/// [`wall_forces`](crate::wall_forces).
///
/// Terms are of the form a = (B + Σ_k W_k)/γ, B the sum over particles and W_k that over the points and elements of wall
/// k. The walls' part is a − B = Σ_k W_k + (1 − γ) a. Each wall has its W_k; (1 − γ) a is shared as
/// Σ_s ± |∇γ_as| (R − |d_as|) is over the walls, R the support radius and d_as the distance from the plane of an element
/// with its sign: about the wall's own 1 − γ, which add up. W_k/γ in the place of W_k would leave B (1/γ − 1) to be
/// shared, where the large gradients of two walls before each other nearly cancel.
///
/// Where walls scale the kernel, a sum has B ∇ ln s in their place, and each wall has B ∇ ln s_k, exactly.
///
/// # Errors
/// If a term misses a column.
pub fn wall_parts<const D: usize>(
    world: &World<D>,
    terms: &[&dyn Interaction<D>],
    wanted: impl Fn(usize) -> bool + Sync,
) -> Result<Vec<WallPart<D>>, StepError> {
    let sweep = Sweep::new(world, &*world.kernel)?;
    let mass = world.free.get(fields::MASS)?;
    let contacts = &world.walls.contacts;
    // Computed once: clusters read it again and again.
    let mut asked = vec![false; sweep.particles()];
    let mut ask = |i: usize| asked[i] = wanted(i);
    let beside =
        |i: &usize| !contacts.of_particle(*i).is_empty() || !world.wall_candidates(*i).is_empty();
    (0..sweep.particles()).filter(beside).for_each(&mut ask);
    let slopes = world.walls.slopes.iter();
    slopes.for_each(|slope| ask(slope.particle as usize));
    let none = Contacts::default();
    let mut parts = Vec::new();
    let declared: Vec<_> = terms.iter().map(|term| term.access()).collect();
    with_all(world, &declared, terms, None, &mut |term| {
        let blocks = asked.par_chunks(CHUNK).enumerate();
        let room = || (world.lists.pools.sweeps.acquire(), SeparateWalls::default());
        let all = blocks.map_init(room, |(room, apart), (block, asked)| {
            let mut parts = Vec::new();
            if !asked.contains(&true) {
                return parts;
            }
            let wanted = |i: usize| asked[i - block * CHUNK];
            sweep.each_wanted(block, wanted, &mut room.0, |cluster| {
                apart.take(world, cluster, wanted);
                apart.sum(cluster, term, &none);
                apart.leave(mass, &mut parts);
            });
            parts
        });
        parts = all.collect::<Vec<_>>().concat();
        Ok(())
    })?;
    Ok(parts)
}

/// The walls before the members of a cluster, one by one.
#[derive(Default)]
struct SeparateWalls<const D: usize> {
    near: Vec<WallMember>,
    /// Of members that see several walls.
    pieces: Vec<Piece<D>>,
    /// Accelerations of every member by all terms, with all walls, and without any and with γ = 1.
    whole: Vec<Rates<D>>,
    bare: Vec<Rates<D>>,
    walls: Vec<u32>,
}

struct WallMember {
    member: usize,
    particle: usize,
    only: Option<u32>,
    /// Its walls among the pieces, where there are several.
    pieces: Range<usize>,
}

struct Piece<const D: usize> {
    wall: u32,
    points: Scratch<D>,
    contacts: ContactBlock<D>,
    /// ∇ ln s of the wall, 1/m.
    slope: Vect<D>,
    /// About its own 1 − γ, in any unit.
    deficit: f64,
    /// Acceleration of the member by all terms with this wall alone and γ = 1, m/s².
    acceleration: Vect<D>,
}

fn all<const D: usize>(contacts: &ContactBlock<D>) -> ContactRow<'_, D> {
    contacts.row(0..contacts.planes())
}

fn sum<const D: usize>(
    cluster: &mut Cluster<'_, D>,
    term: &dyn RowTerm<D>,
    rates: &mut Vec<Rates<D>>,
) {
    rates.clear();
    rates.resize(
        cluster.members().len(),
        Rates::from_acceleration(Vect::zeros()),
    );
    term.cluster(cluster, rates);
}

impl<const D: usize> SeparateWalls<D> {
    fn take(&mut self, world: &World<D>, cluster: &Cluster<'_, D>, wanted: impl Fn(usize) -> bool) {
        let set = &world.walls;
        self.near.clear();
        self.pieces.clear();
        for (member, particle) in cluster.members().enumerate().filter(|(_, i)| wanted(*i)) {
            let own = cluster.walls(member);
            let of_points = own.wall.index.iter().map(|v| set.points.wall[*v as usize]);
            let of_contacts = own.contacts.elements().iter();
            let of_contacts = of_contacts.map(|s| set.elements.wall[*s as usize]);
            self.walls.clear();
            let of_slopes = of_particle(&set.slopes, particle).iter().map(|s| s.wall);
            for wall in of_points.chain(of_contacts).chain(of_slopes) {
                if !self.walls.contains(&wall) {
                    self.walls.push(wall);
                }
            }
            self.walls.sort_unstable();
            let from = self.pieces.len();
            let only = match self.walls[..] {
                [only] => Some(only),
                _ => {
                    let pieces = self.walls.iter().map(|wall| Piece::new(world, &own, *wall));
                    self.pieces.extend(pieces);
                    None
                }
            };
            self.near.push(WallMember {
                member,
                particle,
                only,
                pieces: from..self.pieces.len(),
            });
        }
    }

    /// Sums all terms with all walls and without any, and those of members with several walls with each of them alone.
    fn sum(&mut self, cluster: &mut Cluster<'_, D>, term: &dyn RowTerm<D>, none: &Contacts<D>) {
        sum(cluster, term, &mut self.whole);
        if !self.pieces.is_empty() {
            let (near, pieces) = (&self.near, &mut self.pieces);
            cluster.rows(|k, own| {
                let near = near.iter().filter(|near| near.member == k);
                let own_pieces = near.flat_map(|near| near.pieces.clone());
                own_pieces.for_each(|p| pieces[p].sum(own, term));
            });
        }
        cluster.buffers.walls.iter_mut().for_each(Scratch::clear);
        let unsloped = cluster.scaling.map(|s| s.with_slope(Vect::zeros()));
        let mut without = Cluster {
            contacts: none,
            inverse_renormalisation: [1.0; MOST],
            scaling: unsloped.as_ref(),
            buffers: &mut *cluster.buffers,
            ..*cluster
        };
        sum(&mut without, term, &mut self.bare);
    }

    /// Each wall has the part of its own points and elements. (1 − γ) a is shared as the walls' own 1 − γ are.
    fn leave(&self, mass: &[f64], parts: &mut Vec<WallPart<D>>) {
        for near in &self.near {
            let at = |rates: &[Rates<D>]| rates[near.member].acceleration;
            let (whole, bare) = (at(&self.whole), at(&self.bare));
            let mut leave = |wall: u32, acceleration: Vect<D>| {
                parts.push(WallPart {
                    particle: near.particle as u32,
                    wall,
                    force: acceleration * -mass[near.particle],
                });
            };
            if let Some(wall) = near.only {
                leave(wall, whole - bare);
                continue;
            }
            let pieces = &self.pieces[near.pieces.clone()];
            let own = |piece: &Piece<D>| piece.acceleration - bare;
            let rest = pieces.iter().fold(whole - bare, |rest, p| rest - own(p));
            let deficits: f64 = pieces.iter().map(|p| p.deficit).sum();
            for piece in pieces {
                let share = match deficits > 0.0 {
                    true => piece.deficit / deficits,
                    false => 0.0,
                };
                leave(piece.wall, own(piece) + rest * share);
            }
        }
    }
}

impl<const D: usize> Piece<D> {
    fn new(world: &World<D>, own: &Neighbourhood<'_, D>, wall: u32) -> Self {
        let set = &world.walls;
        let mut contacts = ContactBlock::default();
        contacts.push_row(own.contacts, |s| set.elements.wall[s as usize] == wall);
        let support = world.kernel.support_radius();
        // The part of 1 − γ that a plane leaves falls from ½ at d = 0 as |∇γ| (R − d) does, within a factor of two; planes
        // that look away take it off.
        let deficit = all(&contacts).iter().map(|c| {
            (c.gradient.norm() * (support - c.distance.abs()).max(0.0)).copysign(c.distance)
        });
        Piece {
            wall,
            points: Scratch::copied(&own.wall, |v| set.points.wall[v as usize] == wall),
            deficit: deficit.sum::<f64>().max(0.0),
            contacts,
            slope: (of_particle(&set.slopes, own.particle).iter())
                .filter(|s| s.wall == wall)
                .fold(Vect::zeros(), |sum, s| sum + s.slope),
            acceleration: Vect::zeros(),
        }
    }

    /// Sums all terms of a member with this wall in the place of all of its own.
    fn sum(&mut self, own: &Neighbourhood<'_, D>, term: &dyn RowTerm<D>) {
        let scaling = own.scaling.map(|s| s.with_slope(self.slope));
        let alone = Neighbourhood {
            wall: self.points.row(),
            contacts: all(&self.contacts),
            inverse_renormalisation: 1.0,
            scaling: scaling.as_ref(),
            ..*own
        };
        let mut rates = Rates::from_acceleration(Vect::zeros());
        term.row(&alone, &mut rates);
        self.acceleration = rates.acceleration;
    }
}
