//! Particles of which other ranks need copies.

use std::collections::BTreeMap;

use rayon::prelude::*;
use sph_core::{FieldError, Vect, fields};

use crate::{CellGrid, Domain, World};

/// Lower and upper corner of a box around the particles of a rank, m; upside down for a rank without particles.
pub(crate) type RankBox<const D: usize> = [Vect<D>; 2];

pub(crate) fn around<'a, const D: usize>(places: impl Iterator<Item = &'a Vect<D>>) -> RankBox<D> {
    let nothing = [f64::INFINITY, f64::NEG_INFINITY].map(Vect::repeat);
    places.fold(nothing, |[lower, upper], x| [lower.inf(x), upper.sup(x)])
}

pub(crate) fn around_own<const D: usize>(
    places: &[Vect<D>],
    owners: &[u32],
    rank: usize,
) -> RankBox<D> {
    let own = places.iter().zip(owners);
    around(own.filter(|(_, o)| **o as usize == rank).map(|(x, _)| x))
}

/// Square of the distance of a place from a box, m²; infinite from one around no particle.
fn distance_squared<const D: usize>(
    [lower, upper]: &RankBox<D>,
    x: &Vect<D>,
    domain: &Domain<D>,
) -> f64 {
    let along = |axis: usize| {
        let outside = |x: f64| (lower[axis] - x).max(x - upper[axis]).max(0.0);
        match domain.periodic[axis] {
            false => outside(x[axis]),
            true => {
                let images = [-1.0, 0.0, 1.0].map(|n| x[axis] + n * domain.length(axis));
                let all = images.map(outside).into_iter();
                all.fold(f64::INFINITY, f64::min)
            }
        }
    };
    (0..D).map(|axis| along(axis).powi(2)).sum()
}

/// Finds needed particles: those within reach of a box, and near walls those beyond, since a wall that a particle touches has a
/// state that is a mean over all that are within reach of the wall.
pub struct Needs<'a, const D: usize> {
    domain: &'a Domain<D>,
    /// That of the lists, as often as sums of sums are taken, m.
    reach: f64,
    /// Centres of elements, and points that are in sums or have a state.
    walls: Vec<Vect<D>>,
    grid: Option<CellGrid<D>>,
    /// Largest distance of a particle from the centre of an element that it touches, m.
    touched: f64,
}

impl<'a, const D: usize> Needs<'a, D> {
    /// For the present places of the walls of a world; `rings` is how often a stage goes from particles to their neighbours.
    pub fn new(world: &'a World<D>, rings: usize) -> Self {
        let (reach, domain) = (rings as f64 * world.reach(), &world.domain);
        let (elements, points) = (&world.walls.elements, &world.walls.points);
        let mut walls = elements.centre.clone();
        match world.walls.at_corners {
            true => walls.extend_from_slice(&points.position),
            false if points.in_sums() => {
                walls.extend_from_slice(&points.position[points.corners..])
            }
            false => {}
        }
        let half = elements.corners.iter().zip(&elements.centre);
        let half = half.flat_map(|(corners, centre)| {
            let apart = |c: &u32| domain.nearest_image(points.position[*c as usize] - centre);
            corners.map(|c| apart(&c).norm())
        });
        let half = half.fold(0.0, f64::max);
        let grid = (!walls.is_empty()).then(|| CellGrid::new(&walls, reach, domain));
        Needs {
            domain,
            reach,
            walls,
            grid,
            // Means of elements are spread over their neighbours.
            touched: reach + 3.0 * half,
        }
    }

    /// True if a rank with this box needs copies of particles at a place.
    pub fn at(&self, x: &Vect<D>, rank: &RankBox<D>) -> bool {
        let apart = distance_squared(rank, x, self.domain);
        if apart < self.reach * self.reach {
            return true;
        }
        let Some(grid) = &self.grid else {
            return false;
        };
        if apart >= (self.reach + self.touched).powi(2) {
            return false;
        }
        let mut found = false;
        grid.ranges(x, self.reach, |range| {
            found |= grid.order()[range].iter().any(|w| {
                let wall = &self.walls[*w as usize];
                let near = self.domain.nearest_image(x - wall).norm_squared();
                near < self.reach * self.reach
                    && distance_squared(rank, wall, self.domain) < self.touched * self.touched
            });
        });
        found
    }

    /// The slots of a world's particles that a rank with this box needs, of those that are `offered`.
    pub fn slots(
        &self,
        places: &[Vect<D>],
        rank: &RankBox<D>,
        offered: impl Fn(usize) -> bool,
    ) -> Vec<u32> {
        let needed = |k: &usize| offered(*k) && self.at(&places[*k], rank);
        (0..places.len()).filter(needed).map(|k| k as u32).collect()
    }
}

/// Number of copies that each rank has from each of the others, where every particle of a world has an owner; `rings` is
/// how often a stage goes from particles to their neighbours. Copies are of particles within reach of the box around a
/// rank's own, or of a wall that one of its own touches.
///
/// # Errors
/// If there is no position column.
pub fn ghosts_by_owner<const D: usize>(
    world: &World<D>,
    owners: &[u32],
    ranks: usize,
    rings: usize,
) -> Result<Vec<BTreeMap<u32, usize>>, FieldError> {
    let places = world.free.get(fields::POSITION)?;
    let needs = Needs::new(world, rings);
    let copies = |rank: usize| {
        let around = around_own(places, owners, rank);
        let mut copies = BTreeMap::new();
        for ghost in needs.slots(places, &around, |k| owners[k] as usize != rank) {
            *copies.entry(owners[ghost as usize]).or_default() += 1;
        }
        copies
    };
    Ok((0..ranks).into_par_iter().map(copies).collect())
}
