//! What the fluid exerts on the walls.

use rayon::prelude::*;
use sph_core::{StepError, Vect, fields};

use crate::packed::{Packed, pack};
use crate::row::Row;
use crate::term::Rates;
use crate::{
    ContactBlock, ContactRow, Interaction, NOBODY, Neighbourhood, Scratch, SharedElements,
    WallForce, World,
};

/// r × f; the third component alone in two dimensions.
pub fn cross<const D: usize>(r: &Vect<D>, f: &Vect<D>) -> [f64; 3] {
    let at = |v: &Vect<D>, k: usize| v.get(k).copied().unwrap_or(0.0);
    [
        at(r, 1) * at(f, 2) - at(r, 2) * at(f, 1),
        at(r, 2) * at(f, 0) - at(r, 0) * at(f, 2),
        at(r, 0) * at(f, 1) - at(r, 1) * at(f, 0),
    ]
}

/// Forces on the wanted ones of all walls, in the order of their names, at the state of the last sweep; NaN on the others.
///
/// It costs several sweeps over the particles that see a wanted wall, nothing for the others.
///
/// The walls' part of an acceleration is the whole less what the other particles would contribute
/// with γ = 1, which is equal and opposite between two particles and leaves no momentum. Each
/// wall has what its own points and elements add; what is left (the other particles' sums times
/// 1/γ − 1, and what a term makes of several walls together) is shared as ∇γ is.
///
/// # Errors
/// If a term misses a column.
pub fn wall_forces<const D: usize>(
    world: &World<D>,
    terms: &[&dyn Interaction<D>],
    wanted: &[bool],
) -> Result<Vec<WallForce<D>>, StepError> {
    let positions = world.free.get(fields::POSITION)?;
    let force = |wanted: &bool| match wanted {
        true => WallForce::zero(),
        false => WallForce::unknown(),
    };
    let mut forces: Vec<_> = wanted.iter().map(force).collect();
    let (walls, lists) = (&world.walls, &world.lists.wall);
    let sees = |i: usize| {
        let mut contacts = walls.contacts.of(i).iter();
        let points = if lists.is_empty() { &[] } else { lists.row(i) };
        contacts.any(|c| wanted[walls.elements.wall[c.element as usize] as usize])
            || (points.iter()).any(|v| wanted[walls.points.wall[*v as usize] as usize])
    };
    let own = world.team.as_ref().map(|team| team.own(&world.free));
    let sees = |i: usize| sees(i) && own.as_ref().is_none_or(|own| own[i]);
    let mut parts: Vec<Vec<[f64; 6]>> = vec![Vec::new(); wanted.len()];
    for (i, on_walls) in wall_parts(world, terms, sees)?.iter().enumerate() {
        for (wall, force) in on_walls {
            let mut both = [0.0; 6];
            both[..D].copy_from_slice(force.as_slice());
            both[3..].copy_from_slice(&cross(&positions[i], force));
            parts[*wall as usize].push(both);
        }
    }
    for ((total, parts), _) in forces
        .iter_mut()
        .zip(&parts)
        .zip(wanted)
        .filter(|(_, w)| **w)
    {
        let sums = world.sums_of(|| parts.par_iter().with_min_len(1024).copied())?;
        total.force = Vect::from_fn(|k, _| sums[k]);
        total.moment = [sums[3], sums[4], sums[5]];
    }
    for (wall, total) in forces.iter_mut().enumerate().filter(|(w, _)| wanted[*w]) {
        let sums = pressure_on(world, wall as u32)?;
        total.pressure_force = Vect::from_fn(|k, _| sums[k]);
        total.pressure_moment = [sums[3], sums[4], sums[5]];
    }
    Ok(forces)
}

/// Force and moment of the pressure on the elements of a wall.
fn pressure_on<const D: usize>(world: &World<D>, wall: u32) -> Result<[f64; 6], StepError> {
    let elements = &world.walls.elements;
    let shared = SharedElements::of(world)?;
    let counts = |s: usize| shared.as_ref().is_none_or(|shared| shared.own(s));
    let part = |s: usize| {
        let force = elements.normal[s] * (-elements.pressure[s] * elements.measure[s]);
        let mut both = [0.0; 6];
        both[..D].copy_from_slice(force.as_slice());
        both[3..].copy_from_slice(&cross(&elements.centre[s], &force));
        both
    };
    let all = (0..elements.centre.len()).into_par_iter().with_min_len(256);
    let on = all.filter(|s| elements.wall[*s] == wall && counts(*s));
    world.sums_of(|| on.clone().map(part))
}

/// What every wanted particle exerts on which wall, N: the parts of [`wall_forces`]. Nothing for particles
/// that see no wall.
///
/// # Errors
/// If a term misses a column.
pub fn wall_parts<const D: usize>(
    world: &World<D>,
    terms: &[&dyn Interaction<D>],
    wanted: impl Fn(usize) -> bool + Sync,
) -> Result<Vec<Vec<(u32, Vect<D>)>>, StepError> {
    let bound = terms
        .iter()
        .map(|t| t.bind(world))
        .collect::<Result<Vec<_>, _>>()?;
    let mut states = Vec::new();
    pack(world, &mut states, Packed::of(terms.iter().copied()))?;
    let positions = world.free.get(fields::POSITION)?;
    let mass = world.free.get(fields::MASS)?;
    let gamma = world.free.get(fields::RENORMALISATION).ok();
    let empty = Scratch::<D>::new();
    let near_wall = |i: usize| {
        let contacts = world.walls.contacts.of(i);
        !contacts.is_empty() || !(world.lists.wall.is_empty() || world.lists.wall.row(i).is_empty())
    };
    let parts = (0..positions.len())
        .into_par_iter()
        .with_min_len(256)
        .map_init(WallRow::default, |row, i| {
            if !near_wall(i) || !wanted(i) {
                return Vec::new();
            }
            row.gather(world, &positions[i], i);
            let inverse = gamma.map_or(1.0, |g| 1.0 / g[i]);
            let sum =
                |free: &Row<'_, D>, walls: &Row<'_, D>, contacts: ContactRow<'_, D>, inverse| {
                    let neighbourhood = Neighbourhood {
                        particle: i,
                        free: *free,
                        states: &states,
                        wall: *walls,
                        contacts,
                        inverse_renormalisation: inverse,
                    };
                    let mut rates = Rates::of(Vect::zeros());
                    bound.iter().for_each(|t| t.row(&neighbourhood, &mut rates));
                    rates.acceleration
                };
            let (none, free) = (empty.row(), row.free.row());
            // A term may look at the free neighbours when it judges the wall's: they are there.
            let nothing = ContactRow::NONE;
            let fluid = sum(&free, &none, nothing, inverse);
            let mut rest = sum(&free, &row.points.row(), all(&row.contacts), inverse)
                - sum(&free, &none, nothing, 1.0);
            let own = |wall: &u32| {
                let (points, contacts) = row.of(world, *wall);
                let own = sum(&free, &points.row(), all(&contacts), inverse) - fluid;
                (*wall, own, row.share(&contacts))
            };
            let parts: Vec<_> = row.walls.iter().map(own).collect();
            rest = parts.iter().fold(rest, |rest, (_, own, _)| rest - own);
            let parts = parts.into_iter();
            parts
                .map(|(wall, own, share)| (wall, (own + rest * share) * -mass[i]))
                .collect()
        })
        .collect();
    Ok(parts)
}

/// The neighbourhood of one particle, to be taken apart by wall.
struct WallRow<const D: usize> {
    free: Scratch<D>,
    points: Scratch<D>,
    contacts: ContactBlock<D>,
    /// Σ |∇γ_as| over all contacts, 1/m.
    gradient: f64,
    walls: Vec<u32>,
}

impl<const D: usize> Default for WallRow<D> {
    fn default() -> Self {
        WallRow {
            free: Scratch::new(),
            points: Scratch::new(),
            contacts: ContactBlock::default(),
            gradient: 0.0,
            walls: Vec::new(),
        }
    }
}

fn all<const D: usize>(contacts: &ContactBlock<D>) -> ContactRow<'_, D> {
    contacts.row(0..contacts.planes())
}

fn sizes<const D: usize>(contacts: &ContactBlock<D>) -> f64 {
    all(contacts).iter().map(|c| c.gradient.norm()).sum()
}

impl<const D: usize> WallRow<D> {
    fn gather(&mut self, world: &World<D>, x: &Vect<D>, i: usize) {
        let set = &world.walls;
        let kernel = &*world.kernel;
        let domain = world.domain.any_periodic().then_some(&world.domain);
        if let Ok(positions) = world.free.get(fields::POSITION) {
            let candidates = world.lists.free.candidates(i);
            self.free
                .fill(x, positions, candidates, i as u32, domain, kernel);
        }
        self.points.clear();
        if !world.lists.wall.is_empty() {
            let (candidates, sources) = (world.lists.wall.row(i), &set.points.position);
            self.points
                .fill(x, sources, candidates, NOBODY, domain, kernel);
        }
        self.contacts.clear();
        self.contacts.push_row(set.contacts.of(i), |_| true);
        self.gradient = sizes(&self.contacts);
        self.walls.clear();
        let points = self.points.row();
        let of_points = points.index.iter().map(|v| set.points.wall[*v as usize]);
        let contacts = all(&self.contacts).iter();
        let of_contacts = contacts.map(|c| set.elements.wall[c.element as usize]);
        self.walls.extend(of_points.chain(of_contacts));
        self.walls.sort_unstable();
        self.walls.dedup();
    }

    /// The points and contacts of one wall.
    fn of(&self, world: &World<D>, wall: u32) -> (Scratch<D>, ContactBlock<D>) {
        let set = &world.walls;
        let points = self.points.only(|v| set.points.wall[v as usize] == wall);
        let mut contacts = ContactBlock::default();
        contacts.push_row(all(&self.contacts), |s| {
            set.elements.wall[s as usize] == wall
        });
        (points, contacts)
    }

    /// The share of a wall with these contacts in what 1/γ adds.
    fn share(&self, contacts: &ContactBlock<D>) -> f64 {
        match self.gradient > 0.0 {
            true => sizes(contacts) / self.gradient,
            false => 0.0,
        }
    }
}
