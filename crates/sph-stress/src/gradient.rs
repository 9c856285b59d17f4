//! Gradients of the velocity from sums over neighbours.

use std::sync::Arc;

use nalgebra::SMatrix;
use sph_core::{Access, Declares, Stage, StepError, Vect, contract, fields};
use sph_neighbours::{Lane, LanePair, LaneSum, World, set, walk_in_lanes};

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
    /// Whether the force of an elastic stress is the adjoint of this formula, and not of the plain sum over γ.
    fn adjoint(&self) -> bool {
        false
    }
    /// C in G = 1/γ Σ (u_b − u_a) ⊗ weight C.
    fn correction(&self, _sums: &NeighbourSums<D>) -> SMatrix<f64, D, D> {
        SMatrix::identity()
    }
}

contract!(
    /// A velocity gradient that a scene may name.
    pub VelocityGradientEntry, "velocity-gradient", "the strain rate that a law feels", VelocityGradient<D>
);

/// [`VELOCITY_GRADIENT`](fields::VELOCITY_GRADIENT) by a formula.
///
/// All phases count. An element stands at the foot of the particle on its plane. Walls that do not rub stop
/// the velocity normal to them, and know nothing of that along them: they take part in the gradient of the
/// normal component alone. (Without them a wall's force would do work that no strain answers.)
#[derive(Clone)]
pub struct GradientStage<const D: usize> {
    /// The formula.
    pub formula: Arc<dyn VelocityGradient<D>>,
    /// By phase number, whose gradients anybody reads; those of the others are zero. All, if left out.
    pub phases: Option<Arc<[bool]>>,
}

impl<const D: usize> GradientStage<D> {
    /// For the particles of all phases.
    pub fn everywhere(formula: Arc<dyn VelocityGradient<D>>) -> Self {
        let phases = None;
        GradientStage { formula, phases }
    }
}

impl<const D: usize> Declares for GradientStage<D> {
    fn name(&self) -> String {
        "velocity gradient".into()
    }
    fn access(&self) -> Access {
        let access = Access::none()
            .both(fields::POSITION)
            .both(fields::VELOCITY)
            .neighbours(fields::VOLUME)
            .writes(fields::VELOCITY_GRADIENT);
        match self.phases {
            Some(_) => access.here(fields::PHASE),
            None => access,
        }
    }
}

impl<const D: usize> Stage<World<D>> for GradientStage<D> {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let mut gradients = world.free.take(fields::VELOCITY_GRADIENT)?;
        let velocity = world.free.get(fields::VELOCITY)?;
        let volume = world.free.get(fields::VOLUME)?;
        let points = &world.walls.points;
        let elements = &world.walls.elements;
        let read = match &self.phases {
            Some(phases) => Some((phases, world.free.get(fields::PHASE)?)),
            None => None,
        };
        if read.is_some() {
            gradients.fill(SMatrix::zeros());
        }
        let wanted = |i: usize| read.is_none_or(|(phases, of)| phases[of[i] as usize]);
        let free = FreeSums { velocity, volume };
        walk_in_lanes(
            world,
            &free,
            wanted,
            &mut gradients,
            |[velocity_sum, position_sum], rows| {
                let own = velocity[rows.particle];
                let mut sums = NeighbourSums {
                    velocity: velocity_sum,
                    position: position_sum,
                    inverse_renormalisation: rows.inverse_renormalisation,
                };
                // What walls that slip add, and where they face.
                let mut slipping = [SMatrix::<f64, D, D>::zeros(); 2];
                let mut facing = Vect::<D>::zeros();
                for (k, &v) in rows.wall.index.iter().enumerate() {
                    let v = v as usize;
                    let share = points.share[v] * points.volume[v];
                    let apart = &rows.wall.separation[k];
                    let weight = (apart * (share * rows.wall.factor[k])).transpose();
                    let [velocity, position] =
                        [(points.viscous_velocity[v] - own) * weight, -apart * weight];
                    let grip = points.grip[v];
                    sums.velocity += velocity * grip;
                    sums.position += position * grip;
                    slipping[0] += velocity * (1.0 - grip);
                    slipping[1] += position * (1.0 - grip);
                }
                for contact in rows.contacts {
                    let s = contact.element as usize;
                    let weight = -contact.gradient.transpose();
                    let foot = elements.normal[s] * contact.distance;
                    let [velocity, position] =
                        [(elements.velocity[s] - own) * weight, -foot * weight];
                    let grip = elements.grip[s];
                    sums.velocity += velocity * grip;
                    sums.position += position * grip;
                    slipping[0] += velocity * (1.0 - grip);
                    slipping[1] += position * (1.0 - grip);
                    facing += contact.gradient * (1.0 - grip);
                }
                let along = self.formula.gradient(&sums);
                let Some(normal) = facing.try_normalize(0.0) else {
                    return along;
                };
                sums.velocity += slipping[0];
                sums.position += slipping[1];
                let across = self.formula.gradient(&sums);
                along + normal * (normal.transpose() * (across - along))
            },
        )?;
        Ok(world.free.put(fields::VELOCITY_GRADIENT, gradients)?)
    }
}

/// What free neighbours add to [`NeighbourSums`]: velocity, then position.
struct FreeSums<'a, const D: usize> {
    velocity: &'a [Vect<D>],
    volume: &'a [f64],
}

impl<const D: usize> LaneSum<D> for FreeSums<'_, D> {
    type Here = Vect<D>;
    type Sum = [SMatrix<f64, D, D>; 2];
    type Side<L: Lane> = [L; D];
    type Sums<L: Lane> = [[[L; D]; D]; 2];

    #[inline(always)]
    fn here(&self, particle: usize) -> Vect<D> {
        self.velocity[particle]
    }
    #[inline(always)]
    fn side<L: Lane>(&self, here: &[Vect<D>]) -> [L; D] {
        let mut side = [L::splat(0.0); D];
        for (lane, own) in here.iter().enumerate() {
            set(&mut side, lane, own);
        }
        side
    }
    #[inline(always)]
    fn zero<L: Lane>(&self) -> Self::Sums<L> {
        [[[L::splat(0.0); D]; D]; 2]
    }
    #[inline(always)]
    fn lane<L: Lane>(&self, sums: &Self::Sums<L>, lane: usize) -> Self::Sum {
        sums.map(|rows| SMatrix::from_fn(|i, k| rows[i][k].at(lane)))
    }
    #[inline(always)]
    fn add<L: Lane>(
        &self,
        own: &[L; D],
        j: usize,
        pair: &LanePair<D, L>,
        _value: L,
        [velocity, position]: &mut Self::Sums<L>,
    ) {
        let share = L::splat(self.volume[j]) * pair.factor;
        let mut weight = pair.separation;
        for w in &mut weight {
            *w = *w * share;
        }
        for i in 0..D {
            let rise = L::splat(self.velocity[j][i]) - own[i];
            for k in 0..D {
                velocity[i][k] += rise * weight[k];
                position[i][k] -= pair.separation[i] * weight[k];
            }
        }
    }
}
