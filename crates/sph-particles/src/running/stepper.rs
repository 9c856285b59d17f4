//! A scene stepped by hand: no folder, no file, and columns that may be changed between the steps.

use std::path::Path;

use sph_core::{FieldError, Role, StepError, fields};
use sph_scene::Scene;
use sph_solver::step::guard;

use crate::failure::error::Result;
use crate::running::checkpoint;
use crate::setup::{assemble, rehearse};
use crate::zones::{Stepper, attach};

impl<const D: usize> Stepper<D> {
    /// Assembles a scene of `D` dimensions.
    ///
    /// # Errors
    /// Every problem of the scene, with its path.
    pub fn new(scene: &Scene) -> Result<Self> {
        let mut parts = assemble::<D>(scene)?;
        rehearse(scene, &mut parts.flow, &parts.probes)?;
        let zones = attach(scene, &parts)?;
        Ok(Self::from_parts(scene, parts, zones))
    }

    /// Begins with the particles and the time of a checkpoint of another run of the same bodies.
    ///
    /// # Errors
    /// A checkpoint that cannot be read or has other particles.
    pub fn start_from(&mut self, checkpoint: &Path) -> Result<()> {
        self.changed();
        checkpoint::start_from(&mut self.parts.flow, &self.scene, checkpoint)
    }

    /// Present values of every probe: name with suffix, unit, value.
    ///
    /// # Errors
    /// If a column is missing, or the state is bad.
    pub fn measure(&mut self) -> Result<Vec<(String, &'static str, f64)>> {
        self.evaluate()?;
        let parts = &mut self.parts;
        rehearse(&self.scene, &mut parts.flow, &parts.probes)?;
        self.coupling.measure_walls()?;
        let mut all = Vec::new();
        for (name, probe) in &parts.probes {
            let zone = self.coupling.measuring(name);
            let (probe, world) = zone.unwrap_or((&**probe, &parts.flow.world));
            let values = probe.measure(world)?;
            let columns = probe.columns().into_iter().zip(values);
            all.extend(columns.map(|(c, v)| (format!("{name}{}", c.suffix), c.unit, v)));
        }
        Ok(all)
    }

    /// Overwrites a column of state, `components` numbers per particle in the present order of the particles.
    ///
    /// # Errors
    /// If there is no such column of state, its length is another, or a number is not finite.
    pub fn set(&mut self, name: &str, values: &[f64]) -> Result<(), StepError> {
        let refused = |reason: String| StepError::stage(format!("setting `{name}`"), reason);
        let free = &mut self.parts.flow.world.free;
        let state = |role: Role| role == Role::State;
        let found = free.columns().find(|(n, ..)| *n == name);
        let Some((name, _, role, ..)) = found else {
            return Err(refused("the scene has no such column".into()));
        };
        if !state(role) || name == fields::IDENTITY.name {
            let can = free.columns().filter(|(_, _, role, ..)| state(*role));
            let can: Vec<&str> = can.map(|(n, ..)| n).collect();
            let why = format!("it is not state, which is: {}", can.join(", "));
            return Err(refused(why));
        }
        if let Some(bad) = values.iter().find(|v| !v.is_finite()) {
            return Err(refused(format!("{bad} is not finite")));
        }
        match free.set_real(name, values) {
            Err(FieldError::Type(_)) => {
                let whole = values.iter().map(|v| *v as u32).collect::<Vec<_>>();
                free.set_index(name, &whole)?;
            }
            other => other?,
        }
        self.changed();
        if name == fields::POSITION.name {
            guard::positions(&self.parts.flow.world)?;
            self.parts.flow.world.rebuild_lists()?;
        }
        Ok(())
    }
}
