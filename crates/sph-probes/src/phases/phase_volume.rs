//! The volume of a phase.

use sph_core::{StepError, fields, plugin};
use sph_neighbours::World;

use crate::phases::phase::{self, Counted};
use crate::{Probe, ProbeColumn, ProbeEntry, ProbeScene};

/// Σ V over the particles of a phase, m² in two dimensions and m³ in three.
///
/// V = m/ρ: what a phase loses of it, it is compressed; what it gains, it has torn or swollen.
///
/// ```toml
/// [probe.air-volume]
/// kind = "phase-volume"
/// phase = "air"
/// scale = 0.786
/// ```
#[plugin(ProbeEntry [2, 3], "phase-volume", "volume of a phase", source: "Σ m/ρ")]
pub struct PhaseVolume {
    /// Name of the phase; all particles if left out.
    pub phase: Option<String>,
    /// The volume is divided by this, m² or m³.
    #[parameter(default: 1.0, above: 0.0)]
    pub scale: f64,
    #[serde(skip)]
    number: Option<u32>,
}

impl<const D: usize> Probe<D> for PhaseVolume {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::only(match (self.scale == 1.0, D) {
            (false, _) => "1",
            (_, 2) => "m²",
            _ => "m³",
        })
    }

    fn settle(&mut self, scene: &ProbeScene<'_>) -> Result<(), String> {
        if let Some(name) = &self.phase {
            self.number = Some(phase::number(name, scene.phases)?);
        }
        Ok(())
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let counted = Counted::of(world, self.phase.as_deref(), self.number)?;
        let volume = world.free.get(fields::VOLUME)?.iter().enumerate();
        let of_phase = volume.filter(|(k, _)| counted.has(*k)).map(|(_, v)| v);
        Ok(vec![of_phase.sum::<f64>() / self.scale])
    }
}
