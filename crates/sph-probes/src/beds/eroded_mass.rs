//! Mass of a bed that the flow has eroded.

use sph_core::{StepError, fields, plugin};
use sph_neighbours::World;

use crate::measure::presets::Direction;
use crate::phases::phase::{self, CountedPhase};
use crate::{Probe, ProbeColumn, ProbeEntry, ProbeScene};

/// Mass of a bed that has left its place at the start, kg (per metre of width in 2D).
///
/// The thesis takes the error Er = (m_SPH − m_exp)/m_exp of the mass m of all sediment that has
/// reached the downstream outlet of the flume. Here
/// * `.out` is the mass of the phase beyond the outlet, a place along x, and of what has left by any
///   `[outlet.NAME]`: the m of the error;
/// * `.risen` is the mass of those before the outlet that are above `level`, the level of the bed at
///   the start: what is under way, or came to rest on the bed;
/// * `.total` is the sum of both: all that has left the region of the bed at the start.
///
/// Motion within that region does not count. The centre of a particle decides: the top row of a
/// flat bed has to rise by half a spacing until it counts.
///
/// Source: Ghaïtanellis 2017, §5.4.1 and Eq. 5.17; `.risen` is ours.
///
/// ```toml
/// [probe.eroded]
/// kind = "eroded-mass"
/// phase = "sand"
/// level = 0.1
/// beyond = 6.0
/// ```
#[plugin(ProbeEntry [2, 3], "eroded-mass", "mass of a bed beyond an outlet and above its first level",
    source: "Ghaïtanellis 2017, Eq. 5.17")]
pub struct ErodedMass {
    /// Name of the phase that makes the bed.
    pub phase: String,
    /// Height of the bed's top at the start.
    #[parameter(unit: "m")]
    pub level: f64,
    /// Place of the outlet along x; there is none if left out.
    #[parameter(unit: "m")]
    pub beyond: Option<f64>,
    /// The way out: towards larger or smaller x.
    #[parameter(default)]
    pub direction: Direction,
    #[serde(skip)]
    number: Option<u32>,
}

impl<const D: usize> Probe<D> for ErodedMass {
    fn columns(&self) -> Vec<ProbeColumn> {
        let suffixes = [".out", ".risen", ".total"];
        suffixes.map(|s| ProbeColumn::named(s, "kg")).into()
    }

    fn prepare(&mut self, scene: &ProbeScene<'_>) -> Result<(), String> {
        self.number = phase::number(Some(&self.phase), scene)?;
        Ok(())
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let bed = CountedPhase::in_phase(world, Some(&self.phase), self.number)?;
        let sign = match self.direction {
            Direction::Forward => 1.0,
            Direction::Backward => -1.0,
        };
        let is_out = |x: f64| self.beyond.is_some_and(|end| sign * (x - end) > 0.0);
        let positions = world.free.get(fields::POSITION)?.iter();
        let all = positions.zip(world.free.get(fields::MASS)?).enumerate();
        let taken = world.free.removed.iter();
        let taken = taken.filter(|t| Some(t.phase) == self.number);
        let (mut out, mut risen) = (taken.map(|t| t.mass).sum(), 0.0);
        for (_, (x, mass)) in all.filter(|(k, _)| bed.has(*k)) {
            if is_out(x[0]) {
                out += mass;
            } else if x[D - 1] > self.level {
                risen += mass;
            }
        }
        Ok(vec![out, risen, out + risen])
    }
}
