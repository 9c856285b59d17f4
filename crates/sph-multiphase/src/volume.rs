//! Volumes where densities are integrated.

use rayon::prelude::*;
use sph_core::{Access, Declares, Stage, StepError, fields};
use sph_neighbours::World;

/// V = m/ρ.
pub struct VolumeStage;

impl Declares for VolumeStage {
    fn name(&self) -> String {
        "volume".into()
    }
    fn access(&self) -> Access {
        Access::none()
            .here(fields::MASS)
            .here(fields::DENSITY)
            .writes(fields::VOLUME)
    }
}

impl<const D: usize> Stage<World<D>> for VolumeStage {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let mut volume = world.free.take(fields::VOLUME)?;
        let mass = world.free.get(fields::MASS)?;
        let density = world.free.get(fields::DENSITY)?;
        let all = volume.par_iter_mut().zip(mass).zip(density);
        all.with_min_len(2048)
            .for_each(|((v, m), rho)| *v = m / rho);
        Ok(world.free.put(fields::VOLUME, volume)?)
    }
}
