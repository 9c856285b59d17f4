//! The work of open faces within a step.

use serde_json::Value as Json;
use sph_contribution::{Newborn, StepWork, even_out};
use sph_core::{Access, AnyField, StepError, Vect, fields};
use sph_neighbours::World;

use crate::faces::{SharedFaces, lock};
use crate::flux::OPEN_FLUX;

/// Name of the work, under which the summary has the budget.
pub const PASSING: &str = "open boundaries";

/// Lets mass through.
pub(crate) struct Passing<const D: usize> {
    pub faces: SharedFaces<D>,
    /// Whether densities are sums, which feel who comes and goes.
    pub summed: bool,
    pub phases: Vec<String>,
}

impl<const D: usize> StepWork<D> for Passing<D> {
    fn name(&self) -> String {
        PASSING.into()
    }

    fn access(&self) -> Access {
        let access = Access::none()
            .both(fields::POSITION)
            .both(fields::VOLUME)
            .here(fields::VELOCITY)
            .here(fields::MASS)
            .here(fields::DENSITY)
            .here(fields::RENORMALISATION)
            .here(fields::IDENTITY)
            .writes(fields::VELOCITY)
            .where_there(fields::PHASE);
        match self.summed {
            false => access,
            true => access
                .here(OPEN_FLUX)
                .here(fields::DENSITY_CONSTANT)
                .writes(OPEN_FLUX)
                .writes(fields::DENSITY_CONSTANT),
        }
    }

    fn remembered(&self) -> Vec<AnyField> {
        match self.summed {
            true => vec![OPEN_FLUX.any()],
            false => Vec::new(),
        }
    }

    fn after_kick(&mut self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        let mut faces = lock(&self.faces);
        faces.balance(world, dt)?;
        if self.summed {
            faces.advance_densities(world, dt)?;
        }
        faces.pass(dt);
        faces.ask(world.time, dt);
        faces.remember(dt);
        Ok(())
    }

    fn exits(&self) -> Vec<String> {
        lock(&self.faces)
            .faces
            .iter()
            .map(|f| f.name.clone())
            .collect()
    }

    fn departures(
        &mut self,
        world: &mut World<D>,
        _dt: f64,
    ) -> Result<Vec<(u32, usize)>, StepError> {
        let gone = lock(&self.faces).leaving(world)?;
        even_out(world, &gone.places, 1.0)?;
        Ok(gone.here)
    }

    fn gives_birth(&self) -> bool {
        true
    }

    fn births(&mut self, world: &mut World<D>, _dt: f64) -> Result<Vec<Newborn<D>>, StepError> {
        let mut faces = lock(&self.faces);
        let born = faces.ripe();
        let places: Vec<Vect<D>> = born.iter().map(|b| b.position).collect();
        even_out(world, &places, -1.0)?;
        world.walls.passed = faces.passed(&world.walls);
        Ok(born)
    }

    fn warnings(&self) -> Vec<String> {
        lock(&self.faces).differences()
    }

    fn counts(&self) -> Option<Json> {
        Some(lock(&self.faces).budget(&self.phases))
    }
}
