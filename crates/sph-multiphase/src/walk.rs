//! The walk of stages that sum something else than rates over their neighbours.

use rayon::prelude::*;
use sph_core::{StepError, fields};
use sph_neighbours::{CHUNK, Neighbourhood, Scratch, World};

/// The neighbourhood of one particle, and kernel values where they were asked for.
pub(crate) struct Around<'a, const D: usize> {
    /// Rows, contacts and 1/γ; there are no packed states.
    pub rows: Neighbourhood<'a, D>,
    /// w of the free row, 1/m^d; empty unless asked for.
    pub free: &'a [f64],
    /// w of the wall row, 1/m^d; empty unless asked for.
    pub wall: &'a [f64],
}

/// Whether a walk evaluates the kernel itself, besides its gradient.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Values {
    /// ∇w only.
    Gradient,
    /// ∇w and w.
    Both,
}

/// What `of` makes of every particle's neighbourhood, in the order of the particles.
pub(crate) fn walk<const D: usize, R: Send>(
    world: &World<D>,
    values: Values,
    of: impl Fn(&Around<'_, D>) -> R + Sync,
) -> Result<Vec<R>, StepError> {
    let all = walk_some(world, values, |_| true, of)?;
    Ok(all.into_iter().flatten().collect())
}

/// The same for some particles only.
pub(crate) fn walk_some<const D: usize, R: Send>(
    world: &World<D>,
    values: Values,
    wanted: impl Fn(usize) -> bool + Sync,
    of: impl Fn(&Around<'_, D>) -> R + Sync,
) -> Result<Vec<Option<R>>, StepError> {
    let positions = world.free.get(fields::POSITION)?;
    let gamma = world.free.get(fields::RENORMALISATION).ok();
    let points = &world.walls.points.position[..];
    let kernel = &*world.kernel;
    let (list, pruned) = match &world.lists.pruned {
        Some(list) => (list, true),
        None => (&world.lists.free, false),
    };
    type Buffers<const D: usize> = ([Scratch<D>; 2], [Vec<f64>; 2]);
    let one = |(scratch, w): &mut Buffers<D>, i: usize| {
        if !wanted(i) {
            return None;
        }
        let x = &positions[i];
        let near = world.domain.near_periodic_face(x, 2.0 * world.reach());
        let domain = near.then_some(&world.domain);
        let [free, wall] = scratch;
        free.fill(x, positions, list.row(i), pruned, domain, kernel);
        wall.clear();
        if !points.is_empty() && !world.lists.wall.row(i).is_empty() {
            wall.fill(x, points, world.lists.wall.row(i), false, domain, kernel);
        }
        if values == Values::Both {
            for (w, row) in w.iter_mut().zip([free.row(), wall.row()]) {
                w.resize(row.distance2.len(), 0.0);
                kernel.value(row.distance2, w);
            }
        }
        Some(of(&Around {
            rows: Neighbourhood {
                particle: i,
                free: free.row(),
                states: &[],
                wall: wall.row(),
                contacts: world.walls.contacts.of(i),
                inverse_renormalisation: gamma.map_or(1.0, |g| 1.0 / g[i]),
            },
            free: &w[0],
            wall: &w[1],
        }))
    };
    let new = || ([Scratch::new(), Scratch::new()], [Vec::new(), Vec::new()]);
    let all = (0..positions.len()).into_par_iter().with_min_len(CHUNK);
    Ok(all.map_init(new, one).collect())
}
