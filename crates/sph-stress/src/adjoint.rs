//! The force of a stress as the adjoint of a corrected velocity gradient.

use std::any::Any;
use std::sync::Arc;

use nalgebra::SMatrix;
use sph_core::{Access, Declares, Stage, StepError, Vect, fields};
use sph_neighbours::{
    Around, BoundTerm, Contact, Fused, Interaction, Pair, Rates, RowTerm, There, Values, World,
    walk_into,
};

use crate::strain_rate::in_space;
use crate::{NeighbourSums, VelocityGradient};

/// [`STRESS_CORRECTION`](fields::STRESS_CORRECTION) C_a of a velocity gradient, where the particles are now.
pub struct StressCorrection<const D: usize>(pub Arc<dyn VelocityGradient<D>>);

impl<const D: usize> Declares for StressCorrection<D> {
    fn name(&self) -> String {
        "stress correction".into()
    }
    fn access(&self) -> Access {
        Access::none()
            .both(fields::POSITION)
            .neighbours(fields::VOLUME)
            .writes(fields::STRESS_CORRECTION)
    }
}

impl<const D: usize> Stage<World<D>> for StressCorrection<D> {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let mut corrections = world.free.take(fields::STRESS_CORRECTION)?;
        let volume = world.free.get(fields::VOLUME)?;
        let points = &world.walls.points;
        let elements = &world.walls.elements;
        let correction = |around: &Around<'_, D>| {
            let rows = &around.rows;
            let mut position = SMatrix::<f64, D, D>::zeros();
            for (k, &j) in rows.free.index.iter().enumerate() {
                let apart = &rows.free.separation[k];
                let weight = volume[j as usize] * rows.free.factor[k];
                position -= apart * (apart * weight).transpose();
            }
            for (k, &v) in rows.wall.index.iter().enumerate() {
                let v = v as usize;
                let apart = &rows.wall.separation[k];
                let weight = points.share[v] * points.volume[v] * rows.wall.factor[k];
                position -= apart * (apart * weight).transpose();
            }
            for contact in rows.contacts {
                let foot = elements.normal[contact.element as usize] * contact.distance;
                position += foot * contact.gradient.transpose();
            }
            self.0.correction(&NeighbourSums {
                velocity: SMatrix::zeros(),
                position,
                inverse_renormalisation: rows.inverse_renormalisation,
            })
        };
        walk_into(
            world,
            Values::Gradient,
            |_| true,
            &mut corrections,
            correction,
        )?;
        Ok(world.free.put(fields::STRESS_CORRECTION, corrections)?)
    }
}

/// m_a a = 1/γ_a [Σ_b θ_b V_aV_b (τ_aC_aᵀ + τ_bC_bᵀ)·∇w_ab − 2 Σ_s V_a τ_aC_aᵀ·∇γ_as].
///
/// C is the correction of the velocity gradient, G_a = 1/γ_a Σ_b θ_b V_b (u_b − u_a) ⊗ ∇w_ab C_a. Without
/// walls the power of the force is −Σ V τ:G: what the stress does is what it strains, and an elastic body keeps its
/// energy. Linear momentum is conserved. A wall carries the stress of the particle that touches it; it must not slip.
///
/// Ours, by the principle of virtual work, after Bonet & Lok 1999, §4.
#[derive(Clone, Copy, Debug)]
pub struct AdjointDivergence;

impl<const D: usize> Interaction<D> for AdjointDivergence {
    fn name(&self) -> String {
        "adjoint stress divergence".into()
    }

    fn access(&self) -> Access {
        Access::none()
            .both(fields::CARRIED_STRESS)
            .both(fields::STRESS_CORRECTION)
            .both(fields::VOLUME)
            .here(fields::MASS)
    }

    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Box<dyn RowTerm<D> + 'a>, StepError> {
        let stress = world.free.get(fields::CARRIED_STRESS)?;
        let correction = world.free.get(fields::STRESS_CORRECTION)?;
        let both = stress.iter().zip(correction);
        let points = &world.walls.points;
        Ok(Box::new(Fused(Bound {
            stress: both
                .map(|(t, c)| {
                    (t.matrix() * in_space(c).transpose())
                        .fixed_view::<D, D>(0, 0)
                        .into_owned()
                })
                .collect(),
            volume: world.free.get(fields::VOLUME)?,
            mass: world.free.get(fields::MASS)?,
            wall_volume: &points.volume,
            wall_share: &points.share,
        })))
    }

    fn as_any_ref(&self) -> &dyn Any {
        self
    }

    fn into_any(self: Box<Self>) -> Box<dyn Any> {
        self
    }
}

/// [`AdjointDivergence`] with its columns.
struct Bound<'a, const D: usize> {
    /// τCᵀ.
    stress: Vec<SMatrix<f64, D, D>>,
    volume: &'a [f64],
    mass: &'a [f64],
    wall_volume: &'a [f64],
    wall_share: &'a [f64],
}

/// The particle's own values.
#[derive(Clone, Copy)]
struct Here<const D: usize> {
    stress: SMatrix<f64, D, D>,
    per_mass: f64,
}

impl<const D: usize> BoundTerm<D> for Bound<'_, D> {
    type Here = Here<D>;
    type Sum = Vect<D>;

    #[inline(always)]
    fn here(&self, i: usize) -> Here<D> {
        Here {
            stress: self.stress[i],
            per_mass: self.volume[i] / self.mass[i],
        }
    }

    #[inline(always)]
    fn zero(&self) -> Vect<D> {
        Vect::zeros()
    }

    #[inline(always)]
    fn free(&self, here: &Here<D>, j: usize, there: &There<D>, pair: &Pair<D>, sum: &mut Vect<D>) {
        let weight = there.volume * pair.factor;
        *sum += (here.stress + self.stress[j]) * pair.separation * weight;
    }

    #[inline(always)]
    fn wall(&self, here: &Here<D>, v: usize, pair: &Pair<D>, sum: &mut Vect<D>) {
        let weight = 2.0 * self.wall_share[v] * self.wall_volume[v] * pair.factor;
        *sum += here.stress * pair.separation * weight;
    }

    #[inline(always)]
    fn element(&self, here: &Here<D>, contact: &Contact<D>, sum: &mut Vect<D>) {
        *sum -= here.stress * contact.gradient * 2.0;
    }

    #[inline(always)]
    fn finish(&self, here: &Here<D>, sum: &Vect<D>, inverse_gamma: f64, rates: &mut Rates<D>) {
        rates.acceleration += sum * (here.per_mass * inverse_gamma);
    }
}
