//! Particles that a probe counts: those of one phase, or all.

use sph_core::{StepError, Vect, bounds, fields, suggestion};
use sph_neighbours::World;

use crate::contract::{ProbeScene, refused};
use crate::flow::point::{carried, point};

/// Number of the phase that a probe names, in the scene's order of names; none if it names none.
///
/// # Errors
/// If no phase is called so.
pub(crate) fn number(name: Option<&str>, scene: &ProbeScene<'_>) -> Result<Option<u32>, String> {
    let Some(name) = name else { return Ok(None) };
    let found = scene.phases.iter().position(|n| n == name);
    found.map(|k| Some(k as u32)).ok_or_else(|| {
        let near = suggestion(name, scene.phases.iter().map(String::as_str));
        format!("there is no phase called `{name}`{near}")
    })
}

/// The particles of one phase, or all of them.
pub(crate) enum CountedPhase<'a> {
    /// All particles.
    All,
    /// Those whose phase has this number.
    Of(&'a [u32], u32),
}

impl<'a> CountedPhase<'a> {
    /// Those of the phase `name` with its `number` as [`Probe::prepare`](crate::Probe) found it.
    ///
    /// # Errors
    /// If the phase is named and its number was not set.
    pub fn in_phase<const D: usize>(
        world: &'a World<D>,
        name: Option<&str>,
        number: Option<u32>,
    ) -> Result<Self, StepError> {
        match (name, number) {
            (None, _) => Ok(CountedPhase::All),
            // A scene of one phase has no column of phases.
            (_, Some(0)) if !world.free.has(fields::PHASE.name) => Ok(CountedPhase::All),
            (_, Some(k)) if !world.free.has(fields::PHASE.name) => Ok(CountedPhase::Of(&[], k)),
            (_, Some(k)) => Ok(CountedPhase::Of(world.free.get(fields::PHASE)?, k)),
            (Some(name), None) => {
                let reason = format!("the number of the phase `{name}` is not known yet");
                Err(refused("probes", reason))
            }
        }
    }

    /// Those of some values of all particles that belong to particles that count.
    pub fn among<'v, T>(&'v self, values: &'v [T]) -> impl Iterator<Item = &'v T> {
        let numbered = values.iter().enumerate();
        numbered
            .filter(|(k, _)| self.has(*k))
            .map(|(_, value)| value)
    }

    /// True if particle `k` counts.
    pub fn has(&self, k: usize) -> bool {
        match self {
            CountedPhase::All => true,
            CountedPhase::Of(phases, number) => phases.get(k) == Some(number),
        }
    }
}

/// Particles around the vertical line over a place, which a wall may carry: place from the line's foot, volume, number.
///
/// Volumes are at most a cell δr^d: a drop alone has a small density and a volume of several
/// cells, and is no surface.
pub(crate) fn column<const D: usize>(
    world: &World<D>,
    at: &[f64],
    follows: Option<&str>,
) -> Result<Vec<(Vect<D>, f64, usize)>, StepError> {
    let mut foot = carried(world, point(&at[..at.len().min(D - 1)]), follows)?;
    foot[D - 1] = 0.0;
    let positions = world.free.get(fields::POSITION)?;
    let volume = world.free.get(fields::VOLUME)?;
    let radius = world.kernel.support_radius();
    let cell = world.spacing.powi(D as i32);
    let all = positions.iter().zip(volume).enumerate();
    let placed = all.map(|(k, (x, v))| (world.domain.nearest_image(x - foot), v.min(cell), k));
    let near = |d: &Vect<D>| (0..D - 1).map(|k| d[k] * d[k]).sum::<f64>() < radius * radius;
    Ok(placed.filter(|(d, ..)| near(d)).collect())
}

/// The lowest and the highest of these particles.
pub(crate) fn ends<const D: usize>(near: &[(Vect<D>, f64, usize)]) -> [f64; 2] {
    let [[bottom], [top]] = bounds(near.iter().map(|(d, ..)| [d[D - 1]]));
    [bottom, top]
}

/// The place between two heights at which a condition that holds at the first ends, by halving 30 times.
pub(crate) fn bisected(mut first: f64, mut last: f64, holds: impl Fn(f64) -> bool) -> f64 {
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
pub(crate) fn share<const D: usize>(world: &World<D>, d: &Vect<D>, v: f64, z: f64) -> f64 {
    let mut d = *d;
    d[D - 1] -= z;
    let r = d.norm();
    match r < world.kernel.support_radius() {
        true => v * world.kernel.at(r).0,
        false => 0.0,
    }
}
