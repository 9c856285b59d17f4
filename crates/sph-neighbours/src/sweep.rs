//! The sweep: one walk over the neighbours of every particle sums all terms.

use std::borrow::Borrow;

use rayon::prelude::*;
use sph_core::{Access, StepError, Vect, fields};
use sph_kernels::Sampler;
use sph_kernels::lanes::{MOST, Width, width};

use crate::cluster::{Buffers, Cluster};
use crate::half::is_wanted;
use crate::list::CHUNK;
use crate::members::{Members, groups};
use crate::scaling::Scaling;
use crate::term::{Interaction, RowTerm, WithTerm};
use crate::{Clusters, Domain, NOBODY, Neighbourhood, Rates, TRANSPORTED, World};

/// Sums all terms of all particles.
///
/// `rates` receives accelerations, starting from gravity and driving; `scalar`, where the
/// formulation evolves one, its rate. One virtual call per cluster and term.
///
/// # Errors
/// If a term misses a column.
pub fn interactions<const D: usize>(
    world: &World<D>,
    terms: &[Box<dyn Interaction<D>>],
    acceleration: &mut [Vect<D>],
    scalar: Option<&mut [f64]>,
) -> Result<(), StepError> {
    let sums = Sums {
        acceleration,
        scalar,
        more: &mut [],
    };
    all_sums(world, &declared(terms), terms, sums)
}

/// Declarations of the terms: asked once and not in every step.
pub fn declared<const D: usize>(terms: &[Box<dyn Interaction<D>>]) -> Vec<Access> {
    terms.iter().map(|term| term.access()).collect()
}

/// Sums of a sweep, one entry per particle.
pub struct Sums<'a, const D: usize> {
    /// Accelerations, m/s².
    pub acceleration: &'a mut [Vect<D>],
    /// Rates of the formulation's scalar, where it evolves one.
    pub scalar: Option<&'a mut [f64]>,
    /// Rates of the scalars of [`World::transported`]; empty if there is none.
    pub more: &'a mut [[f64; TRANSPORTED]],
}

/// As [`interactions`], with further scalars, for terms that have [`declared`] their columns.
///
/// # Errors
/// If a term misses a column.
pub fn all_sums<const D: usize>(
    world: &World<D>,
    declared: &[Access],
    terms: &[Box<dyn Interaction<D>>],
    sums: Sums<'_, D>,
) -> Result<(), StepError> {
    let mut sums = Some(sums);
    with_all(
        world,
        declared,
        terms,
        None,
        &mut |term| match sums.take() {
            Some(sums) => interactions_with(world, &*world.kernel, term, sums),
            None => Ok(()),
        },
    )
}

/// Passes all terms as one to `with`, each held to its declaration while it looks its columns up.
///
/// Every term is on the stack of the one before it, so that no step allocates memory.
pub(crate) fn with_all<'t, const D: usize, T: Borrow<dyn Interaction<D> + 't>>(
    world: &World<D>,
    declared: &[Access],
    terms: &[T],
    before: Option<&dyn RowTerm<D>>,
    with: &mut WithTerm<'_, D>,
) -> Result<(), StepError> {
    let Some((term, rest)) = terms.split_first() else {
        return with(before.unwrap_or(&NoTerms));
    };
    let term = term.borrow();
    let (own, others) = declared.split_first().unzip();
    world.free.watch(own);
    let others = others.unwrap_or_default();
    let mut looked_up = false;
    let done = term.with_columns(world, &mut |bound| {
        looked_up = true;
        world.free.unwatch(|| term.name())?;
        match before {
            None => with_all(world, others, rest, Some(bound), with),
            Some(before) => with_all(world, others, rest, Some(&TermChain(before, bound)), with),
        }
    });
    match looked_up {
        true => done,
        false => world.free.unwatch(|| term.name()).and(done),
    }
}

/// A sweep without terms.
struct NoTerms;

impl<const D: usize> RowTerm<D> for NoTerms {
    fn row(&self, _: &Neighbourhood<'_, D>, _: &mut Rates<D>) {}
    fn cluster(&self, _: &mut Cluster<'_, D>, _: &mut [Rates<D>]) {}
}

/// A term after those before it.
struct TermChain<'a, const D: usize>(&'a dyn RowTerm<D>, &'a dyn RowTerm<D>);

impl<const D: usize> RowTerm<D> for TermChain<'_, D> {
    fn row(&self, neighbourhood: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        self.0.row(neighbourhood, rates);
        self.1.row(neighbourhood, rates);
    }
    fn cluster(&self, cluster: &mut Cluster<'_, D>, rates: &mut [Rates<D>]) {
        self.0.cluster(cluster, rates);
        self.1.cluster(cluster, rates);
    }
}

/// The sweep for a kernel and a term known by type or as objects.
///
/// # Errors
/// If the world has no positions.
pub fn interactions_with<const D: usize, K, T>(
    world: &World<D>,
    kernel: &K,
    term: &T,
    sums: Sums<'_, D>,
) -> Result<(), StepError>
where
    K: Sampler + ?Sized,
    T: RowTerm<D> + ?Sized,
{
    let sweep = Sweep::new(world, kernel)?;
    let start = Rates::from_acceleration(world.gravity + world.driving);
    let room = || world.lists.pools.sweeps.acquire();
    let half = world.lists.sweep_half.as_ref();
    let work = |room: &mut TaskScratch<D>, block: usize, particles: usize| {
        let (buffers, rates) = room;
        rates.clear();
        rates.resize(particles, start);
        sweep.block(term, |i| is_wanted(half, i), buffers, block, rates);
    };
    // The requested particles of a block, by their places in it.
    let wanted = |(block, k): (usize, usize)| is_wanted(half, block * CHUNK + k);
    let Sums {
        acceleration,
        scalar,
        more,
    } = sums;
    let all = acceleration.par_chunks_mut(CHUNK).enumerate();
    match (scalar, more) {
        (Some(scalar), []) => {
            all.zip(scalar.par_chunks_mut(CHUNK))
                .for_each_init(room, |room, ((c, a), s)| {
                    work(room, c, a.len());
                    let all = a.iter_mut().zip(s).zip(&room.1).enumerate();
                    for (_, ((a, s), rates)) in all.filter(|(k, _)| wanted((c, *k))) {
                        (*a, *s) = (rates.acceleration, rates.scalar);
                    }
                });
        }
        (None, []) => all.for_each_init(room, |room, (c, a)| {
            work(room, c, a.len());
            let all = a.iter_mut().zip(&room.1).enumerate();
            for (_, (a, rates)) in all.filter(|(k, _)| wanted((c, *k))) {
                *a = rates.acceleration;
            }
        }),
        (Some(scalar), more) => {
            let scalars = scalar.par_chunks_mut(CHUNK).zip(more.par_chunks_mut(CHUNK));
            all.zip(scalars)
                .for_each_init(room, |room, ((c, a), (s, m))| {
                    work(room, c, a.len());
                    let all = a.iter_mut().zip(s).zip(m).zip(&room.1).enumerate();
                    for (_, (((a, s), m), rates)) in all.filter(|(k, _)| wanted((c, *k))) {
                        (*a, *s, *m) = (rates.acceleration, rates.scalar, rates.more);
                    }
                });
        }
        (None, more) => {
            all.zip(more.par_chunks_mut(CHUNK))
                .for_each_init(room, |room, ((c, a), m)| {
                    work(room, c, a.len());
                    let all = a.iter_mut().zip(m).zip(&room.1).enumerate();
                    for (_, ((a, m), rates)) in all.filter(|(k, _)| wanted((c, *k))) {
                        (*a, *m) = (rates.acceleration, rates.more);
                    }
                });
        }
    }
    Ok(())
}

/// Accelerations that one term alone gives the particles that are `wanted`; zero for the others.
///
/// # Errors
/// If the term misses a column.
pub fn accelerations_of<const D: usize>(
    world: &World<D>,
    term: &dyn Interaction<D>,
    wanted: impl Fn(usize) -> bool + Sync,
    acceleration: &mut [Vect<D>],
) -> Result<(), StepError> {
    let sweep = Sweep::new(world, &*world.kernel)?;
    let start = Rates::from_acceleration(Vect::zeros());
    term.with_columns(world, &mut |bound| {
        let all = acceleration.par_chunks_mut(CHUNK).enumerate();
        all.for_each_init(
            || world.lists.pools.sweeps.acquire(),
            |room, (c, a)| {
                let (buffers, rates) = &mut **room;
                rates.clear();
                rates.resize(a.len(), start);
                sweep.block(bound, &wanted, buffers, c, rates);
                for (k, (a, rates)) in a.iter_mut().zip(rates.iter()).enumerate() {
                    *a = match wanted(c * CHUNK + k) {
                        true => rates.acceleration,
                        false => Vect::zeros(),
                    };
                }
            },
        );
        Ok(())
    })
}

/// Buffers of a thread, and the rates of its block.
pub(crate) type TaskScratch<const D: usize> = (Buffers<D>, Vec<Rates<D>>);

/// Input of a walk over neighbourhoods.
pub(crate) struct Sweep<'a, const D: usize, K: ?Sized> {
    world: &'a World<D>,
    kernel: &'a K,
    positions: &'a [Vect<D>],
    points: &'a [Vect<D>],
    renormalisation: Option<&'a [f64]>,
    scaling: Option<Scaling<'a, D>>,
    lists: &'a Clusters,
    width: Width,
}

impl<'a, const D: usize, K: Sampler + ?Sized> Sweep<'a, D, K> {
    pub fn new(world: &'a World<D>, kernel: &'a K) -> Result<Self, StepError> {
        Ok(Sweep {
            world,
            kernel,
            positions: world.free.get(fields::POSITION)?,
            points: match world.walls.points.in_sums() {
                true => &world.walls.points.position,
                false => &[],
            },
            renormalisation: world.free.get(fields::RENORMALISATION).ok(),
            scaling: Scaling::from_store(&world.free, &*world.kernel),
            lists: world.lists.nearest(),
            width: width(),
        })
    }

    /// Number of particles.
    pub fn particles(&self) -> usize {
        self.positions.len()
    }

    /// The clusters of a block.
    pub fn clusters(&self, block: usize) -> impl Iterator<Item = Members<'a>> {
        self.lists.of_block(block)
    }

    /// Adds a term's rates to the particles of a block, in clusters with a `wanted` particle.
    fn block<T: RowTerm<D> + ?Sized>(
        &self,
        term: &T,
        wanted: impl Fn(usize) -> bool,
        buffers: &mut Buffers<D>,
        block: usize,
        rates: &mut [Rates<D>],
    ) {
        self.each_wanted(block, wanted, buffers, |cluster| {
            let own = cluster.members();
            let first = own.start - block * CHUNK;
            term.cluster(cluster, &mut rates[first..first + own.len()]);
        });
    }

    /// Calls `visit` with the clusters of a block where anyone is `wanted`.
    pub fn each_wanted(
        &self,
        block: usize,
        wanted: impl Fn(usize) -> bool,
        buffers: &mut Buffers<D>,
        mut visit: impl FnMut(&mut Cluster<'_, D>),
    ) {
        for cluster in self.clusters(block) {
            for members in groups(cluster, self.width.lanes()) {
                let mut own = members.from..members.from + members.count;
                if own.any(&wanted) {
                    visit(&mut self.measured(buffers, members));
                }
            }
        }
    }

    /// A cluster with all inputs of its terms.
    pub fn measured<'b>(
        &'b self,
        buffers: &'b mut Buffers<D>,
        members: Members<'b>,
    ) -> Cluster<'b, D> {
        let world = self.world;
        let hidden = &world.lists.hidden;
        let own = members.from..members.from + members.count;
        let mut inverse_renormalisation = [1.0; MOST];
        if let Some(gamma) = self.renormalisation {
            let gamma = &gamma[own.clone()];
            let both = inverse_renormalisation.iter_mut().zip(gamma);
            both.for_each(|(inverse, gamma)| *inverse = 1.0 / gamma);
        }
        let contacts = &world.walls.contacts;
        let (mut domain, mut beside) = (None, false);
        for (i, row) in own.zip(&mut buffers.walls) {
            beside |= !contacts.of_particle(i).is_empty();
            let x = &self.positions[i];
            let near = wrapping(&world.domain, x, world.reach());
            domain = domain.or(near);
            row.clear();
            if !self.points.is_empty() {
                let candidates = world.lists.wall.row(i);
                if !candidates.is_empty() {
                    row.fill(x, self.points, candidates, NOBODY, near, self.kernel);
                    row.hide(&hidden.points, i);
                    beside = true;
                }
            }
        }
        let (positions, blocked) = (self.positions, &hidden.particles);
        buffers.measure(self.width, members, positions, domain, blocked, self.kernel);
        let scaling = self.scaling.as_ref();
        let scaled = scaling.filter(|scaling| scaling.acts(members));
        if let Some(scaling) = scaled {
            buffers.scale(self.width, members, scaling);
        }
        Cluster {
            width: self.width,
            members,
            contacts,
            inverse_renormalisation,
            limit: self.kernel.support_radius().powi(2),
            scaling,
            scaled: scaled.is_some(),
            beside,
            wraps: domain.is_some(),
            buffers,
        }
    }
}

pub(crate) fn wrapping<'a, const D: usize>(
    domain: &'a Domain<D>,
    x: &Vect<D>,
    reach: f64,
) -> Option<&'a Domain<D>> {
    // The particle itself may have left the box by up to the skin since the last build.
    domain.near_periodic_face(x, 2.0 * reach).then_some(domain)
}
