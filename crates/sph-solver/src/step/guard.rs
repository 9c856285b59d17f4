//! The guard: values that end a step.
//!
//! Positions before the lists are built, densities and accelerations after the sweep. What else can become something that is not a
//! number (velocities after a solve, stresses, effective pressures, rates of the density constant) is found by these three in the
//! same step or the next; energies and probes are made of them and change nothing.

use rayon::prelude::*;
use sph_core::{StepError, Vect, fields};
use sph_neighbours::World;
use sph_rheology::state::BoundState;

const BATCH: usize = 4096;

/// The first index, over batches in parallel, at which `bad` holds.
fn first<T: Sync>(column: &[T], bad: impl Fn(usize, &T) -> bool + Sync) -> Option<usize> {
    let in_batch = |(b, batch): (usize, &[T])| {
        // A whole batch is tested without branches; only a bad one is searched.
        let base = b * BATCH;
        let mut all = batch.iter().enumerate();
        let any = (all.clone()).fold(false, |any, (k, x)| any | bad(base + k, x));
        any.then(|| base + all.position(|(k, x)| bad(base + k, x)).unwrap_or(0))
    };
    let batches = column.par_chunks(BATCH).enumerate();
    batches.find_map_first(in_batch)
}

/// Refuses positions that are not finite or outside the domain.
pub fn positions<const D: usize>(world: &World<D>) -> Result<(), StepError> {
    let position = world.free.get(fields::POSITION)?;
    let domain = &world.domain;
    let bad = |x: &Vect<D>| !domain.contains(x) || !x.sum().is_finite();
    let Some(i) = first(position, |_, x| bad(x)) else {
        return Ok(());
    };
    let out = position[i];
    let within = |a: usize| domain.lower[a] <= out[a] && out[a] <= domain.upper[a];
    let axis = (0..D).find(|&a| !out[a].is_finite() || !within(a));
    let value = out[axis.unwrap_or(0)];
    let reason = match value.is_finite() {
        true => "outside the domain",
        false => "not finite",
    };
    Err(world.bad_value("position", i, value, reason))
}

/// Refuses densities outside their bounds and accelerations that are not finite.
pub fn rates<const D: usize>(
    world: &World<D>,
    laws: &[Box<dyn BoundState>],
    bounds: [f64; 2],
) -> Result<(), StepError> {
    let density = world.free.get(fields::DENSITY)?;
    let phase = world.free.get(fields::PHASE).ok();
    let first_of_all = laws[0].reference().density;
    let reference = |i: usize| match phase {
        None => first_of_all,
        Some(phase) => laws[phase[i] as usize].reference().density,
    };
    let [least, most] = bounds;
    let inside = |i: usize, rho: f64| {
        let ratio = rho / reference(i);
        ratio >= least && ratio <= most
    };
    if let Some(i) = first(density, |i, rho| !inside(i, *rho)) {
        let reason = format!("outside {least} to {most} of the reference density");
        return Err(world.bad_value("density", i, density[i], reason));
    }
    let acceleration = world.free.get(fields::ACCELERATION)?;
    if let Some(i) = first(acceleration, |_, a| !a.norm_squared().is_finite()) {
        let value = acceleration[i].norm();
        return Err(world.bad_value("acceleration", i, value, "not finite"));
    }
    Ok(())
}
