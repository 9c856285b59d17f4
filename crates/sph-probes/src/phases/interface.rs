//! The height of the interface between phases over a point.

use sph_core::{StepError, plugin};
use sph_neighbours::World;

use crate::phases::phase::{self, CountedPhase, bisected, column, ends, share};
use crate::{Probe, ProbeColumn, ProbeEntry, ProbeScene};

/// The highest place over a point where the share Σ_phase V w / Σ V w crosses one half, m.
///
/// Σ_phase is over the particles of `phase` and Σ over all; V is at most a cell δr^d. Places where
/// Σ V w is less than a fifth are empty and do not count. NaN where nothing crosses.
///
/// Source: ours.
///
/// ```toml
/// [probe.spike]
/// kind = "interface"
/// at = [0.125]
/// phase = "heavy"
/// ```
#[plugin(ProbeEntry [2, 3], "interface", "height of the interface of a phase over a point",
    source: "Shepard share of a phase crosses one half")]
pub struct Interface {
    /// Horizontal coordinates: one in 2D, two in 3D.
    #[parameter(unit: "m")]
    pub at: Vec<f64>,
    /// Name of the phase on one side of the interface.
    pub phase: String,
    /// Name of the moving wall that carries the gauge; it stands still if left out.
    pub follows: Option<String>,
    #[serde(skip)]
    number: Option<u32>,
}

/// Least Σ V w of a place that is not empty: on a plane surface it is one half, in a corner of two
/// walls one quarter.
const EMPTY: f64 = 0.2;

impl<const D: usize> Probe<D> for Interface {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::only("m")
    }

    fn prepare(&mut self, scene: &ProbeScene<'_>) -> Result<(), String> {
        self.number = phase::number(Some(&self.phase), scene)?;
        Ok(())
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let counted = CountedPhase::in_phase(world, Some(&self.phase), self.number)?;
        let near = column(world, &self.at, self.follows.as_deref())?;
        // Share of the phase less one half, if the place is not empty.
        let excess = |z: f64| -> Option<f64> {
            let (mut of_phase, mut of_all) = (0.0, 0.0);
            for (d, v, k) in &near {
                let w = share(world, d, *v, z);
                of_all += w;
                of_phase += if counted.has(*k) { w } else { 0.0 };
            }
            (of_all >= EMPTY).then(|| of_phase / of_all - 0.5)
        };
        let [bottom, top] = ends(&near);
        let step = 0.25 * world.spacing;
        let (mut z, mut above): (f64, Option<(f64, f64)>) = (top + step, None);
        // Down from above until the side changes, then bisect.
        while z > bottom - step {
            let here = excess(z);
            match (above, here) {
                (Some((over, before)), Some(now)) if (before >= 0.0) != (now >= 0.0) => {
                    let same = |e: f64| (e >= 0.0) == (before >= 0.0);
                    let crossing = bisected(over, z, |z| excess(z).is_some_and(same));
                    return Ok(vec![crossing]);
                }
                (_, Some(now)) => above = Some((z, now)),
                _ => {}
            }
            z -= step;
        }
        Ok(vec![f64::NAN])
    }
}
