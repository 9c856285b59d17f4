//! Sums of a gradient of the velocity, over free neighbours and walls.

use nalgebra::SMatrix;
use sph_core::Vect;
use sph_neighbours::{Neighbourhood, WallSet};

use crate::stress::{NeighbourSums, VelocityGradient};

/// Sums of one particle: of velocities, then of positions.
///
/// An element stands at the foot of the particle on its plane. Walls that do not rub stop the velocity normal to them,
/// and have no velocity along them: they take part in the gradient of the normal component alone. (Without them a
/// wall's force would do work that no strain answers.) So do open faces, apart from such walls: where both meet, what a wall
/// at rest says of the velocity along it is not to be taken for what the face says of that through it.
#[derive(Clone, Copy)]
pub struct Gathered<const D: usize> {
    /// Of free neighbours, and of walls as far as they rub.
    sums: [SMatrix<f64, D, D>; 2],
    /// Sums of walls that slip, and of open faces.
    slipping: [Slipping<D>; 2],
}

/// Equations for the normal component alone.
#[derive(Clone, Copy)]
struct Slipping<const D: usize> {
    sums: [SMatrix<f64, D, D>; 2],
    facing: Vect<D>,
}

const WALLS: usize = 0;
const OPEN: usize = 1;

impl<const D: usize> Gathered<D> {
    /// Of free neighbours, and of the walls near a particle with this velocity.
    #[inline(always)]
    pub(crate) fn new(
        free: LaneSums<f64, D>,
        own: &Vect<D>,
        walls: &WallSet<D>,
        at: &Neighbourhood<'_, D>,
    ) -> Self {
        let nothing = Slipping {
            sums: [SMatrix::zeros(); 2],
            facing: Vect::zeros(),
        };
        let mut all = Gathered {
            sums: free.map(|free| SMatrix::from_fn(|i, k| free[i][k])),
            slipping: [nothing; 2],
        };
        let (points, elements) = (&walls.points, &walls.elements);
        for (v, pair) in at.wall.pairs() {
            let (apart, share) = (pair.separation, points.share[v] * points.volume[v]);
            let weight = (apart * (share * pair.factor)).transpose();
            let velocity = (points.viscous_velocity[v] - own) * weight;
            let kind = if points.ports { OPEN } else { WALLS };
            all.add([velocity, -apart * weight], points.friction_factor[v], kind);
        }
        for contact in at.contacts {
            let s = contact.element as usize;
            let weight = -contact.gradient.transpose();
            let foot = elements.normal[s] * contact.distance;
            let velocity = (elements.velocity_at(&contact) - own) * weight;
            let friction_factor = elements.friction_factor[s];
            let kind = match elements.open.get(s) {
                Some(true) => OPEN,
                _ => WALLS,
            };
            all.add([velocity, -foot * weight], friction_factor, kind);
            all.slipping[kind].facing += contact.gradient * (1.0 - friction_factor);
        }
        all
    }

    #[inline(always)]
    fn add(&mut self, added: [SMatrix<f64, D, D>; 2], friction_factor: f64, kind: usize) {
        for (k, added) in added.iter().enumerate() {
            self.sums[k] += added * friction_factor;
            self.slipping[kind].sums[k] += added * (1.0 - friction_factor);
        }
    }

    pub(crate) fn gradient(
        &self,
        formula: &dyn VelocityGradient<D>,
        inverse_renormalisation: f64,
    ) -> SMatrix<f64, D, D> {
        let with = |added: &[SMatrix<f64, D, D>; 2]| {
            formula.gradient(&NeighbourSums {
                velocity: self.sums[0] + added[0],
                position: self.sums[1] + added[1],
                inverse_renormalisation,
            })
        };
        let along = with(&[SMatrix::zeros(); 2]);
        let mut whole = along;
        let mut take = |slipping: &Slipping<D>| {
            if let Some(normal) = slipping.facing.try_normalize(0.0) {
                let across = with(&slipping.sums);
                whole += normal * (normal.transpose() * (across - along));
            }
        };
        let [walls, open] = &self.slipping;
        match open.beyond(walls) {
            Some(beyond) => [walls, &beyond].into_iter().for_each(&mut take),
            None => take(&walls.and(open)),
        }
        whole
    }
}

impl<const D: usize> Slipping<D> {
    fn and(&self, other: &Self) -> Self {
        Slipping {
            sums: [self.sums[0] + other.sums[0], self.sums[1] + other.sums[1]],
            facing: self.facing + other.facing,
        }
    }

    /// Continuation at a wall that it meets at an angle: itself, facing where the wall does not.
    fn beyond(&self, wall: &Self) -> Option<Self> {
        let normal = wall.facing.try_normalize(0.0)?;
        let facing = self.facing - normal * normal.dot(&self.facing);
        let at_an_angle = facing.norm() > 0.5 * self.facing.norm();
        at_an_angle.then_some(Slipping { facing, ..*self })
    }
}

/// Sums of several particles. That of positions is symmetric, but half of it is no faster: its rows fill no vectors.
pub type LaneSums<L, const D: usize> = [[[L; D]; D]; 2];
