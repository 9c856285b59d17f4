//! How far a phase reaches along an axis.

use sph_core::{Axis, StepError, fields, plugin};
use sph_neighbours::World;

use crate::phases::phase::{self, Counted};
use crate::{Probe, ProbeColumn, ProbeEntry, ProbeScene};

/// Least coordinate of a phase less half a spacing, and largest plus half a spacing, m.
///
/// With `quantile` = q > 0 they are the places below and above which a share q of the phase's
/// volume lies: a few particles that have left the bulk do not count.
///
/// ```toml
/// [probe.bubble]
/// kind = "extent"
/// phase = "light"
/// axis = "y"
/// ```
#[plugin(ProbeEntry [2, 3], "extent", "lowest and highest coordinate of a phase",
    source: "extrema or quantiles, and half a spacing")]
pub struct Extent {
    /// Name of the phase; all particles if left out.
    pub phase: Option<String>,
    /// The axis.
    #[parameter(default)]
    pub axis: Axis,
    /// Share of the volume that is left out at either end.
    #[parameter(default, unit: "1", min: 0.0, below: 0.5)]
    pub quantile: f64,
    #[serde(skip)]
    number: Option<u32>,
}

impl<const D: usize> Probe<D> for Extent {
    fn columns(&self) -> Vec<ProbeColumn> {
        let column = |suffix: &str| ProbeColumn {
            suffix: suffix.into(),
            unit: "m",
        };
        vec![column(".lowest"), column(".highest")]
    }

    fn settle(&mut self, scene: &ProbeScene<'_>) -> Result<(), String> {
        if let Some(name) = &self.phase {
            self.number = Some(phase::number(name, scene.phases)?);
        }
        Ok(())
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let counted = Counted::of(world, self.phase.as_deref(), self.number)?;
        let axis = (self.axis as usize).min(D - 1);
        let position = world.free.get(fields::POSITION)?;
        let half = 0.5 * world.spacing;
        if self.quantile == 0.0 {
            let all = position.iter().enumerate();
            let along = || {
                all.clone()
                    .filter(|(k, _)| counted.has(*k))
                    .map(|(_, x)| x[axis])
            };
            let (lowest, highest) = (
                along().fold(f64::NAN, f64::min),
                along().fold(f64::NAN, f64::max),
            );
            return Ok(vec![lowest - half, highest + half]);
        }
        let volume = world.free.get(fields::VOLUME)?;
        let all = position.iter().zip(volume).enumerate();
        let of_phase = all.filter(|(k, _)| counted.has(*k));
        let mut pairs: Vec<(f64, f64)> = of_phase.map(|(_, (x, v))| (x[axis], *v)).collect();
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let left_out = self.quantile * pairs.iter().map(|p| p.1).sum::<f64>();
        Ok(vec![
            beyond(pairs.iter(), left_out) - half,
            beyond(pairs.iter().rev(), left_out) + half,
        ])
    }
}

/// The first coordinate at which the volumes passed are more than `left_out`.
fn beyond<'a>(mut pairs: impl Iterator<Item = &'a (f64, f64)>, left_out: f64) -> f64 {
    let mut sum = 0.0;
    let found = pairs.find(|(_, v)| {
        sum += v;
        sum > left_out
    });
    found.map_or(f64::NAN, |p| p.0)
}
