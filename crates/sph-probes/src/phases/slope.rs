//! The slope of a phase's surface.

use std::collections::BTreeMap;

use sph_core::{StepError, fields, plugin};
use sph_neighbours::World;

use crate::phases::phase::{self, CountedPhase};
use crate::{Probe, ProbeColumn, ProbeEntry, ProbeScene, norm};

/// Angle θ = arctan(dy/dx) of the line through the surface between two places, and the root mean
/// square of the surface about it: the angle of repose of a heap.
///
/// The surface is the highest particle of every column of a spacing's width, and half a spacing;
/// the line is that of least squares. An angle is negative where the surface falls towards larger x. NaN where
/// fewer than three columns have a particle.
///
/// Source: ours.
///
/// ```toml
/// [probe.repose]
/// kind = "slope"
/// phase = "sand"
/// between = [0.05, 0.15]
/// ```
#[plugin(ProbeEntry [2], "slope", "angle of a phase's surface between two places: angle of repose",
    source: "least squares through the highest particles")]
pub struct SurfaceSlope {
    /// First and last x of the surface.
    #[parameter(unit: "m")]
    pub between: [f64; 2],
    /// Name of the phase; all particles if left out.
    pub phase: Option<String>,
    #[serde(skip)]
    number: Option<u32>,
}

impl Probe<2> for SurfaceSlope {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::several(&[(".angle", "rad"), (".rms", "m")])
    }

    fn prepare(&mut self, scene: &ProbeScene<'_>) -> Result<(), String> {
        self.number = phase::number(self.phase.as_deref(), scene)?;
        Ok(())
    }

    fn measure(&self, world: &World<2>) -> Result<Vec<f64>, StepError> {
        let counted = CountedPhase::in_phase(world, self.phase.as_deref(), self.number)?;
        let positions = world.free.get(fields::POSITION)?;
        let [first, last] = self.between;
        let columns = ((last - first) / world.spacing).round().max(0.0);
        // Only of columns that have a particle: the places may be arbitrarily far apart.
        let mut highest: BTreeMap<u64, [f64; 2]> = BTreeMap::new();
        for x in counted.among(positions) {
            let along = (x[0] - first) / (last - first) * columns;
            // A negative or too large place is in no column.
            let column = along.floor();
            if column >= 0.0 && column < columns {
                let top = highest.entry(column as u64).or_insert([x[0], x[1]]);
                if x[1] > top[1] {
                    *top = [x[0], x[1]];
                }
            }
        }
        let tops = highest.values().map(|[x, y]| (*x, y + 0.5 * world.spacing));
        let (x, y): (Vec<f64>, Vec<f64>) = tops.unzip();
        let [slope, rms] = norm::line(&x, &y);
        Ok(vec![slope.atan(), rms])
    }
}
