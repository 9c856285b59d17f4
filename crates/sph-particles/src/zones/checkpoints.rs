//! Checkpoints of zones, beside that of the scene.

use std::path::{Path, PathBuf};

use sph_run::Identity;

use super::coupling::Coupling;
use crate::failure::error::RunError;
use crate::running::checkpoint;
use crate::running::counters::Counters;

/// The checkpoint of a zone beside another, `checkpoint-NAME.sph`.
fn beside(own: &Path, zone: &str) -> PathBuf {
    let stem = own.file_stem().unwrap_or_default().to_string_lossy();
    let ending = own.extension().unwrap_or_default().to_string_lossy();
    own.with_file_name(format!("{stem}-{zone}.{ending}"))
}

impl<const D: usize> Coupling<D> {
    /// Writes the states of all zones beside the checkpoint of the flow around them.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn save(&self, own: &Path, identity: &Identity) -> Result<(), RunError> {
        for level in &self.levels {
            let path = beside(own, &level.name);
            let stepper = &level.stepper;
            let flow = &stepper.parts.flow;
            let counters = Counters {
                steps: stepper.steps,
                rolled_back: stepper.rolled_back,
                step_scale: stepper.scale.to_bits(),
                ..Counters::begin()
            };
            checkpoint::save((flow, flow.walls.as_deref()), &path, identity, &counters)?;
            stepper.coupling.save(&path, identity)?;
        }
        Ok(())
    }

    /// Puts all zones where [`save`](Self::save) left them.
    ///
    /// # Errors
    /// A file that cannot be read, or is of another run.
    pub fn load(&mut self, own: &Path, identity: Option<&Identity>) -> Result<(), RunError> {
        for level in &mut self.levels {
            let path = beside(own, &level.name);
            let stepper = &mut level.stepper;
            let flow = &mut stepper.parts.flow;
            let counters = checkpoint::load(flow, &stepper.scene, &path, identity)?;
            stepper.changed();
            stepper.steps = counters.steps;
            stepper.rolled_back = counters.rolled_back;
            stepper.scale = f64::from_bits(counters.step_scale);
            stepper.coupling.load(&path, identity)?;
        }
        Ok(())
    }
}
