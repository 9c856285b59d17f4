//! The height of the free surface, or of the top of a phase, over a point.

use sph_core::{StepError, Vect, fields, plugin};
use sph_neighbours::World;

use crate::phases::phase::{self, CountedPhase, bisected, column, ends, share};
use crate::{Probe, ProbeColumn, ProbeEntry, ProbeScene};

/// The highest place over a point where Σ V w falls to half of its value under water, V being at most a cell δr^d.
///
/// The sum is over the particles of `phase`, so that its top is found under another fluid, or over
/// all particles. Under water it is one, and less beside an upright wall, as no particles are behind that: there the
/// largest sum over the line counts, where the water is deeper than two supports. At one half the level one spacing off
/// a wall would be a third of a spacing too low (h = 1.5 δr in space), and half a spacing off it there might be none.
///
/// ```toml
/// [gauge.H1]
/// kind = "level"
/// at = [0.3]
/// ```
#[plugin(ProbeEntry [2, 3], "level", "height of the free surface, or of a phase, over a point",
    source: "half of the Shepard sum under water")]
pub struct Level {
    /// Horizontal coordinates: one in 2D, two in 3D.
    #[parameter(unit: "m")]
    pub at: Vec<f64>,
    /// Name of the moving wall that carries the gauge; it stands still if left out.
    pub follows: Option<String>,
    /// Name of the phase whose top is measured; the free surface of all of them if left out.
    pub phase: Option<String>,
    /// True if dry parts of the line below that place are taken off, as a wire does whose wet length is measured: a
    /// drop in the air then counts with its own height.
    #[parameter(default)]
    pub wetted: bool,
    #[serde(skip)]
    number: Option<u32>,
}

impl Level {
    /// The free surface over a place that stands still.
    pub fn over(at: Vec<f64>) -> Level {
        Level {
            at,
            follows: None,
            phase: None,
            wetted: false,
            number: None,
        }
    }
}

impl<const D: usize> Probe<D> for Level {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::only("m")
    }

    fn prepare(&mut self, scene: &ProbeScene<'_>) -> Result<(), String> {
        self.number = phase::number(self.phase.as_deref(), scene)?;
        Ok(())
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let radius = world.kernel.support_radius();
        let counted = CountedPhase::in_phase(world, self.phase.as_deref(), self.number)?;
        // Only the particles whose support meets the vertical line matter.
        let mut near = column(world, &self.at, self.follows.as_deref())?;
        near.retain(|(_, _, k)| counted.has(*k));
        let filling = |z: f64| -> f64 { near.iter().map(|(d, v, _)| share(world, d, *v, z)).sum() };
        let [bottom, top] = ends(&near);
        if near.is_empty() {
            return Ok(vec![f64::NAN]);
        }
        let half = match beside_a_wall(world, &near, bottom + radius)? {
            true => 0.5 * fullest_part(filling, bottom + radius, top - radius, 0.5 * radius),
            false => 0.5,
        };
        // Down from above until half full, then bisect.
        let step = 0.25 * world.spacing;
        let mut z = top + radius;
        while z > bottom && filling(z) < half {
            z -= step;
        }
        if filling(z) < half {
            return Ok(vec![f64::NAN]);
        }
        let level = bisected(z + step, z, |z| filling(z) < half);
        let dry = match self.wetted {
            true => length_where(|z| filling(z) < half, bottom, level, step),
            false => 0.0,
        };
        Ok(vec![level - dry])
    }
}

/// Length of the part of a line on which something holds, to less than `step`.
fn length_where(holds: impl Fn(f64) -> bool, from: f64, to: f64, step: f64) -> f64 {
    let count = ((to - from) / step).ceil().max(1.0);
    let each = (to - from) / count;
    let middles = (0..count as usize).map(|k| from + (k as f64 + 0.5) * each);
    middles.filter(|z| holds(*z)).count() as f64 * each
}

/// True if the highest particle within a spacing of the line is within reach of a wall, and not the floor below
/// `floor`.
fn beside_a_wall<const D: usize>(
    world: &World<D>,
    near: &[(Vect<D>, f64, usize)],
    floor: f64,
) -> Result<bool, StepError> {
    if !world.free.has(fields::RENORMALISATION.name) {
        return Ok(false);
    }
    let gamma = world.free.get(fields::RENORMALISATION)?;
    let aside = |d: &Vect<D>| (0..D - 1).map(|k| d[k] * d[k]).sum::<f64>();
    let within = world.spacing.powi(2);
    let close = near.iter().filter(|(d, ..)| aside(d) <= within);
    let highest = close.max_by(|a, b| a.0[D - 1].total_cmp(&b.0[D - 1]));
    Ok(highest.is_some_and(|(d, _, k)| d[D - 1] > floor && gamma[*k] < 1.0))
}

/// The largest sum over a part of the line, at most one; one if there is no such part.
fn fullest_part(filling: impl Fn(f64) -> f64, from: f64, to: f64, step: f64) -> f64 {
    let count = ((to - from) / step).floor();
    if count < 0.0 {
        return 1.0;
    }
    let sums = (0..=count as usize).map(|k| filling(from + k as f64 * step));
    sums.fold(0.0, f64::max).min(1.0)
}
