//! The traits of formulations and interface models, and the stage that applies the equations of state.

use rayon::prelude::*;
use sph_contribution::{Contribution, Limiter, Offer, Refusal, Setting, Stages, contribution_kind};
use sph_core::{Access, Evolved, Field, Scalar, Stage, StepError, Work, contract, fields, stage};
use sph_neighbours::{Interaction, World, by_phase};
use sph_rheology::state::Laws;

/// Density diffusion in the terms of a formulation.
#[derive(Clone, Copy)]
pub struct Diffused {
    /// The integrated scalar and its rate.
    pub evolved: Evolved,
    /// d(value)/dρ from density, volume and γ.
    pub per_density: fn(density: f64, volume: f64, gamma: f64) -> f64,
}

/// A scalar that motion compresses: d ln(value)/dt = exponent · D{u}.
#[derive(Clone, Copy)]
pub struct Compressed {
    /// The integrated scalar.
    pub value: Field<Scalar>,
    /// −1 for a density, 1 for a volume.
    pub exponent: f64,
}

/// The definition of density and the pressure gradient that belongs to it.
///
/// By default it integrates the density, d ln ρ/dt = −D{u}, and V = m/ρ.
pub trait Formulation<const D: usize>: Send + Sync {
    /// The scalar it integrates in time, which density diffusion changes.
    fn diffused(&self) -> Diffused {
        Diffused {
            evolved: Evolved {
                value: fields::DENSITY,
                rate: fields::DENSITY_RATE,
            },
            per_density: |_, _, _| 1.0,
        }
    }
    /// The scalar that drifts with the divergence, for formulations that integrate continuity.
    fn compressed(&self) -> Option<Compressed> {
        Some(Compressed {
            value: fields::DENSITY,
            exponent: -1.0,
        })
    }
    /// The stages that give density and volume at the present state.
    fn stages(&self) -> Stages<D> {
        vec![Box::new(volumes())]
    }
    /// The pressure term of the interaction sweep.
    fn pressure_term(&self) -> Box<dyn Interaction<D>>;
    /// D{u}, the divergence that belongs to the pressure gradient, as the scalar of [`Rates`](sph_neighbours::Rates),
    /// 1/s. With Σ over particles and without walls, Σ V p D{u} = −Σ V u·G{p}.
    fn divergence(&self) -> Box<dyn Interaction<D>>;
    /// −D lnρ/Dt by motion, 1/s, as the densities follow it: D{u} by default.
    fn dilatation(&self) -> Box<dyn Interaction<D>> {
        self.divergence()
    }
    /// True if its sums follow walls that scale the kernel.
    fn is_scaled(&self) -> bool {
        true
    }
    /// Sets the evolved scalars so that the stages return the density column as it is: nothing where that is evolved.
    ///
    /// Called at the start, and again whenever the sum changes for another reason than motion.
    ///
    /// # Errors
    /// If a column is missing.
    fn rebase(&self, _world: &mut World<D>) -> Result<(), StepError> {
        Ok(())
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
        let all = volume.par_iter_mut().zip(mass).zip(density);
        let all = all.with_min_len(2048);
        all.for_each(|((v, m), rho)| *v = m / rho);
        Ok(world.free.put(fields::VOLUME, volume)?)
    })
}

contract!(
    /// A formulation that a scene may name.
    pub FormulationEntry, "formulation", One, "density and the pressure gradient that belongs to it",
    Formulation<D>, .by_default("hu-adams").ordered(10).works(Work::Pressure)
);

/// Input of a [`PressureScheme`].
pub struct Acting<const D: usize> {
    /// The stage that applies the equations of state.
    pub state: Box<dyn Stage<World<D>>>,
    /// These, in the order of the phase numbers.
    pub laws: Laws,
    /// −D lnρ/Dt by motion, 1/s, as [`Formulation::dilatation`].
    pub dilatation: Box<dyn Interaction<D>>,
    /// True if the scene chooses a finder of free surfaces; [`FREE_SURFACE`](crate::FREE_SURFACE) is then there.
    pub surfaces: bool,
}

/// The pressure that acts in a step, where it is not that of the equation of state at its beginning.
pub trait PressureScheme<const D: usize>: Send + Sync {
    /// The stage that writes [`PRESSURE`](sph_core::fields::PRESSURE); it finds there that of the step before.
    fn stage(&self, acting: Acting<D>) -> Box<dyn Stage<World<D>>>;
    /// Bounds on the step, in the place of those of sound.
    fn limiters(&self, setting: &Setting<'_, D>) -> Vec<Box<dyn Limiter<D>>>;
}

contract!(
    /// A pressure scheme that a scene may name.
    pub PressureEntry, "pressure", One, "which pressure acts in a step", PressureScheme<D>,
    .absent("that of the equation of state if left out")
);

contribution_kind!(
    /// An interface model that a scene may name: a force where phases meet.
    pub InterfaceEntry, "interface", Any, "a force where phases meet", .ordered(80).works(Work::Others)
);

/// Offers the term of an interface model, which may read the phase column, and a remedy.
///
/// # Errors
/// If the scene has one phase.
pub fn offer_interface<const D: usize>(
    term: Box<dyn Interaction<D>>,
    setting: &Setting<'_, D>,
    offer: &mut Offer<D>,
) -> Result<(), Refusal> {
    if setting.phases.len() <= 1 {
        let why = "the scene has one phase, and interfaces are between two: take this table out, or add a phase";
        return Err(Refusal::at_key("interface", "", why));
    }
    offer.terms.push(term);
    offer.remedy = Some(format!("lower the coefficients of {}", offer.path));
    Ok(())
}

/// The stage of p = p(ρ) or p(ρ, γ̇), phase by phase, with the laws in the order of the phase numbers.
///
/// One virtual call per run of particles of the same phase.
pub fn equations_of_state<const D: usize>(laws: Laws) -> impl Stage<World<D>> {
    let sheared = laws.iter().any(|law| law.needs_strain_rate());
    let several = laws.len() != 1;
    let mut access = Access::none()
        .here(fields::DENSITY)
        .writes(fields::PRESSURE);
    if sheared {
        access = access.here(fields::STRAIN_RATE);
    }
    if several {
        access = access.here(fields::PHASE);
    }
    stage("equation of state", access, move |world: &mut World<D>| {
        let mut pressure = world.free.take(fields::PRESSURE)?;
        let density = world.free.get(fields::DENSITY)?;
        let strain_rate = sheared.then(|| world.free.get(fields::STRAIN_RATE));
        let strain_rate = strain_rate.transpose()?.unwrap_or_default();
        let phase = several.then(|| world.free.get(fields::PHASE)).transpose()?;
        by_phase(phase, &mut pressure, |law, run, pressure| {
            // Without the column all slices of it are empty.
            let rate = strain_rate.get(run.clone()).unwrap_or_default();
            laws[law].sheared_pressure(&density[run], rate, pressure);
        });
        Ok(world.free.put(fields::PRESSURE, pressure)?)
    })
}
