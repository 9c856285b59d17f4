//! Kinetic energy.

use sph_core::{StepError, fields, plugin};
use sph_neighbours::World;

use crate::{Probe, ProbeColumn, ProbeEntry};

/// ½ Σ m u² of all free particles, J (per metre of depth in 2D).
///
/// ```toml
/// [probe.energy]
/// kind = "kinetic-energy"
/// ```
#[plugin(ProbeEntry [2, 3], "kinetic-energy", "kinetic energy of all particles", source: "½ Σ m u²")]
pub struct KineticEnergy {}

impl<const D: usize> Probe<D> for KineticEnergy {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::only("J")
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let mass = world.free.get(fields::MASS)?;
        let velocity = world.free.get(fields::VELOCITY)?;
        let all = mass.iter().zip(velocity);
        Ok(vec![all.map(|(m, u)| 0.5 * m * u.norm_squared()).sum()])
    }
}
