//! The work of open faces within a step.

use sph_contribution::{Gate, Newborn, Report, StepHook, StepMoment, StepPhase, even_out};
use sph_core::{Access, StepError, Vect, fields};
use sph_neighbours::World;

use crate::faces::{SharedFaces, lock};
use crate::flux::OPEN_FLUX;

const NAME: &str = "open boundaries";

/// Lets mass through.
#[derive(Clone)]
pub(crate) struct FacePassing<const D: usize> {
    pub faces: SharedFaces<D>,
    /// True if densities are sums, which change with particles that come and go.
    pub summed: bool,
    pub phases: Vec<String>,
}

impl<const D: usize> FacePassing<D> {
    fn columns(&self) -> Access {
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
                .remembers(OPEN_FLUX)
                .writes(fields::DENSITY_CONSTANT),
        }
    }
}

impl<const D: usize> StepHook<D> for FacePassing<D> {
    fn name(&self) -> String {
        NAME.into()
    }

    fn access(&self) -> Access {
        self.columns()
    }

    fn phases(&self) -> &'static [StepPhase] {
        &[StepPhase::AfterKick]
    }

    fn run(&mut self, _: StepPhase, moment: &mut StepMoment<'_, D>) -> Result<(), StepError> {
        let (world, dt) = (&mut *moment.world, moment.dt);
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

    fn report(&self, _: &World<D>) -> Report {
        let faces = lock(&self.faces);
        Report {
            // Without an evaluation of the faces there are none.
            counts: (!faces.memory.volumes.is_empty()).then(|| faces.budget(&self.phases)),
            summary: Some("open_boundaries"),
            warnings: faces.differences(),
            ..Report::default()
        }
    }
}

impl<const D: usize> Gate<D> for FacePassing<D> {
    fn name(&self) -> String {
        NAME.into()
    }

    fn access(&self) -> Access {
        self.columns()
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

    fn births(&mut self, world: &mut World<D>, _dt: f64) -> Result<Vec<Newborn<D>>, StepError> {
        let mut faces = lock(&self.faces);
        let born = faces.due_particles();
        let places: Vec<Vect<D>> = born.iter().map(|b| b.position).collect();
        even_out(world, &places, -1.0)?;
        world.walls.passed = faces.passed(&world.walls);
        Ok(born)
    }
}
