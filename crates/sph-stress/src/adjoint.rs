//! The force of a stress as the adjoint of a corrected velocity gradient.

use std::sync::Arc;

use nalgebra::SMatrix;
use sph_core::{Access, Declares, Stage, StepError, Vect, fields};
use sph_neighbours::{
    BoundTerm, Contact, Interaction, Lane, LanePair, LanePairTerm, LaneSum, LaneTerm, Lanewise,
    Neighbourhood, Pair, Rates, There, World, dot, scaled, splat, vector, walk_in_lanes,
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
        let correction = |mut position: SMatrix<f64, D, D>, rows: &Neighbourhood<'_, D>| {
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
        let free = FreePositions { volume };
        walk_in_lanes(world, &free, |_| true, &mut corrections, correction)?;
        Ok(world.free.put(fields::STRESS_CORRECTION, corrections)?)
    }
}

/// −Σ V r ⊗ ∇w of free neighbours.
struct FreePositions<'a> {
    volume: &'a [f64],
}

impl<const D: usize> LaneSum<D> for FreePositions<'_> {
    type Here = ();
    type Sum = SMatrix<f64, D, D>;
    type Side<L: Lane> = ();
    type Sums<L: Lane> = [[L; D]; D];

    #[inline(always)]
    fn here(&self, _: usize) {}
    #[inline(always)]
    fn side<L: Lane>(&self, _: &[()]) {}
    #[inline(always)]
    fn zero<L: Lane>(&self) -> [[L; D]; D] {
        [[L::splat(0.0); D]; D]
    }
    #[inline(always)]
    fn lane<L: Lane>(&self, sums: &[[L; D]; D], lane: usize) -> SMatrix<f64, D, D> {
        let mut sum = SMatrix::zeros();
        for i in 0..D {
            for k in 0..D {
                sum[(i, k)] = sums[i][k].at(lane);
            }
        }
        sum
    }
    #[inline(always)]
    fn add<L: Lane>(
        &self,
        _: &(),
        j: usize,
        pair: &LanePair<D, L>,
        _value: L,
        sums: &mut [[L; D]; D],
    ) {
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

impl AdjointDivergence {
    /// As a term of a sweep.
    pub fn boxed<const D: usize>() -> Box<dyn Interaction<D>> {
        Box::new(Lanewise(AdjointDivergence))
    }
}

impl<const D: usize> LanePairTerm<D> for AdjointDivergence {
    type Bound<'a> = Bound<'a, D>;

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

    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Bound<'a, D>, StepError> {
        let stress = world.free.get(fields::CARRIED_STRESS)?;
        let correction = world.free.get(fields::STRESS_CORRECTION)?;
        let both = stress.iter().zip(correction);
        let points = &world.walls.points;
        Ok(Bound {
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
        })
    }
}

/// [`AdjointDivergence`] with its columns.
pub struct Bound<'a, const D: usize> {
    /// τCᵀ.
    stress: Vec<SMatrix<f64, D, D>>,
    volume: &'a [f64],
    mass: &'a [f64],
    wall_volume: &'a [f64],
    wall_share: &'a [f64],
}

/// The particle's own values.
#[derive(Clone, Copy)]
pub struct Here<const D: usize> {
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
        self.add_one(here, j, there, pair, sum);
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

impl<const D: usize> LaneTerm<D> for Bound<'_, D> {
    /// τCᵀ.
    type Side<L: Lane> = [[L; D]; D];
    type Sums<L: Lane> = [L; D];

    #[inline(always)]
    fn side<L: Lane>(&self, here: &[Here<D>]) -> [[L; D]; D] {
        let mut side = [[L::splat(0.0); D]; D];
        for (lane, own) in here.iter().enumerate() {
            for (i, row) in side.iter_mut().enumerate() {
                for (k, stress) in row.iter_mut().enumerate() {
                    stress.set(lane, own.stress[(i, k)]);
                }
            }
        }
        side
    }

    #[inline(always)]
    fn sums<L: Lane>(&self, sum: &Vect<D>) -> [L; D] {
        splat(sum)
    }

    #[inline(always)]
    fn lane<L: Lane>(&self, sums: &[L; D], lane: usize) -> Vect<D> {
        vector(sums, lane)
    }

    #[inline(always)]
    fn add<L: Lane>(
        &self,
        here: &[[L; D]; D],
        j: usize,
        there: &There<D>,
        pair: &LanePair<D, L>,
        sums: &mut [L; D],
    ) {
        let weight = L::splat(there.volume) * pair.factor;
        for (i, (sum, own)) in sums.iter_mut().zip(here).enumerate() {
            let mut row = *own;
            for (k, stress) in row.iter_mut().enumerate() {
                *stress += L::splat(self.stress[j][(i, k)]);
            }
            *sum += dot(&row, &pair.separation) * weight;
        }
    }
}
