//! Neighbours of particles: counts and distances for reports.

use rayon::prelude::*;
use sph_core::{FieldError, Vect, fields};

use crate::World;

/// Numbers of neighbours of particles, added up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearby {
    /// Particles in the count.
    pub particles: u64,
    /// Their neighbours within the support, wall points included.
    pub neighbours: u64,
    /// Those of them that have a free particle within the support.
    pub accompanied: u64,
    /// Least distance of these to the nearest free one, m; infinite where there are none.
    pub least: f64,
    /// Sum of the distances of these to the nearest free one, m.
    pub distances: f64,
}

impl Nearby {
    /// Of no particle.
    pub const NONE: Self = Nearby {
        particles: 0,
        neighbours: 0,
        accompanied: 0,
        least: f64::INFINITY,
        distances: 0.0,
    };

    /// Both together.
    pub fn joined(self, other: Self) -> Self {
        Nearby {
            particles: self.particles + other.particles,
            neighbours: self.neighbours + other.neighbours,
            accompanied: self.accompanied + other.accompanied,
            least: self.least.min(other.least),
            distances: self.distances + other.distances,
        }
    }

    /// Mean number of neighbours.
    pub fn mean_neighbours(&self) -> f64 {
        self.neighbours as f64 / self.particles.max(1) as f64
    }

    /// Least and mean distance to the nearest free particle, m; zero where no particle has one within the support.
    pub fn nearest(&self) -> [f64; 2] {
        match self.accompanied {
            0 => [0.0; 2],
            n => [self.least, self.distances / n as f64],
        }
    }
}

impl<const D: usize> World<D> {
    /// Neighbours of the particles that are `counted`; lists must have been built.
    ///
    /// # Errors
    /// If there is no position column, as everywhere below.
    pub fn nearby(&self, counted: impl Fn(usize) -> bool + Sync) -> Result<Nearby, FieldError> {
        let positions = self.free.get(fields::POSITION)?;
        let support = self.kernel.support_radius();
        let apart = |a: &Vect<D>, b: &Vect<D>| self.domain.nearest_image(a - b).norm();
        let points = &self.walls.points.position;
        let of = |i: usize| {
            let x = &positions[i];
            let others = self.lists.free.candidates(i).iter();
            let others = others.filter(|&&j| j as usize != i);
            let distances = others.map(|&j| apart(x, &positions[j as usize]));
            let within = distances.filter(|r| *r < support);
            let (free, nearest) = within.fold((0, f64::INFINITY), |(n, least), r| {
                (n + 1, f64::min(least, r))
            });
            let wall = self.wall_candidates(i).iter();
            let wall = wall.filter(|&&v| apart(x, &points[v as usize]) < support);
            Nearby {
                particles: 1,
                neighbours: free + wall.count() as u64,
                accompanied: u64::from(free > 0),
                least: nearest,
                distances: if free > 0 { nearest } else { 0.0 },
            }
        };
        let all = (0..positions.len()).into_par_iter().with_min_len(256);
        let all: Vec<Nearby> = all.filter(|i| counted(*i)).map(of).collect();
        Ok(all.into_iter().fold(Nearby::NONE, Nearby::joined))
    }

    /// Mean number of neighbours within the support, wall points included; lists must have been built.
    pub fn mean_neighbours(&self) -> Result<f64, FieldError> {
        Ok(self.nearby(|_| true)?.mean_neighbours())
    }
}
