//! Gradients of the velocity from sums over neighbours.

use std::sync::Arc;

use nalgebra::SMatrix;
use sph_core::{Access, Declares, Stage, StepError, contract, fields};
use sph_neighbours::{Around, Values, World, walk};

/// What a formula is made of: sums over neighbours, wall points and elements with the weights
/// θ_b V_b ∇w_ab and −∇γ_as.
#[derive(Clone, Copy, Debug)]
pub struct NeighbourSums<const D: usize> {
    /// Σ (u_b − u_a) ⊗ weight, 1/s.
    pub velocity: SMatrix<f64, D, D>,
    /// Σ (r_b − r_a) ⊗ weight: the unit tensor where neighbours surround the particle evenly.
    pub position: SMatrix<f64, D, D>,
    /// 1/γ.
    pub inverse_renormalisation: f64,
}

/// A formula for (grad u)_ij = ∂u_i/∂x_j.
pub trait VelocityGradient<const D: usize>: Send + Sync {
    /// The gradient from the sums, 1/s; zero for a particle without neighbours.
    fn gradient(&self, sums: &NeighbourSums<D>) -> SMatrix<f64, D, D>;
}

contract!(
    /// A velocity gradient that a scene may name.
    pub VelocityGradientEntry, "velocity-gradient", "the strain rate that a law feels", VelocityGradient<D>
);

/// [`VELOCITY_GRADIENT`](fields::VELOCITY_GRADIENT) by a formula.
///
/// All phases count. Walls that do not rub take no part; an element stands at the foot of the
/// particle on its plane.
pub struct GradientStage<const D: usize>(pub Arc<dyn VelocityGradient<D>>);

impl<const D: usize> Declares for GradientStage<D> {
    fn name(&self) -> String {
        "velocity gradient".into()
    }
    fn access(&self) -> Access {
        Access::none()
            .both(fields::POSITION)
            .both(fields::VELOCITY)
            .neighbours(fields::VOLUME)
            .writes(fields::VELOCITY_GRADIENT)
    }
}

impl<const D: usize> Stage<World<D>> for GradientStage<D> {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let velocity = world.free.get(fields::VELOCITY)?;
        let volume = world.free.get(fields::VOLUME)?;
        let points = &world.walls.points;
        let elements = &world.walls.elements;
        let gradients = walk(world, Values::Gradient, |around: &Around<'_, D>| {
            let rows = &around.rows;
            let own = velocity[rows.particle];
            let mut sums = NeighbourSums {
                velocity: SMatrix::zeros(),
                position: SMatrix::zeros(),
                inverse_renormalisation: rows.inverse_renormalisation,
            };
            for (k, &j) in rows.free.index.iter().enumerate() {
                let j = j as usize;
                let apart = &rows.free.separation[k];
                let weight = (apart * (volume[j] * rows.free.factor[k])).transpose();
                sums.velocity += (velocity[j] - own) * weight;
                sums.position -= apart * weight;
            }
            for (k, &v) in rows.wall.index.iter().enumerate() {
                let v = v as usize;
                let share = points.share[v] * points.volume[v] * points.grip[v];
                let apart = &rows.wall.separation[k];
                let weight = (apart * (share * rows.wall.factor[k])).transpose();
                sums.velocity += (points.viscous_velocity[v] - own) * weight;
                sums.position -= apart * weight;
            }
            for contact in rows.contacts {
                let s = contact.element as usize;
                let weight = (contact.gradient * -elements.grip[s]).transpose();
                let foot = elements.normal[s] * contact.distance;
                sums.velocity += (elements.velocity[s] - own) * weight;
                sums.position -= foot * weight;
            }
            self.0.gradient(&sums)
        })?;
        Ok(world.free.put(fields::VELOCITY_GRADIENT, gradients)?)
    }
}
