//! How much of a phase has yielded.

use sph_core::{StepError, fields, plugin};
use sph_neighbours::World;

use crate::phases::phase::{self, Counted};
use crate::{Needs, Probe, ProbeColumn, ProbeEntry, ProbeScene};

/// Share of the particles whose strain rate is above a threshold, γ̇ > γ̇_y, and the mean strain
/// rate of those, 1/s.
///
/// A regularised law has no plug that does not move at all: what counts as yielded is a choice. A
/// phase without particles has no share, and without one that yields there is no mean: NaN. Only
/// scenes with a law that feels the strain rate have one; the probe then makes it known in all phases.
///
/// Source: ours.
///
/// ```toml
/// [probe.sliding]
/// kind = "yielded"
/// phase = "sand"
/// strain_rate = 1.0
/// ```
#[plugin(ProbeEntry [2, 3], "yielded", "share of a phase that strains faster than a threshold", source: "a count")]
pub struct Yielded {
    /// Threshold γ̇_y.
    #[parameter(unit: "1/s", min: 0.0)]
    pub strain_rate: f64,
    /// Name of the phase; all particles if left out.
    pub phase: Option<String>,
    #[serde(skip)]
    number: Option<u32>,
}

impl<const D: usize> Probe<D> for Yielded {
    fn columns(&self) -> Vec<ProbeColumn> {
        let column = |suffix: &str, unit| ProbeColumn {
            suffix: suffix.into(),
            unit,
        };
        vec![column(".share", "1"), column(".mean", "1/s")]
    }

    fn settle(&mut self, scene: &ProbeScene<'_>) -> Result<(), String> {
        if let Some(name) = &self.phase {
            self.number = Some(phase::number(name, scene.phases)?);
        }
        Ok(())
    }

    fn needs(&self) -> Needs<'_> {
        Needs {
            fields: vec![fields::STRAIN_RATE.name],
            ..Needs::default()
        }
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let rate = world.free.get(fields::STRAIN_RATE)?;
        let counted = Counted::of(world, self.phase.as_deref(), self.number)?;
        let (mut all, mut yielded, mut sum) = (0_usize, 0_usize, 0.0);
        for (_, rate) in rate.iter().enumerate().filter(|(k, _)| counted.has(*k)) {
            all += 1;
            if *rate > self.strain_rate {
                yielded += 1;
                sum += rate;
            }
        }
        let over = |value: f64, count: usize| match count {
            0 => f64::NAN,
            count => value / count as f64,
        };
        Ok(vec![over(yielded as f64, all), over(sum, yielded)])
    }
}
