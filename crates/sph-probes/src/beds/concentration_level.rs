//! The height of a concentration in a suspension.

use sph_core::{StepError, fields, plugin};
use sph_neighbours::World;

use crate::{Probe, ProbeColumn, ProbeEntry};

/// The highest place at which the concentration of suspended grains comes up to a value, m: the interface below clear fluid, or
/// that of a deposit. NaN where it does not.
///
/// The concentration at a height is the mean over the particles within a spacing, weighed with their mass and 1 − |Δz|/δr;
/// between heights a quarter of a spacing apart it is linear.
///
/// Source: ours.
///
/// ```toml
/// [probe.deposit]
/// kind = "concentration-level"
/// concentration = 0.55
/// ```
#[plugin(ProbeEntry [2, 3], "concentration-level", "height of a concentration of suspended grains",
    source: "the highest place where the mean over a spacing comes up to it")]
pub struct ConcentrationLevel {
    /// The concentration.
    #[parameter(unit: "1", above: 0.0, max: 1.0)]
    pub concentration: f64,
}

/// Parts of a spacing between the heights at which the concentration is looked at.
const PARTS: f64 = 4.0;

impl<const D: usize> Probe<D> for ConcentrationLevel {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::only("m")
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let concentration = world.free.get(fields::CONCENTRATION).map_err(|_| {
            let reason = "no fluid of this scene carries grains: expected `[suspension.PLUGIN]`";
            StepError::stage("probe `concentration-level`", reason)
        })?;
        let position = world.free.get(fields::POSITION)?;
        let mass = world.free.get(fields::MASS)?;
        let mut grains: Vec<[f64; 3]> = (0..position.len())
            .map(|k| [position[k][D - 1], mass[k], concentration[k]])
            .collect();
        grains.sort_unstable_by(|a, b| b[0].total_cmp(&a[0]));
        let (Some(top), Some(bottom)) = (grains.first(), grains.last()) else {
            return Ok(vec![f64::NAN]);
        };
        let (spacing, step) = (world.spacing, world.spacing / PARTS);
        let mut first = 0;
        let mut above: Option<[f64; 2]> = None;
        let count = ((top[0] - bottom[0]) / step).floor() as usize;
        for k in 0..=count {
            let z = top[0] - step * k as f64;
            first += grains[first..].partition_point(|grain| grain[0] > z + spacing);
            let near = grains[first..]
                .iter()
                .take_while(|grain| grain[0] > z - spacing);
            let (mut whole, mut weight) = (0.0, 0.0);
            for [height, mass, concentration] in near {
                let share = mass * (1.0 - (height - z).abs() / spacing);
                whole += share * concentration;
                weight += share;
            }
            if weight <= 0.0 {
                continue;
            }
            let here = whole / weight;
            if here >= self.concentration {
                let crossing = match above {
                    Some([before, height]) => {
                        height + (z - height) * (self.concentration - before) / (here - before)
                    }
                    None => z,
                };
                return Ok(vec![crossing]);
            }
            above = Some([here, z]);
        }
        Ok(vec![f64::NAN])
    }
}
