//! The formulation of Colagrossi and Landrini.

use rayon::prelude::*;
use sph_contribution::Stages;
use sph_core::{Access, Evolved, Stage, fields, plugin, stage};
use sph_neighbours::{Interaction, World};

use crate::divergence::{Divergence, NeighbourVolume};
use crate::gradient::{PressureGradient, SumOfPressures};
use crate::{Compressed, Diffused, Formulation, FormulationEntry};

/// dρ_a/dt = −ρ_a D_a{u}, V = m/ρ, with
/// D_a{u} = −1/γ_a [Σ_b θ_b V_b u_ab·∇w_ab − Σ_s u_as·∇γ_as] and its adjoint
/// G_a{p} = 1/γ_a [Σ_b θ_b V_b (p_a + p_b) ∇w_ab − Σ_s (p_a + p_s) ∇γ_as].
///
/// Density is integrated, so a free surface needs nothing; in return it drifts with the error of
/// the time scheme. One more walk over the neighbours per drift (at its middle), none for the
/// density.
///
/// Source: Ghaïtanellis 2017, Eq. 3.2–3.5; Colagrossi & Landrini 2003; walls as in Eq. 2.75 with
/// k = 0.
#[plugin(FormulationEntry [2, 3], "colagrossi-landrini",
    "integrated densities, volumes as weights; simple and robust at free surfaces",
    source: "Ghaïtanellis 2017, Eq. 3.2–3.5; Colagrossi & Landrini 2003", cfg(not(test)))]
pub struct ColagrossiLandrini {}

impl<const D: usize> Formulation<D> for ColagrossiLandrini {
    fn diffused(&self) -> Diffused {
        integrated_density()
    }
    fn compressed(&self) -> Option<Compressed> {
        Some(compressed_density())
    }
    fn stages(&self) -> Stages<D> {
        vec![Box::new(volumes())]
    }
    fn pressure_term(&self) -> Box<dyn Interaction<D>> {
        PressureGradient::boxed(SumOfPressures)
    }
    fn divergence(&self) -> Box<dyn Interaction<D>> {
        Divergence::boxed(NeighbourVolume)
    }
}

/// Density diffusion of a formulation that integrates the density itself.
pub(crate) fn integrated_density() -> Diffused {
    Diffused {
        evolved: Evolved {
            value: fields::DENSITY,
            rate: fields::DENSITY_RATE,
        },
        per_density: |_, _, _| 1.0,
    }
}

/// d ln ρ/dt = −D{u}.
pub(crate) fn compressed_density() -> Compressed {
    Compressed {
        value: fields::DENSITY,
        exponent: -1.0,
    }
}

/// V = m/ρ.
pub(crate) fn volumes<const D: usize>() -> impl Stage<World<D>> {
    let access = Access::none()
        .here((fields::MASS, fields::DENSITY))
        .writes(fields::VOLUME);
    stage("volume", access, |world: &mut World<D>| {
        let mut volume = world.free.take(fields::VOLUME)?;
        let (mass, density) = world.free.all((fields::MASS, fields::DENSITY))?;
        let all = volume
            .par_iter_mut()
            .zip(mass)
            .zip(density)
            .with_min_len(2048);
        all.for_each(|((v, m), rho)| *v = m / rho);
        Ok(world.free.put(fields::VOLUME, volume)?)
    })
}
