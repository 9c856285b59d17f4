//! The energy of a phase.

use sph_core::{StepError, fields, plugin};
use sph_neighbours::World;

use crate::phases::phase::{self, Counted};
use crate::{Probe, ProbeColumn, ProbeEntry, ProbeScene};

/// Kinetic energy ½ Σ m u² and potential energy −Σ m g·r of a phase, J (per metre of depth in 2D).
///
/// The potential energy counts from the origin.
///
/// ```toml
/// [probe.water-energy]
/// kind = "phase-energy"
/// phase = "water"
/// ```
#[plugin(ProbeEntry [2, 3], "phase-energy", "kinetic and potential energy of a phase", source: "½ Σ m u², −Σ m g·r")]
pub struct PhaseEnergy {
    /// Name of the phase; all particles if left out.
    pub phase: Option<String>,
    #[serde(skip)]
    number: Option<u32>,
}

impl<const D: usize> Probe<D> for PhaseEnergy {
    fn columns(&self) -> Vec<ProbeColumn> {
        let column = |suffix: &str| ProbeColumn {
            suffix: suffix.into(),
            unit: "J",
        };
        vec![column(".kinetic"), column(".potential")]
    }

    fn settle(&mut self, scene: &ProbeScene<'_>) -> Result<(), String> {
        if let Some(name) = &self.phase {
            self.number = Some(phase::number(name, scene.phases)?);
        }
        Ok(())
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let counted = Counted::of(world, self.phase.as_deref(), self.number)?;
        let mass = world.free.get(fields::MASS)?;
        let velocity = world.free.get(fields::VELOCITY)?;
        let position = world.free.get(fields::POSITION)?;
        let (mut kinetic, mut potential) = (0.0, 0.0);
        for k in (0..mass.len()).filter(|k| counted.has(*k)) {
            kinetic += 0.5 * mass[k] * velocity[k].norm_squared();
            potential -= mass[k] * world.steady_gravity.dot(&position[k]);
        }
        Ok(vec![kinetic, potential])
    }
}
