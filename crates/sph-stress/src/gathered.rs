//! What a gradient of the velocity is made of, from free neighbours and walls.

use nalgebra::SMatrix;
use sph_core::Vect;
use sph_neighbours::{Contact, Elements, Lane, LanePair, WallPoints, set};

use crate::{NeighbourSums, VelocityGradient};

/// Sums of one particle: of velocities, then of positions.
///
/// An element stands at the foot of the particle on its plane. Walls that do not rub stop the velocity normal to them,
/// and know nothing of that along them: they take part in the gradient of the normal component alone. (Without them a
/// wall's force would do work that no strain answers.)
#[derive(Clone, Copy)]
pub struct Gathered<const D: usize> {
    /// Of free neighbours, and of walls as far as they rub.
    sums: [SMatrix<f64, D, D>; 2],
    /// What walls that slip add.
    slipping: [SMatrix<f64, D, D>; 2],
    /// Where they face.
    facing: Vect<D>,
}

impl<const D: usize> Default for Gathered<D> {
    #[inline(always)]
    fn default() -> Self {
        Gathered {
            sums: [SMatrix::zeros(); 2],
            slipping: [SMatrix::zeros(); 2],
            facing: Vect::zeros(),
        }
    }
}

impl<const D: usize> Gathered<D> {
    /// With sums of further free neighbours.
    #[inline(always)]
    pub(crate) fn with(mut self, [velocity, position]: [SMatrix<f64, D, D>; 2]) -> Self {
        self.sums[0] += velocity;
        self.sums[1] += position;
        self
    }

    /// Adds a wall point at r_a − r_v with its F.
    #[inline(always)]
    pub(crate) fn point(
        &mut self,
        own: &Vect<D>,
        points: &WallPoints<D>,
        v: usize,
        apart: &Vect<D>,
        factor: f64,
    ) {
        let share = points.share[v] * points.volume[v];
        let weight = (apart * (share * factor)).transpose();
        let velocity = (points.viscous_velocity[v] - own) * weight;
        self.add([velocity, -apart * weight], points.grip[v]);
    }

    /// Adds a wall element.
    #[inline(always)]
    pub(crate) fn element(&mut self, own: &Vect<D>, elements: &Elements<D>, contact: &Contact<D>) {
        let s = contact.element as usize;
        let weight = -contact.gradient.transpose();
        let foot = elements.normal[s] * contact.distance;
        let velocity = (elements.velocity[s] - own) * weight;
        let grip = elements.grip[s];
        self.add([velocity, -foot * weight], grip);
        self.facing += contact.gradient * (1.0 - grip);
    }

    #[inline(always)]
    fn add(&mut self, added: [SMatrix<f64, D, D>; 2], grip: f64) {
        for (k, added) in added.iter().enumerate() {
            self.sums[k] += added * grip;
            self.slipping[k] += added * (1.0 - grip);
        }
    }

    /// The gradient by a formula.
    pub(crate) fn gradient(
        &self,
        formula: &dyn VelocityGradient<D>,
        inverse_renormalisation: f64,
    ) -> SMatrix<f64, D, D> {
        let [velocity, position] = self.sums;
        let mut sums = NeighbourSums {
            velocity,
            position,
            inverse_renormalisation,
        };
        let along = formula.gradient(&sums);
        let Some(normal) = self.facing.try_normalize(0.0) else {
            return along;
        };
        sums.velocity += self.slipping[0];
        sums.position += self.slipping[1];
        let across = formula.gradient(&sums);
        along + normal * (normal.transpose() * (across - along))
    }
}

/// Sums of several particles. That of positions is symmetric, but half of it is no faster: its rows fill no vectors.
pub type LaneSums<L, const D: usize> = [[[L; D]; D]; 2];

/// Adds a free neighbour.
#[inline(always)]
pub(crate) fn add_free<const D: usize, L: Lane>(
    own: &[L; D],
    velocity: &Vect<D>,
    volume: f64,
    pair: &LanePair<D, L>,
    [of_velocities, of_positions]: &mut LaneSums<L, D>,
) {
    let share = L::splat(volume) * pair.factor;
    let mut weight = pair.separation;
    for w in &mut weight {
        *w = *w * share;
    }
    for i in 0..D {
        let rise = L::splat(velocity[i]) - own[i];
        for k in 0..D {
            of_velocities[i][k] += rise * weight[k];
            of_positions[i][k] -= pair.separation[i] * weight[k];
        }
    }
}

/// Velocities of particles side by side.
#[inline(always)]
pub(crate) fn side_by_side<L: Lane, const D: usize>(here: &[Vect<D>]) -> [L; D] {
    let mut side = [L::splat(0.0); D];
    for (lane, own) in here.iter().enumerate() {
        set(&mut side, lane, own);
    }
    side
}

/// The sums of one lane. Plain loops: what is handed to a closure leaves the registers, in the walk as well.
#[inline(always)]
pub(crate) fn one_lane<const D: usize, L: Lane>(
    [of_velocities, of_positions]: &LaneSums<L, D>,
    lane: usize,
) -> [SMatrix<f64, D, D>; 2] {
    let mut sums = [SMatrix::zeros(); 2];
    for i in 0..D {
        for k in 0..D {
            sums[0][(i, k)] = of_velocities[i][k].at(lane);
            sums[1][(i, k)] = of_positions[i][k].at(lane);
        }
    }
    sums
}
