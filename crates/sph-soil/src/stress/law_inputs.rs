//! Inputs of the laws of a scene, as columns and phase by phase.

use std::ops::Range;

use sph_contribution::{ParticleEnergy, StoredEnergy};
use sph_core::{Access, Field, Index, Scalar, StepError, Symmetric, fields, parameters};
use sph_neighbours::{World, by_phase};
use sph_rheology::{Inputs, Rheology, Yielding};

use crate::stress::Rheologies;

type OptionalColumns = (
    Option<Field<Index>>,
    Option<Field<Scalar>>,
    Option<Field<Scalar>>,
);

/// The laws with the pressure that makes friction for them, and what they blend.
#[derive(Clone)]
pub struct LawInputs {
    /// The laws.
    pub laws: Rheologies,
    /// The pressure that makes friction.
    pub pressure: Field<Scalar>,
    /// The blended values where a material yields.
    pub blend: Blend,
}

impl LawInputs {
    /// True if some law reads the strain rate.
    pub fn strain_rate(&self) -> bool {
        self.laws.iter().any(|l| l.needs().strain_rate)
    }

    /// Phases, strain rates and pressures, as far as the laws need them.
    fn columns(&self) -> OptionalColumns {
        let feels_pressure = self.laws.iter().any(|l| l.needs().pressure);
        (
            (self.laws.len() > 1).then_some(fields::PHASE),
            self.strain_rate().then_some(fields::STRAIN_RATE),
            feels_pressure.then_some(self.pressure),
        )
    }

    pub(crate) fn access(&self) -> Access {
        Access::none().here(self.columns())
    }

    /// Gives every run of particles of one phase to `work`, with their law and its inputs; slices of columns
    /// that no law needs are empty.
    pub(crate) fn each<const D: usize, T: Send>(
        &self,
        world: &World<D>,
        column: &mut [T],
        work: impl Fn(&dyn Rheology, &Inputs<'_>, Range<usize>, &mut [T]) + Sync,
    ) -> Result<(), StepError> {
        let (phase, strain_rate, pressure) = world.free.all(self.columns())?;
        by_phase(phase, column, |law, run, part| {
            let inputs = Inputs {
                strain_rate: strain_rate.map_or(&[], |rates| &rates[run.clone()]),
                pressure: pressure.map_or(&[], |pressures| &pressures[run.clone()]),
            };
            work(&*self.laws[law], &inputs, run, part);
        });
        Ok(())
    }

    /// Yielding of all particles with these stresses; that of a solid without an elastic part.
    pub(crate) fn yielding<const D: usize>(
        &self,
        world: &World<D>,
        stress: &[Symmetric],
        yielding: &mut Vec<Yielding>,
    ) -> Result<(), StepError> {
        yielding.clear();
        yielding.resize(stress.len(), Yielding::NONE);
        self.each(world, yielding, |law, inputs, run, out| {
            if let Some(elastic) = law.elastic() {
                elastic.yielding(inputs, &stress[run], out);
            }
        })
    }
}

impl<const D: usize> StoredEnergy<D> for LawInputs {
    /// V τ:τ/4𝒢.
    fn energy<'a>(&'a self, world: &'a World<D>) -> Option<ParticleEnergy<'a>> {
        let free = &world.free;
        let stress = free.get(fields::ELASTIC_STRESS).ok()?;
        let mass = free.get(fields::MASS).ok()?;
        let density = free.get(fields::DENSITY).ok()?;
        let phase = free.get(fields::PHASE).ok();
        Some(Box::new(move |i| {
            let law = &self.laws[phase.map_or(0, |p| p[i] as usize)];
            let modulus = law.elastic().map(|e| e.shear_modulus());
            let volume = mass[i] / density[i];
            modulus.map_or(0.0, |g| volume * stress[i].contract(&stress[i]) / (4.0 * g))
        }))
    }
}

/// Blended quantities where a soil yields from a solid to a liquid.
#[parameters]
pub enum Blend {
    /// div(ζτ_l + (1 − ζ)τ_s): a stress, so that action is reaction.
    #[default]
    Stresses,
    /// ζ_a f_l + (1 − ζ_a) f_s, as printed: action is not reaction where ζ < 1. What water rubs off the soil is left
    /// out of the blend. Not with an implicit viscosity.
    Forces,
}
