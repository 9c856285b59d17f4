//! The pressure of the water in the pores.

use rayon::prelude::*;
use sph_core::{Access, Declares, Stage, StepError, fields};
use sph_neighbours::World;

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
