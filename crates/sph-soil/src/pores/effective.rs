//! The effective pressure of a soil whose pores are not at rest, and the plastic share of its strain rate.

use sph_core::{Access, Declares, Stage, StepError, fields};
use sph_neighbours::World;
use sph_rheology::Yielding;

use super::contract::{
    DRAINED_PRESSURE, EXCESS_PORE_PRESSURE, FRICTION_PRESSURE, PACKING, SoilPhase,
};
use crate::dilatancy::{Dilatancy, GrainState};
use crate::stress::LawInputs;

/// p' = max(p'_d + q − p_e, 0) with the load q, Pa.
pub(crate) struct GrainPressure {
    pub soil: SoilPhase,
    /// q, Pa.
    pub load: f64,
}

impl Declares for GrainPressure {
    fn name(&self) -> String {
        "pressure between grains".into()
    }
    fn access(&self) -> Access {
        self.soil
            .access()
            .here(DRAINED_PRESSURE)
            .here(EXCESS_PORE_PRESSURE)
            .writes(fields::EFFECTIVE_PRESSURE)
    }
}

impl<const D: usize> Stage<World<D>> for GrainPressure {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let mut effective = world.free.take(fields::EFFECTIVE_PRESSURE)?;
        let drained = world.free.get(DRAINED_PRESSURE)?;
        let excess = world.free.get(EXCESS_PORE_PRESSURE)?;
        let soil = self.soil.mask(world)?;
        for (i, p) in effective.iter_mut().enumerate() {
            *p = match soil.has(i) {
                true => (drained[i] + self.load - excess[i]).max(0.0),
                false => drained[i],
            };
        }
        Ok(world.free.put(fields::EFFECTIVE_PRESSURE, effective)?)
    }
}

/// p' (1 + tan ψ/μ): the pressure at which a friction of μ is one of μ + tan ψ.
pub(crate) struct DilatantFriction {
    pub soil: SoilPhase,
    pub law: std::sync::Arc<dyn Dilatancy>,
    /// μ of slow flow.
    pub friction: f64,
}

impl Declares for DilatantFriction {
    fn name(&self) -> String {
        "friction of dilation".into()
    }
    fn access(&self) -> Access {
        self.soil
            .access()
            .here(fields::EFFECTIVE_PRESSURE)
            .here(fields::STRAIN_RATE)
            .here(PACKING)
            .writes(FRICTION_PRESSURE)
    }
}

impl<const D: usize> Stage<World<D>> for DilatantFriction {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let mut out = world.free.take(FRICTION_PRESSURE)?;
        let effective = world.free.get(fields::EFFECTIVE_PRESSURE)?;
        let strain_rate = world.free.get(fields::STRAIN_RATE)?;
        let packing = world.free.get(PACKING)?;
        let soil = self.soil.mask(world)?;
        for (i, out) in out.iter_mut().enumerate() {
            *out = effective[i];
            if !soil.has(i) {
                continue;
            }
            let state = GrainState {
                packing: packing[i],
                strain_rate: strain_rate[i],
                pressure: effective[i],
            };
            let angle = self.law.friction(&state);
            *out *= (1.0 + angle / self.friction).max(0.0);
        }
        Ok(world.free.put(FRICTION_PRESSURE, out)?)
    }
}

/// Plastic shares of soils with an elastic part: strain that the skeleton takes back moves no grain past another.
///
/// The share is 1 where the remembered stress reaches the yield stress within 1 %, and that of the liquid elsewhere.
pub(crate) struct PlasticShare(pub LawInputs);

/// Share of the yield stress from which a material yields.
const YIELDS: f64 = 0.99;

impl PlasticShare {
    /// The columns that it reads.
    pub fn access(&self) -> Access {
        self.0.access().here(fields::ELASTIC_STRESS)
    }

    /// Plastic shares of all particles.
    pub fn shares<const D: usize>(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let stress = world.free.get(fields::ELASTIC_STRESS)?;
        let stress: Vec<_> = stress.iter().map(|t| *t * (1.0 / YIELDS)).collect();
        let mut yielding = Vec::new();
        self.0.yielding(world, &stress, &mut yielding)?;
        let share = |y: &Yielding| if y.held < 1.0 { 1.0 } else { y.friction };
        Ok(yielding.iter().map(share).collect())
    }
}
