//! The kind of the pressure between the grains, and the pressure of the water in the pores.

use rayon::prelude::*;
use sph_contribution::{Contribution, contribution_kind};
use sph_core::{Access, Declares, Stage, StepError, Work, fields};
use sph_neighbours::World;

/// Reference densities of the soils among the phases, kg/m³, in the order of the phase numbers; `None` for
/// a phase whose law reads no pressure.
pub type Soils = Vec<Option<f64>>;

contribution_kind!(
    /// An effective pressure that a scene may name: the pressure that makes friction in soils. One of its stages writes
    /// [`EFFECTIVE_PRESSURE`](sph_core::fields::EFFECTIVE_PRESSURE).
    pub EffectivePressureEntry, "effective-pressure", One, "the pressure between the grains of a soil",
    .absent("that of the equation of state if left out").ordered(20).works(Work::Others)
);

/// q = p − p', Pa: the pressure p of the equation of state is that of grains and water together, the
/// effective pressure p' that between the grains, 0 outside of soils.
///
/// Source: Ghaïtanellis 2017, Eq. 5.26.
pub struct PorePressure;

impl Declares for PorePressure {
    fn name(&self) -> String {
        "pore pressure".into()
    }
    fn access(&self) -> Access {
        Access::none()
            .here(fields::PRESSURE)
            .here(fields::EFFECTIVE_PRESSURE)
            .writes(fields::PORE_PRESSURE)
    }
}

impl<const D: usize> Stage<World<D>> for PorePressure {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let mut pore = world.free.take(fields::PORE_PRESSURE)?;
        let whole = world.free.get(fields::PRESSURE)?;
        let effective = world.free.get(fields::EFFECTIVE_PRESSURE)?;
        let both = whole.par_iter().zip(effective);
        let all = pore.par_iter_mut().zip(both).with_min_len(2048);
        all.for_each(|(pore, (whole, effective))| *pore = whole - effective);
        Ok(world.free.put(fields::PORE_PRESSURE, pore)?)
    }
}
