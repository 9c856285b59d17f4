//! The world: the running scene for stages and terms.

use std::sync::Arc;

use rayon::prelude::*;
use sph_core::{
    Access, AnyField, Field, FieldError, Kind, Pool, PoolGuard, Role, Scalar, Stage, StepError,
    Store, Vect, fields, stage,
};
use sph_kernels::Sampler;

use crate::decomposition::Link;
use crate::pairs::pools::Pools;
use crate::{CellGrid, Clusters, Domain, Extent, Hidden, SweepHalf, WallPoints, WallSet};

/// The lists between the point sets, valid until [`World::refresh_lists`] rebuilds them.
#[derive(Default)]
pub struct Lists<const D: usize> {
    /// Free particles around clusters of free particles, skin included.
    pub free: Clusters,
    /// The same without the skin, at the present positions; filled by a sweep that computes all
    /// distances anyway ([`kernel_sums`](crate::kernel_sums)), `None` once a particle has moved.
    pub pruned: Option<Clusters>,
    pub(crate) spare: Clusters,
    pub(crate) pools: Pools<D>,
    /// Wall points around free particles.
    pub wall: Clusters,
    /// Free particles around the wall points that are in sums.
    pub of_points: Clusters,
    /// Free particles around element centres; around the corners of elements where walls find the state there and these
    /// are in no sum.
    pub of_elements: Clusters,
    /// Positions of the free particles at the last build, m.
    pub reference: Vec<Vect<D>>,
    /// Positions of the wall points at the last build, m.
    pub reference_points: Vec<Vect<D>>,
    /// Pairs that walls hide from each other; none until the walls give them at the present positions.
    pub hidden: Hidden,
    /// The particles of a sweep that runs in halves.
    pub sweep_half: Option<SweepHalf>,
    /// Builds so far.
    pub builds: u64,
    /// Time of the last build, s: the walls were where they are at that time.
    pub time: f64,
}

impl<const D: usize> Lists<D> {
    /// The shortest lists of free particles that hold at the present positions.
    pub fn nearest(&self) -> &Clusters {
        self.pruned.as_ref().unwrap_or(&self.free)
    }

    /// Free particles around the corners of elements, where walls find the state there.
    pub fn of_corners(&self, points: &WallPoints<D>) -> &Clusters {
        match points.corners {
            0 => &self.of_points,
            _ => &self.of_elements,
        }
    }
}

/// A stage of a name in plans and the columns that it reads, which fills one column.
pub fn column_stage<const D: usize, K: Kind + Send>(
    name: &'static str,
    access: Access,
    field: Field<K>,
    mut fill: impl FnMut(&World<D>, &mut [K::Item<D>]) -> Result<(), StepError> + Send,
) -> impl Stage<World<D>> {
    stage(name, access.writes(field), move |world: &mut World<D>| {
        let mut column = world.free.take(field)?;
        fill(world, &mut column)?;
        Ok(world.free.put(field, column)?)
    })
}

/// Columns, walls, lists, kernel and clock.
pub struct World<const D: usize> {
    /// Columns of the free particles.
    pub free: Store<D>,
    /// The walls.
    pub walls: WallSet<D>,
    /// The neighbour lists.
    pub lists: Lists<D>,
    /// The box.
    pub domain: Domain<D>,
    /// The kernel at this scene's smoothing length.
    pub kernel: Box<dyn Sampler>,
    /// Initial particle spacing δr, m.
    pub spacing: f64,
    /// Skin of the lists as a share of the support radius.
    pub skin: f64,
    /// Hydrostatic gravity of this moment, m/s².
    pub gravity: Vect<D>,
    /// The part of it that is constant in time, m/s², and has a potential.
    pub steady_gravity: Vect<D>,
    /// Body acceleration that drives a periodic flow and is not balanced by pressure, m/s².
    pub driving: Vect<D>,
    /// Time, s.
    pub time: f64,
    /// The step in force, s: the last one taken, or the first estimate.
    pub dt: f64,
    /// Rates that the sweep sums in [`Rates::more`](crate::Rates), in the order of the slots.
    pub transported: Vec<AnyField>,
    /// That of all particles, where others hold some of them; `None` where all are here.
    pub extent: Option<Extent<D>>,
    /// Other ranks with particles of this flow; `None` where all are here.
    pub communicator: Option<Arc<Link>>,
}

impl<const D: usize> World<D> {
    /// The place in [`Rates::more`](crate::Rates) where a term adds to the rate of a scalar of its own.
    ///
    /// # Errors
    /// If no term of the sweep declares to write it.
    pub fn slot(&self, rate: Field<Scalar>) -> Result<usize, FieldError> {
        let found = self.transported.iter().position(|f| f.name == rate.name);
        found.ok_or(FieldError::Missing(rate.name))
    }

    /// Wall points that may be within the support of a particle.
    #[inline(always)]
    pub(crate) fn wall_candidates(&self, particle: usize) -> &[u32] {
        match self.walls.points.in_sums() && !self.lists.wall.is_empty() {
            true => self.lists.wall.candidates(particle),
            false => &[],
        }
    }

    /// The error of a step in which a particle has an impossible value of a quantity.
    pub fn bad_value(
        &self,
        quantity: &'static str,
        particle: usize,
        value: f64,
        reason: impl Into<String>,
    ) -> StepError {
        let position = self.free.get(fields::POSITION).map(|p| p[particle]);
        let position: Vect<D> = position.unwrap_or_else(|_| Vect::zeros());
        let identity = self.free.get(fields::IDENTITY).map(|i| i[particle]);
        StepError::Bad {
            quantity,
            particle: identity.unwrap_or(particle as u32),
            position: position.iter().copied().collect(),
            value,
            reason: reason.into(),
        }
    }

    /// γ of density sums; none where it is 1.
    pub fn sum_renormalisation(&self) -> Option<&[f64]> {
        match self.walls.scales {
            true => None,
            false => self.free.get(fields::RENORMALISATION).ok(),
        }
    }

    /// Support radius plus skin, m.
    pub fn reach(&self) -> f64 {
        self.kernel.support_radius() * (1.0 + self.skin)
    }

    /// True if a particle moved so far that the lists may miss a pair.
    ///
    /// # Errors
    /// If there is no position column, as everywhere below.
    pub fn lists_expired(&self) -> Result<bool, FieldError> {
        let positions = self.free.get(fields::POSITION)?;
        if self.lists.builds == 0 || positions.len() != self.lists.reference.len() {
            return Ok(true);
        }
        let free = largest_step(positions, &self.lists.reference);
        let points = &self.walls.points.position;
        let wall = if *points == self.lists.reference_points {
            0.0
        } else {
            largest_step(points, &self.lists.reference_points)
        };
        let skin = self.skin * self.kernel.support_radius();
        // Not "<=": a step that is not a number must expire the lists, too.
        Ok(!(2.0 * free.max(wall) < skin && free + wall < skin))
    }

    /// Sorts the particles by cell, and in a cell by identity, and builds all lists anew.
    pub fn rebuild_lists(&mut self) -> Result<(), FieldError> {
        self.wrap()?;
        let order = self.order()?;
        self.rebuild_lists_in(order.as_deref())
    }

    /// The same for particles whose [order](Self::order) is known.
    pub fn rebuild_lists_in(&mut self, order: Option<&[u32]>) -> Result<(), FieldError> {
        if let Some(order) = order {
            self.free.permute(Role::State, order);
        }
        let lists = &mut self.lists;
        let [mut positions, mut points] =
            [&mut lists.reference, &mut lists.reference_points].map(std::mem::take);
        positions.clear();
        positions.extend_from_slice(self.free.get(fields::POSITION)?);
        points.clone_from(&self.walls.points.position);
        self.build_lists_from(positions, points, self.time);
        Ok(())
    }

    /// Puts the particles into the order of lists at their places, without building these: for a rank that sends most
    /// of them away.
    pub fn sort(&mut self) -> Result<(), FieldError> {
        self.wrap()?;
        if let Some(order) = self.order()? {
            self.free.permute(Role::State, &order);
        }
        let places = self.free.get(fields::POSITION)?.to_vec();
        self.lists_would_be_of(places, self.walls.points.position.clone(), self.time);
        Ok(())
    }

    /// Moves particles into the box along its periodic axes.
    pub fn wrap(&mut self) -> Result<(), FieldError> {
        let domain = &self.domain;
        if domain.periodic.contains(&true) {
            let positions = self.free.get_mut(fields::POSITION)?;
            let all = positions.par_iter_mut();
            all.for_each(|x| *x = domain.wrapped(*x));
        }
        Ok(())
    }

    /// The order of lists at the present positions; `None` if the particles have it.
    pub fn order(&self) -> Result<Option<Vec<u32>>, FieldError> {
        Ok(self.order_at(self.free.get(fields::POSITION)?))
    }

    /// The order of lists at other positions; `None` if the particles have it.
    pub fn order_at(&self, positions: &[Vect<D>]) -> Option<Vec<u32>> {
        let mut grid = self.grid(positions, &self.lists.pools.grids);
        if let Ok(identities) = self.free.get(fields::IDENTITY) {
            grid.order_by(identities);
        }
        (!grid.is_sorted()).then(|| grid.order().to_vec())
    }

    fn grid<'s>(
        &self,
        positions: &[Vect<D>],
        pool: &'s Pool<CellGrid<D>>,
    ) -> PoolGuard<'s, CellGrid<D>> {
        let mut grid = pool.acquire();
        let (among, reach) = (self.extent.as_ref(), self.reach());
        grid.renew(among, positions, reach, &self.domain);
        grid
    }

    /// Gives back the memory of all lists, which have to be built before neighbours are read.
    pub fn forget_lists(&mut self) {
        let lists = &mut self.lists;
        lists.pruned = None;
        lists.free = Clusters::default();
        lists.spare = Clusters::default();
        lists.of_points = Clusters::default();
        lists.of_elements = Clusters::default();
        lists.wall = Clusters::default();
        lists.pools = Pools::default();
    }

    /// Remembers where lists were built, without building them: for a process that has the columns of a flow and needs
    /// no list.
    pub fn lists_would_be_of(&mut self, positions: Vec<Vect<D>>, points: Vec<Vect<D>>, time: f64) {
        self.lists.reference = positions;
        self.lists.reference_points = points;
        self.lists.time = time;
    }

    /// Builds all lists for given positions of the (sorted) free particles and wall points, those of a time, s.
    ///
    /// A resumed run passes positions and time of the last build, so that its lists, and with them
    /// the order of its sums, are those of the run that was interrupted.
    pub fn build_lists_from(&mut self, positions: Vec<Vect<D>>, points: Vec<Vect<D>>, time: f64) {
        // Grids stand on it while the lists are changed.
        let pools = std::mem::take(&mut self.lists.pools);
        self.build_lists_on(&pools, &positions, &points);
        self.lists.pools = pools;
        self.lists_would_be_of(positions, points, time);
        self.lists.builds += 1;
        // The particles may have been sorted.
        self.lists.hidden = Hidden::default();
    }

    fn build_lists_on(&mut self, pools: &Pools<D>, positions: &[Vect<D>], points: &[Vect<D>]) {
        let reach = self.reach();
        let idle = self.idle();
        let grid = self.grid(positions, &pools.grids);
        let lists = &mut self.lists;
        let domain = &self.domain;
        let idle = idle.as_deref().filter(|idle| idle.len() == positions.len());
        let (within, pool) = ((reach, domain), &pools.clusters);
        lists.free.build([positions; 2], &grid, within, pool, idle);
        if self.walls.points.in_sums() {
            let first = self.walls.points.corners;
            let summed = &points[first..];
            let mut wall_grid = pools.grids.acquire();
            wall_grid.renew(None, summed, reach, domain);
            let wall = &mut lists.wall;
            wall.build_each([positions, summed], &wall_grid, within, pool);
            wall.shift(first as u32);
            let list = &mut lists.of_points;
            list.build([summed, positions], &grid, within, pool, None);
        }
        let elements = &self.walls.elements;
        if elements.centre.is_empty() || (self.walls.at_corners && self.walls.points.corners == 0) {
            return;
        }
        let mut places = pools.centres.acquire();
        places.clear();
        match self.walls.at_corners {
            true => places.extend_from_slice(&points[..self.walls.points.corners]),
            // An element stands where its corners stood.
            false => {
                let all = 0..elements.centre.len();
                places.extend(all.map(|s| elements.centre_from(s, points, domain)));
            }
        }
        let list = &mut lists.of_elements;
        list.build([&places, positions], &grid, within, pool, None);
    }

    /// Drops the lists that hold at the positions of before.
    pub fn forget_pruned(&mut self) {
        if let Some(pruned) = self.lists.pruned.take() {
            self.lists.spare = pruned;
        }
    }

    /// Rebuilds the lists if they expired; returns whether it did.
    pub fn refresh_lists(&mut self) -> Result<bool, FieldError> {
        self.forget_pruned();
        let expired = self.lists_expired()?;
        if expired {
            self.rebuild_lists()?;
        }
        Ok(expired)
    }
}

fn largest_step<const D: usize>(now: &[Vect<D>], then: &[Vect<D>]) -> f64 {
    let both = now.par_iter().zip(then).with_min_len(1024);
    let steps = both.map(|(a, b)| {
        let step = (a - b).norm_squared();
        // A NaN must win the maximum.
        if step.is_nan() { f64::INFINITY } else { step }
    });
    steps.reduce(|| 0.0, f64::max).sqrt()
}
