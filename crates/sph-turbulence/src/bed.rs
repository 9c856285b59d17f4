//! Beds of another phase that a fluid takes as rough walls, and surfaces.

mod rough;
mod stage;

use sph_core::{Access, Stage, fields, stage};
use sph_neighbours::{Around, Values, World, walk};

use crate::columns::SURFACE_SHARE;

pub use rough::RoughBed;
pub(crate) use stage::bed_shear;

/// [`SURFACE_SHARE`] = 2C − 1 within 0 and 1, with the concentration C = Σ V w/γ: 1 inside, ½ at a flat free surface. Gradients
/// there are sums over half a support, and drops are not turbulent. Source: ours.
pub(crate) fn surface_share<const D: usize>() -> impl Stage<World<D>> {
    let access = Access::none()
        .here(fields::POSITION)
        .both(fields::VOLUME)
        .where_there(fields::RENORMALISATION)
        .writes(SURFACE_SHARE);
    stage("surface share", access, |world: &mut World<D>| {
        let volume = world.free.get(fields::VOLUME)?;
        let points = &world.walls.points;
        let own = world.kernel.value_at_zero();
        let shares = walk(world, Values::Both, |around: &Around<'_, D>| {
            let rows = &around.rows;
            let free = rows.free.index.iter().zip(around.free);
            let of_free: f64 = free.map(|(&j, w)| volume[j as usize] * w).sum();
            let wall = rows.wall.index.iter().zip(around.wall);
            let part = |v: usize| points.share[v] * points.volume[v];
            let of_wall: f64 = wall.map(|(&v, w)| part(v as usize) * w).sum();
            let filling = volume[rows.particle] * own + of_free + of_wall;
            (2.0 * filling * rows.inverse_renormalisation - 1.0).clamp(0.0, 1.0)
        })?;
        Ok(world.free.put(SURFACE_SHARE, shares)?)
    })
}
