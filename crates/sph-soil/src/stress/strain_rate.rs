//! The magnitude of the strain rate.

use nalgebra::{Matrix3, SMatrix};
use rayon::prelude::*;
use sph_core::{Access, Declares, Stage, StepError, Symmetric, fields};
use sph_neighbours::World;

/// γ̇ = √(2 D:D) with the deviatoric D = ½(G + Gᵀ) − ⅓ tr(G) I, out of the plane included.
///
/// Source: Ghaïtanellis 2017, Eq. 4.6 and 4.88.
pub struct StrainRate;

/// A gradient in the plane, or in space, as one in space.
pub fn in_space<const D: usize>(gradient: &SMatrix<f64, D, D>) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| {
        if i < D && j < D {
            gradient[(i, j)]
        } else {
            0.0
        }
    })
}

/// γ̇ of a gradient, 1/s.
#[inline]
pub(crate) fn magnitude<const D: usize>(gradient: &SMatrix<f64, D, D>) -> f64 {
    let strain = Symmetric::part_of(&in_space(gradient)).deviator();
    (2.0 * strain.contract(&strain)).sqrt()
}

impl Declares for StrainRate {
    fn name(&self) -> String {
        "strain rate".into()
    }
    fn access(&self) -> Access {
        Access::none()
            .here(fields::VELOCITY_GRADIENT)
            .writes(fields::STRAIN_RATE)
    }
}

impl<const D: usize> Stage<World<D>> for StrainRate {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let mut rate = world.free.take(fields::STRAIN_RATE)?;
        let gradient = world.free.get(fields::VELOCITY_GRADIENT)?;
        let all = rate.par_iter_mut().zip(gradient).with_min_len(2048);
        all.for_each(|(rate, g)| *rate = magnitude(g));
        Ok(world.free.put(fields::STRAIN_RATE, rate)?)
    }
}
