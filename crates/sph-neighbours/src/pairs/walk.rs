//! Walks that make something else than rates of the neighbourhoods.

use sph_core::{StepError, Vect, fields};
use sph_kernels::Sampler;

use crate::{
    CHUNK, Clusters, Domain, NOBODY, Neighbourhood, Rows, Scaling, Scratch, World, each_block,
};

/// Finds neighbourhoods one by one, with the buffers of one thread.
pub struct Surroundings<'w, const D: usize> {
    pub(crate) world: &'w World<D>,
    pub(crate) position: &'w [Vect<D>],
    renormalisation: Option<&'w [f64]>,
    pub(crate) scaling: Option<Scaling<'w, D>>,
    pub(crate) lists: &'w Clusters,
}

impl<'w, const D: usize> Surroundings<'w, D> {
    /// Of the particles of a world at their present places.
    ///
    /// # Errors
    /// If the world has no positions, as everywhere below.
    pub fn new(world: &'w World<D>) -> Result<Self, StepError> {
        Ok(Surroundings {
            world,
            position: world.free.get(fields::POSITION)?,
            renormalisation: world.free.get(fields::RENORMALISATION).ok(),
            scaling: Scaling::from_store(&world.free, &*world.kernel),
            lists: world.lists.nearest(),
        })
    }

    /// Number of particles.
    pub fn particles(&self) -> usize {
        self.position.len()
    }

    #[inline(always)]
    pub(crate) fn inverse_renormalisation(&self, particle: usize) -> f64 {
        self.renormalisation.map_or(1.0, |g| 1.0 / g[particle])
    }

    /// The domain, where images across periodic faces may be nearer to a particle.
    pub(crate) fn wrapping(&self, particle: usize) -> Option<&'w Domain<D>> {
        let world = self.world;
        world
            .domain
            .wrapping(&self.position[particle], world.reach())
    }

    /// Fills the row of wall points around a particle; true if there may be any.
    pub(crate) fn fill_wall<K: Sampler + ?Sized>(
        &self,
        row: &mut Scratch<D>,
        particle: usize,
        near: Option<&Domain<D>>,
        kernel: &K,
    ) -> bool {
        row.clear();
        let candidates = self.world.wall_candidates(particle);
        if candidates.is_empty() {
            return false;
        }
        let (x, points) = (&self.position[particle], &self.world.walls.points);
        row.fill(x, &points.position, candidates, NOBODY, near, kernel);
        row.hide(&self.world.lists.hidden.points, particle);
        true
    }

    /// The neighbourhood of a particle.
    pub fn neighbourhood<'a>(
        &'a self,
        particle: usize,
        rows: &'a mut Rows<D>,
    ) -> Neighbourhood<'a, D> {
        let world = self.world;
        let kernel = &*world.kernel;
        let (x, domain) = (&self.position[particle], self.wrapping(particle));
        let (candidates, own) = (self.lists.candidates(particle), particle as u32);
        rows.free
            .fill(x, self.position, candidates, own, domain, kernel);
        rows.free.hide(&world.lists.hidden.particles, particle);
        self.fill_wall(&mut rows.wall, particle, domain, kernel);
        Neighbourhood {
            particle,
            free: rows.free.row(),
            wall: rows.wall.row(),
            contacts: world.walls.contacts.of_particle(particle),
            inverse_renormalisation: self.inverse_renormalisation(particle),
            scaling: self.scaling.as_ref(),
        }
    }
}

/// The neighbourhood of one particle, and kernel values where they were requested.
pub struct Around<'a, const D: usize> {
    /// Rows, contacts and 1/γ.
    pub rows: Neighbourhood<'a, D>,
    /// w of the free row, 1/m^d; empty unless requested.
    pub free: &'a [f64],
    /// w of the wall row, 1/m^d; empty unless requested.
    pub wall: &'a [f64],
}

/// Kernel values of a walk: ∇w alone, or also w.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Values {
    /// ∇w only.
    Gradient,
    /// ∇w and w.
    Both,
}

/// Results of `of` for every particle's neighbourhood, in the order of the particles.
pub fn walk<const D: usize, R: Send>(
    world: &World<D>,
    values: Values,
    of: impl Fn(&Around<'_, D>) -> R + Sync,
) -> Result<Vec<R>, StepError> {
    let all = walk_some(world, values, |_| true, of)?;
    Ok(all.into_iter().flatten().collect())
}

/// The same for some particles only.
pub fn walk_some<const D: usize, R: Send>(
    world: &World<D>,
    values: Values,
    wanted: impl Fn(usize) -> bool + Sync,
    of: impl Fn(&Around<'_, D>) -> R + Sync,
) -> Result<Vec<Option<R>>, StepError> {
    let mut all: Vec<Option<R>> = Vec::new();
    all.resize_with(world.free.len(), || None);
    walk_into(world, values, wanted, &mut all, |around| Some(of(around)))?;
    Ok(all)
}

/// The same, into a place per particle; those of particles that are not wanted stay as they are.
pub fn walk_into<const D: usize, R: Send>(
    world: &World<D>,
    values: Values,
    wanted: impl Fn(usize) -> bool + Sync,
    out: &mut [R],
    of: impl Fn(&Around<'_, D>) -> R + Sync,
) -> Result<(), StepError> {
    let surroundings = Surroundings::new(world)?;
    let kernel = &*world.kernel;
    let one = |(rows, w): &mut (Rows<D>, [Vec<f64>; 2]), i: usize| {
        let rows = surroundings.neighbourhood(i, rows);
        if values == Values::Both {
            for (w, row) in w.iter_mut().zip([rows.free, rows.wall]) {
                w.resize(row.distance2.len(), 0.0);
                kernel.value(row.distance2, w);
            }
        }
        let [free, wall] = match values {
            Values::Both => [&w[0][..], &w[1][..]],
            Values::Gradient => [&[][..]; 2],
        };
        of(&Around { rows, free, wall })
    };
    each_block(out, CHUNK, &|block, out| {
        let mut room = world.lists.pools.walks.acquire();
        for (out, i) in out.iter_mut().zip(block * CHUNK..) {
            if wanted(i) {
                *out = one(&mut room, i);
            }
        }
    });
    Ok(())
}
