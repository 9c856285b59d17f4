//! The foremost particle.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sph_core::{StepError, fields, register};
use sph_neighbours::World;

use crate::phase::{self, Counted};
use crate::{Probe, ProbeColumn, ProbeEntry};

/// Axis of a coordinate.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize, JsonSchema, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// First coordinate.
    #[default]
    X,
    /// Second coordinate.
    Y,
    /// Third coordinate.
    Z,
}

/// The largest coordinate of any particle plus half a spacing: the front of a surge.
///
/// ```toml
/// [probe.front]
/// kind = "front"
/// axis = "x"
/// below = 0.1
/// ```
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Front {
    /// Direction in which the front moves.
    #[serde(default)]
    pub axis: Axis,
    /// Only particles whose last coordinate is below this height count.
    #[schemars(extend("unit" = "m"))]
    pub below: Option<f64>,
    /// Name of the phase whose front is measured; that of all particles if left out.
    pub phase: Option<String>,
    #[serde(skip)]
    number: Option<u32>,
}

impl<const D: usize> Probe<D> for Front {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::only("m")
    }

    fn name_phases(&mut self, names: &[String]) -> Result<(), String> {
        if let Some(name) = &self.phase {
            self.number = Some(phase::number(name, names)?);
        }
        Ok(())
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let axis = self.axis as usize;
        let below = self.below.unwrap_or(f64::INFINITY);
        let positions = world.free.get(fields::POSITION)?;
        let phase = Counted::of(world, self.phase.as_deref(), self.number)?;
        let all = positions.iter().enumerate();
        let counted = all.filter(|(k, x)| x[D - 1] < below && phase.has(*k));
        let along = counted.map(|(_, x)| x[axis.min(D - 1)]);
        let front = along.fold(f64::NAN, f64::max);
        Ok(vec![front + 0.5 * world.spacing])
    }
}

register!(
    ProbeEntry [2, 3],
    Front,
    "front",
    "the foremost particle along an axis",
    "largest coordinate plus half a spacing"
);
