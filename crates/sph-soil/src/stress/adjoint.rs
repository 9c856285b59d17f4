//! The force of a stress as the adjoint of a corrected velocity gradient.

use std::sync::Arc;

use nalgebra::{Matrix3, SMatrix};
use sph_core::{Access, Stage, StepError, Symmetric, Vect, fields};
use sph_neighbours::{
    Lane, LanePair, Neighbourhood, Particles, Rates, WallPoints, World, column_stage, dot,
    pair_sum, pair_term, scaled, walk_in_lanes,
};

use crate::stress::strain_rate::in_space;
use crate::stress::{NeighbourSums, VelocityGradient};

/// [`STRESS_CORRECTION`](fields::STRESS_CORRECTION) C_a of a velocity gradient, where the particles are now.
pub(crate) fn stress_correction<const D: usize>(
    formula: Arc<dyn VelocityGradient<D>>,
) -> impl Stage<World<D>> {
    let access = Access::none()
        .both(fields::POSITION)
        .neighbours(fields::VOLUME);
    let (name, field) = ("stress correction", fields::STRESS_CORRECTION);
    column_stage::<D, _>(name, access, field, move |world, corrections| {
        let volume = world.free.get(fields::VOLUME)?;
        let (points, elements) = (&world.walls.points, &world.walls.elements);
        let correction = |free: [[f64; D]; D], rows: &Neighbourhood<'_, D>| {
            let mut position = SMatrix::<f64, D, D>::from_fn(|i, k| free[i][k]);
            for (v, pair) in rows.wall.pairs() {
                let weight = points.share[v] * points.volume[v] * pair.factor;
                position -= pair.separation * (pair.separation * weight).transpose();
            }
            for contact in rows.contacts {
                let foot = elements.normal[contact.element as usize] * contact.distance;
                position += foot * contact.gradient.transpose();
            }
            formula.correction(&NeighbourSums {
                velocity: SMatrix::zeros(),
                position,
                inverse_renormalisation: rows.inverse_renormalisation,
            })
        };
        let free = FreePositions { volume };
        walk_in_lanes(world, &free, |_| true, corrections, correction)
    })
}

/// −Σ V r ⊗ ∇w of free neighbours.
struct FreePositions<'a> {
    volume: &'a [f64],
}

#[pair_sum]
impl<const D: usize> FreePositions<'_> {
    fn pair<L: Lane>(&self, _: &(), j: usize, pair: &LanePair<D, L>, sums: &mut [[L; D]; D]) {
        let weight = scaled(pair.separation, L::splat(self.volume[j]) * pair.factor);
        for (row, along) in sums.iter_mut().zip(pair.separation) {
            for (sum, weight) in row.iter_mut().zip(weight) {
                *sum -= along * weight;
            }
        }
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

/// τCᵀ of all particles.
struct CorrectedStress;

impl CorrectedStress {
    fn access(&self) -> Access {
        Access::none().both((fields::CARRIED_STRESS, fields::STRESS_CORRECTION))
    }
    fn bind<const D: usize>(&self, world: &World<D>) -> Result<Vec<SMatrix<f64, D, D>>, StepError> {
        let stress = world.free.get(fields::CARRIED_STRESS)?.iter();
        let both = stress.zip(world.free.get(fields::STRESS_CORRECTION)?);
        // Rows that are taken for columns are those of the transpose.
        let product = |t: &Symmetric, c| t.matrix() * Matrix3::from(in_space(c));
        Ok(both
            .map(|(t, c)| product(t, c).fixed_view::<D, D>(0, 0).into_owned())
            .collect())
    }
}

/// [`AdjointDivergence`] with its columns.
#[pair_term(AdjointDivergence, "adjoint stress divergence")]
pub struct BoundAdjoint<'a, const D: usize> {
    #[bound(CorrectedStress)]
    stress: Vec<SMatrix<f64, D, D>>,
    #[both(fields::VOLUME)]
    volume: &'a [f64],
    #[here(fields::MASS)]
    mass: &'a [f64],
    #[value(&world.walls.points)]
    points: &'a WallPoints<D>,
}

#[pair_sum]
impl<const D: usize> BoundAdjoint<'_, D> {
    /// τCᵀ, row by row.
    fn own<L: Lane>(&self, all: Particles) -> [[L; D]; D] {
        let mut own = [[L::splat(0.0); D]; D];
        for (k, row) in own.iter_mut().enumerate() {
            *row = all.each(|i| self.stress[i].row(k).transpose().data.0[0]);
        }
        own
    }

    fn pair<L: Lane>(&self, own: &[[L; D]; D], j: usize, pair: &LanePair<D, L>, sum: &mut [L; D]) {
        let weight = L::splat(self.volume[j]) * pair.factor;
        for (i, (sum, own)) in sum.iter_mut().zip(own).enumerate() {
            let mut row = *own;
            for (k, stress) in row.iter_mut().enumerate() {
                *stress += L::splat(self.stress[j][(i, k)]);
            }
            *sum += dot(&row, &pair.separation) * weight;
        }
    }

    fn finish(&self, sum: [f64; D], at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let i = at.particle;
        let stress = &self.stress[i];
        let mut sum = Vect::from(sum);
        for (v, pair) in at.wall.pairs() {
            let weight = 2.0 * self.points.share[v] * self.points.volume[v] * pair.factor;
            sum += stress * pair.separation * weight;
        }
        for contact in at.contacts {
            sum -= stress * contact.gradient * 2.0;
        }
        let per_mass = self.volume[i] / self.mass[i];
        rates.acceleration += sum * (per_mass * at.inverse_renormalisation);
    }
}
