//! Surfaces of phases: heights of the free surface, of the top of a phase and of an interface over a point, and slope.

use std::collections::BTreeMap;

use sph_core::{StepError, Vect, bounds, fields, plugin};
use sph_neighbours::World;

use crate::flow::point::{carried, point};
use crate::phases::phase::{self, CountedPhase};
use crate::{Probe, ProbeColumn, ProbeEntry, ProbeScene, norm};

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

/// Least Σ V w of a place that is not empty: on a plane surface it is one half, in a corner of two walls one quarter.
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
            match (above, excess(z)) {
                (Some((over, before)), Some(now)) if (before >= 0.0) != (now >= 0.0) => {
                    let same = |e: f64| (e >= 0.0) == (before >= 0.0);
                    return Ok(vec![bisected(over, z, |z| excess(z).is_some_and(same))]);
                }
                (_, Some(now)) => above = Some((z, now)),
                _ => {}
            }
            z -= step;
        }
        Ok(vec![f64::NAN])
    }
}

/// Particles around the vertical line over a place, which a wall may carry: place from the line's foot, volume, number.
///
/// Volumes are at most a cell δr^d: a drop alone has a small density and a volume of several cells, and is no surface.
fn column<const D: usize>(
    world: &World<D>,
    at: &[f64],
    follows: Option<&str>,
) -> Result<Vec<(Vect<D>, f64, usize)>, StepError> {
    let mut foot = carried(world, point(&at[..at.len().min(D - 1)]), follows)?;
    foot[D - 1] = 0.0;
    let (positions, volume) = world.free.all((fields::POSITION, fields::VOLUME))?;
    let radius = world.kernel.support_radius();
    let cell = world.spacing.powi(D as i32);
    let all = positions.iter().zip(volume).enumerate();
    let placed = all.map(|(k, (x, v))| (world.domain.nearest_image(x - foot), v.min(cell), k));
    let near = |d: &Vect<D>| (0..D - 1).map(|k| d[k] * d[k]).sum::<f64>() < radius * radius;
    Ok(placed.filter(|(d, ..)| near(d)).collect())
}

fn ends<const D: usize>(near: &[(Vect<D>, f64, usize)]) -> [f64; 2] {
    let [[bottom], [top]] = bounds(near.iter().map(|(d, ..)| [d[D - 1]]));
    [bottom, top]
}

/// The place between two heights at which a condition that holds at the first ends, by halving 30 times.
fn bisected(mut first: f64, mut last: f64, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..30 {
        let middle = 0.5 * (first + last);
        match holds(middle) {
            true => first = middle,
            false => last = middle,
        }
    }
    0.5 * (first + last)
}

/// V w at height z of the line for one of its particles.
fn share<const D: usize>(world: &World<D>, d: &Vect<D>, v: f64, z: f64) -> f64 {
    let mut d = *d;
    d[D - 1] -= z;
    let r = d.norm();
    match r < world.kernel.support_radius() {
        true => v * world.kernel.at(r).0,
        false => 0.0,
    }
}

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
        let all = positions.iter().enumerate();
        for (_, x) in all.filter(|(k, _)| counted.has(*k)) {
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
