//! The effective pressure of a soil whose pores are not at rest, and the plastic share of its strain rate.

use std::sync::Arc;

use sph_core::{Access, Stage, StepError, fields};
use sph_neighbours::{World, column_stage};
use sph_rheology::Yielding;

use crate::dilatancy::{Dilatancy, GrainState};
use crate::pores::{DRAINED_PRESSURE, EXCESS_PORE_PRESSURE, FRICTION_PRESSURE, PACKING, PhaseMask};
use crate::stress::LawInputs;

/// p' = max(p'_d + q − p_e, 0) with the load q, Pa.
pub(crate) fn grain_pressure<const D: usize>(phase: PhaseMask, load: f64) -> impl Stage<World<D>> {
    let pressures = (DRAINED_PRESSURE, EXCESS_PORE_PRESSURE);
    let access = Access::none().both(phase.column()).here(pressures);
    let (name, field) = ("pressure between grains", fields::EFFECTIVE_PRESSURE);
    column_stage::<D, _>(name, access, field, move |world, effective| {
        let (drained, excess) = world.free.all(pressures)?;
        let soil = phase.test(world)?;
        for (i, p) in effective.iter_mut().enumerate() {
            *p = match soil(i) {
                true => (drained[i] + load - excess[i]).max(0.0),
                false => drained[i],
            };
        }
        Ok(())
    })
}

/// p' (1 + tan ψ/μ): the pressure at which a friction of μ, that of slow flow, is one of μ + tan ψ.
pub(crate) fn dilatant_friction<const D: usize>(
    phase: PhaseMask,
    law: Arc<dyn Dilatancy>,
    friction: f64,
) -> impl Stage<World<D>> {
    let state = (fields::EFFECTIVE_PRESSURE, fields::STRAIN_RATE, PACKING);
    let access = Access::none().both(phase.column()).here(state);
    let name = "friction of dilation";
    column_stage::<D, _>(name, access, FRICTION_PRESSURE, move |world, out| {
        let (effective, strain_rate, packing) = world.free.all(state)?;
        let soil = phase.test(world)?;
        out.copy_from_slice(effective);
        for i in (0..out.len()).filter(|&i| soil(i)) {
            let angle = law.friction(&GrainState {
                packing: packing[i],
                strain_rate: strain_rate[i],
                pressure: effective[i],
            });
            out[i] *= (1.0 + angle / friction).max(0.0);
        }
        Ok(())
    })
}

/// Share of the yield stress from which a material yields.
const YIELDS: f64 = 0.99;

/// Plastic shares of all particles of soils with an elastic part: strain that the skeleton takes back moves no grain past another.
///
/// The share is 1 where the remembered stress reaches the yield stress within 1 %, and that of the liquid elsewhere.
pub(crate) fn plastic_shares<const D: usize>(
    laws: &LawInputs,
    world: &World<D>,
) -> Result<Vec<f64>, StepError> {
    let stress = world.free.get(fields::ELASTIC_STRESS)?;
    let stress: Vec<_> = stress.iter().map(|t| *t * (1.0 / YIELDS)).collect();
    let mut yielding = Vec::new();
    laws.yielding(world, &stress, &mut yielding)?;
    let share = |y: &Yielding| if y.held < 1.0 { 1.0 } else { y.friction };
    Ok(yielding.iter().map(share).collect())
}
