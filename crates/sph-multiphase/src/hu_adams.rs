//! The volume formulation of Hu and Adams with semi-analytical walls and free surfaces.

use rayon::prelude::*;
use sph_core::{Access, Evolved, Stage, StepError, fields, plugin, stage};
use sph_neighbours::{Interaction, World, kernel_sums};

use crate::divergence::{Divergence, OwnVolume, SumVolume};
use crate::gradient::{PressureGradient, SquaredVolumes};
use crate::{Compressed, Diffused, Formulation, FormulationEntry};
use sph_contribution::Stages;

/// Density from volumes, ρ_a = (K_a + m_a Σ_b θ_b w_ab)/γ_a, with the skew-adjoint gradient
/// G_a = 1/(γ_a V_a) [Σ_b θ_b (p_aV_a² + p_bV_b²) ∇w_ab − Σ_s (p_aV_a² + p_sV_s²)/V_s ∇γ_as].
///
/// K_a = γ_aρ_a − m_aΣθw is fixed at the start and holds the free-surface deficit; it changes
/// by density diffusion alone, so the density has no drift. With one phase and no wall the
/// formulation is the classical single-fluid one. A particle that tore off alone sums m w(0) + K, 0.14 ρ₀ or less:
/// `[surface.cone-test]` gives it ρ₀, and the guard stops a run with a density below its bounds.
///
/// Source: Ghaïtanellis 2017, Eq. 3.24–3.25 in the telescoped form.
#[plugin(FormulationEntry [2, 3], "hu-adams", "volume-based densities, exact for several phases and with free surfaces",
    source: "Ghaïtanellis 2017, Eq. 3.24–3.26; Hu & Adams 2006", cfg(not(test)))]
pub struct HuAdams {}

impl<const D: usize> Formulation<D> for HuAdams {
    fn diffused(&self) -> Diffused {
        Diffused {
            evolved: Evolved {
                value: fields::DENSITY_CONSTANT,
                rate: fields::DENSITY_CONSTANT_RATE,
            },
            per_density: |_, _, gamma| gamma,
        }
    }
    fn compressed(&self) -> Option<Compressed> {
        None
    }
    fn stages(&self) -> Stages<D> {
        vec![Box::new(density_sum())]
    }
    fn pressure_term(&self) -> Box<dyn Interaction<D>> {
        PressureGradient::boxed(SquaredVolumes)
    }
    fn divergence(&self) -> Box<dyn Interaction<D>> {
        Divergence::boxed(OwnVolume)
    }
    fn dilatation(&self) -> Box<dyn Interaction<D>> {
        Divergence::boxed(SumVolume)
    }
    fn rebase(&self, world: &mut World<D>) -> Result<(), StepError> {
        let mut constant = world.free.take(fields::DENSITY_CONSTANT)?;
        kernel_sums(world, &mut constant)?;
        let (mass, density) = world.free.all((fields::MASS, fields::DENSITY))?;
        let gamma = world.sum_renormalisation();
        for (i, k) in constant.iter_mut().enumerate() {
            *k = gamma.map_or(1.0, |g| g[i]) * density[i] - mass[i] * *k;
        }
        Ok(world.free.put(fields::DENSITY_CONSTANT, constant)?)
    }
}

/// ρ = (K + m Σθw)/γ and V = m/ρ.
fn density_sum<const D: usize>() -> impl Stage<World<D>> {
    let access = Access::none()
        .both(fields::POSITION)
        .here((fields::MASS, fields::DENSITY_CONSTANT))
        .writes((fields::DENSITY, fields::VOLUME));
    stage("density sum", access, |world: &mut World<D>| {
        let mut density = world.free.take(fields::DENSITY)?;
        let mut volume = world.free.take(fields::VOLUME)?;
        kernel_sums(world, &mut density)?;
        let (mass, constant) = world.free.all((fields::MASS, fields::DENSITY_CONSTANT))?;
        let gamma = world.sum_renormalisation();
        let both = density.par_iter_mut().zip(&mut volume).enumerate();
        both.with_min_len(1024).for_each(|(i, (rho, v))| {
            *rho = (constant[i] + mass[i] * *rho) / gamma.map_or(1.0, |g| g[i]);
            *v = mass[i] / *rho;
        });
        world.free.put(fields::DENSITY, density)?;
        Ok(world.free.put(fields::VOLUME, volume)?)
    })
}
