//! The velocity gradient and the magnitude of the strain rate, by stages and by a term of the sweep.

use std::sync::Arc;

use nalgebra::SMatrix;
use rayon::prelude::*;
use sph_core::{Access, Declares, Stage, StepError, Symmetric, Vect, fields, stage};
use sph_neighbours::{
    Lane, LanePair, Neighbourhood, Particles, Rates, WallSet, World, pair_sum, pair_term, scaled,
    walk_in_lanes,
};
use sph_rheology::Gradient;

use crate::stress::VelocityGradient;
use crate::stress::gathered::{Gathered, LaneSums};

/// [`VELOCITY_GRADIENT`](fields::VELOCITY_GRADIENT) by a formula.
///
/// All phases count. Walls that do not rub take part in the gradient of the component normal to them alone.
#[derive(Clone)]
pub struct GradientStage<const D: usize> {
    /// The formula.
    pub formula: Arc<dyn VelocityGradient<D>>,
    /// By phase number, whose gradients are read; those of the others are zero. All, if left out.
    pub phases: Option<Arc<[bool]>>,
}

impl<const D: usize> Declares for GradientStage<D> {
    fn name(&self) -> String {
        "velocity gradient".into()
    }
    fn access(&self) -> Access {
        Access::none()
            .both((fields::POSITION, fields::VELOCITY))
            .neighbours(fields::VOLUME)
            .writes(fields::VELOCITY_GRADIENT)
            .here(self.phases.as_ref().map(|_| fields::PHASE))
    }
}

impl<const D: usize> Stage<World<D>> for GradientStage<D> {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let mut gradients = world.free.take(fields::VELOCITY_GRADIENT)?;
        let phase = self.phases.as_ref().map(|_| fields::PHASE);
        let read = self.phases.as_ref().zip(world.free.all(phase)?);
        if read.is_some() {
            gradients.fill(SMatrix::zeros());
        }
        let wanted = |i: usize| read.is_none_or(|(phases, of)| phases[of[i] as usize]);
        let all = BoundGradient {
            formula: &*self.formula,
            velocity: world.free.get(fields::VELOCITY)?,
            volume: world.free.get(fields::VOLUME)?,
            walls: &world.walls,
            // Of the term alone.
            slot: 0,
        };
        walk_in_lanes(world, &all, wanted, &mut gradients, |free, at| {
            all.gradient(free, at)
        })?;
        Ok(world.free.put(fields::VELOCITY_GRADIENT, gradients)?)
    }
}

/// A gradient in the plane, or in space, as one in space.
pub(crate) fn in_space<const D: usize>(gradient: &SMatrix<f64, D, D>) -> Gradient {
    let at = |i, j| match i < D && j < D {
        true => gradient[(i, j)],
        false => 0.0,
    };
    std::array::from_fn(|i| std::array::from_fn(|j| at(i, j)))
}

/// γ̇ of a gradient, 1/s.
#[inline]
pub(crate) fn magnitude<const D: usize>(gradient: &SMatrix<f64, D, D>) -> f64 {
    let strain = Symmetric::part_of(in_space(gradient)).deviator();
    (2.0 * strain.contract(&strain)).sqrt()
}

/// [`STRAIN_RATE`](fields::STRAIN_RATE) γ̇ = √(2 D:D) with the deviatoric D = ½(G + Gᵀ) − ⅓ tr(G) I, out of the plane
/// included.
///
/// Source: Ghaïtanellis 2017, Eq. 4.6 and 4.88.
pub(crate) fn strain_rates<const D: usize>() -> impl Stage<World<D>> {
    let access = Access::none()
        .here(fields::VELOCITY_GRADIENT)
        .writes(fields::STRAIN_RATE);
    stage("strain rate", access, set_strain_rates)
}

pub(crate) fn set_strain_rates<const D: usize>(world: &mut World<D>) -> Result<(), StepError> {
    let mut rate = world.free.take(fields::STRAIN_RATE)?;
    let gradient = world.free.get(fields::VELOCITY_GRADIENT)?;
    let all = rate.par_iter_mut().zip(gradient).with_min_len(2048);
    all.for_each(|(rate, g)| *rate = magnitude(g));
    Ok(world.free.put(fields::STRAIN_RATE, rate)?)
}

/// [`STRAIN_RATE`](fields::STRAIN_RATE) along with the interactions, for terms that read it after them: the walk over
/// the neighbours, their distances and the gradients of the kernel are there already.
#[derive(Clone)]
pub(crate) struct StrainRateTerm<const D: usize> {
    pub formula: Arc<dyn VelocityGradient<D>>,
}

#[pair_term(StrainRateTerm<D>, "strain rate")]
pub(crate) struct BoundGradient<'a, const D: usize> {
    #[value(&*self.formula)]
    formula: &'a dyn VelocityGradient<D>,
    #[both(fields::VELOCITY)]
    velocity: &'a [Vect<D>],
    #[neighbours(fields::VOLUME)]
    volume: &'a [f64],
    #[value(&world.walls)]
    walls: &'a WallSet<D>,
    #[rate(fields::STRAIN_RATE)]
    slot: usize,
}

#[pair_sum]
impl<const D: usize> BoundGradient<'_, D> {
    fn own<L: Lane>(&self, all: Particles) -> [L; D] {
        all.vectors(self.velocity)
    }
    fn pair<L: Lane>(
        &self,
        own: &[L; D],
        j: usize,
        pair: &LanePair<D, L>,
        [of_velocities, of_positions]: &mut LaneSums<L, D>,
    ) {
        let velocity = &self.velocity[j];
        let share = L::splat(self.volume[j]) * pair.factor;
        let weight = scaled(pair.separation, share);
        for i in 0..D {
            let rise = L::splat(velocity[i]) - own[i];
            for k in 0..D {
                of_velocities[i][k] += rise * weight[k];
                of_positions[i][k] -= pair.separation[i] * weight[k];
            }
        }
    }

    fn finish(&self, free: LaneSums<f64, D>, at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        rates.more[self.slot] += magnitude(&self.gradient(free, at));
    }

    fn gradient(&self, free: LaneSums<f64, D>, at: &Neighbourhood<'_, D>) -> SMatrix<f64, D, D> {
        let gathered = Gathered::new(free, &self.velocity[at.particle], self.walls, at);
        gathered.gradient(self.formula, at.inverse_renormalisation)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix2, Matrix3};

    use super::*;

    /// γ̇ of simple shear is its rate; a rigid rotation has none. What is compressed in the plane is drawn out of it.
    #[test]
    fn it_is_that_of_known_flows() {
        let rate = 3.0;
        let shear = Matrix2::new(0.0, rate, 0.0, 0.0);
        assert!((magnitude(&shear) - rate).abs() < 1e-15);
        assert_eq!(magnitude(&Matrix2::new(0.0, rate, -rate, 0.0)), 0.0);
        let pure = Matrix2::new(rate, 0.0, 0.0, -rate);
        assert!((magnitude(&pure) - 2.0 * rate).abs() < 1e-15);
        // D′ = a diag(1, 1, −2)/3: 2 D′:D′ = 4a²/3.
        let even = Matrix2::identity() * rate;
        assert!((magnitude(&even) - rate * (4.0_f64 / 3.0).sqrt()).abs() < 1e-15);
        assert!(magnitude(&(Matrix3::identity() * rate)) < 1e-15, "in space");
    }

    #[test]
    fn it_is_the_same_in_every_frame() {
        let gradient = Matrix3::new(0.3, 1.0, -2.0, 0.5, -0.7, 4.0, -1.0, 2.0, 0.25);
        let turn = nalgebra::Rotation3::from_euler_angles(0.4, -1.1, 2.0).into_inner();
        let turned = turn * gradient * turn.transpose();
        assert!((magnitude(&turned) / magnitude(&gradient) - 1.0).abs() < 1e-14);
        assert_eq!(in_space(&gradient)[0], [0.3, 1.0, -2.0], "rows");
    }
}
