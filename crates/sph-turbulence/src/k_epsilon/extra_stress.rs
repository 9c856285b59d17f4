//! The part of algebraic stresses that is not along the strain.

use rayon::prelude::*;
use sph_core::{Access, Stage, Symmetric, fields, stage};
use sph_neighbours::World;

use super::earsm::AlgebraicStress;
use crate::columns::{DISSIPATION, EDDY_STRESS, TURBULENT_ENERGY};

/// [`EDDY_STRESS`] −ρ k β_4 (S*Ω* − Ω*S*): normal stresses that differ, which drive secondary flows. It does no work on
/// the mean flow. Nothing where k and ε are not known.
///
/// Source: Wallin and Johansson 2000, Eq. 3.9.
pub(crate) fn extra_stress<const D: usize>() -> impl Stage<World<D>> {
    let access = Access::none()
        .here((fields::DENSITY, fields::VELOCITY_GRADIENT))
        .here((TURBULENT_ENERGY, DISSIPATION))
        .writes(EDDY_STRESS);
    stage("stress of eddies", access, |world: &mut World<D>| {
        let mut stresses = world.free.take(EDDY_STRESS)?;
        let density = world.free.get(fields::DENSITY)?;
        let gradients = world.free.get(fields::VELOCITY_GRADIENT)?;
        let (energy, dissipation) = world.free.all((TURBULENT_ENERGY, DISSIPATION))?;
        let all = stresses.par_iter_mut().enumerate().with_min_len(512);
        all.for_each(|(i, stress)| {
            let (k, e) = (energy[i], dissipation[i]);
            *stress = match e > 0.0 {
                true => {
                    Symmetric::part_of(AlgebraicStress::anisotropy(&gradients[i], k / e).across)
                        * (-density[i] * k)
                }
                false => Symmetric::ZERO,
            };
        });
        Ok(world.free.put(EDDY_STRESS, stresses)?)
    })
}
