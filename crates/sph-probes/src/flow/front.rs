//! The foremost particle.

use sph_core::{Axis, StepError, fields, parameters, plugin};
use sph_neighbours::World;

use crate::phases::phase::{self, Counted};
use crate::{Probe, ProbeColumn, ProbeEntry, ProbeScene};

/// Which of the two ends of a phase along an axis.
#[parameters]
#[serde(rename_all = "lowercase")]
pub enum Direction {
    /// Towards larger coordinates.
    #[default]
    Forward,
    /// Towards smaller ones.
    Backward,
}

/// The largest coordinate of any particle plus half a spacing: the front of a surge.
///
/// With `direction = "backward"` it is the smallest coordinate less half a spacing. With
/// `quantile` = q < 1 a share q of the particles is behind it, and the others, which may have left
/// the bulk, do not make a front.
///
/// ```toml
/// [probe.front]
/// kind = "front"
/// axis = "x"
/// below = 0.1
/// quantile = 0.995
/// ```
#[plugin(ProbeEntry [2, 3], "front", "the foremost particle along an axis, either way",
    source: "extreme coordinate or quantile, and half a spacing")]
pub struct Front {
    /// Axis along which the front moves.
    #[parameter(default)]
    pub axis: Axis,
    /// Its direction along the axis.
    #[parameter(default)]
    pub direction: Direction,
    /// Share of the particles that the front is ahead of; all of them if left out.
    #[parameter(unit: "1", above: 0.0, max: 1.0)]
    pub quantile: Option<f64>,
    /// Only particles whose last coordinate is below this height count.
    #[parameter(unit: "m")]
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

    fn settle(&mut self, scene: &ProbeScene<'_>) -> Result<(), String> {
        if let Some(name) = &self.phase {
            self.number = Some(phase::number(name, scene.phases)?);
        }
        Ok(())
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let axis = (self.axis as usize).min(D - 1);
        let below = self.below.unwrap_or(f64::INFINITY);
        let sign = match self.direction {
            Direction::Forward => 1.0,
            Direction::Backward => -1.0,
        };
        let positions = world.free.get(fields::POSITION)?;
        let phase = Counted::of(world, self.phase.as_deref(), self.number)?;
        let all = positions.iter().enumerate();
        let counted = all.filter(|(k, x)| x[D - 1] < below && phase.has(*k));
        let mut along: Vec<f64> = counted.map(|(_, x)| sign * x[axis]).collect();
        let behind = self.quantile.unwrap_or(1.0) * along.len() as f64;
        // The last of the share that is behind the front, counted from one.
        let last = (behind.ceil() as usize).clamp(1, along.len().max(1)) - 1;
        if along.is_empty() {
            return Ok(vec![f64::NAN]);
        }
        let (_, front, _) = along.select_nth_unstable_by(last, f64::total_cmp);
        Ok(vec![sign * (*front + 0.5 * world.spacing)])
    }
}
