//! The sweep: one walk over the neighbours of every particle sums all terms.

use std::borrow::Borrow;

use rayon::iter::Either;
use rayon::prelude::*;
use sph_core::{Access, StepError, Vect};
use sph_kernels::Sampler;
use sph_kernels::lanes::{MOST, Width, width};

use crate::lists::members::{Members, groups};
use crate::pairs::cluster::Buffers;
use crate::{
    CHUNK, Cluster, Interaction, Neighbourhood, Rates, RowTerm, Surroundings, TRANSPORTED,
    WithTerm, World, is_wanted,
};

/// Sums all terms of all particles.
///
/// `rates` receives accelerations, starting from gravity and driving; `scalar`, where the
/// formulation evolves one, its rate. One virtual call per cluster and term.
///
/// # Errors
/// If a term misses a column, or the world has no positions; as everywhere below.
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
pub fn all_sums<const D: usize>(
    world: &World<D>,
    declared: &[Access],
    terms: &[Box<dyn Interaction<D>>],
    sums: Sums<'_, D>,
) -> Result<(), StepError> {
    let mut sums = Some(sums);
    let mut with = |term: &dyn RowTerm<D>| match sums.take() {
        Some(sums) => interactions_with(world, &*world.kernel, term, sums),
        None => Ok(()),
    };
    with_all(world, declared, terms, None, &mut with)
}

/// Passes all terms as one to `with`, each held to its declaration while it looks its columns up.
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

struct NoTerms;

impl<const D: usize> RowTerm<D> for NoTerms {
    fn row(&self, _: &Neighbourhood<'_, D>, _: &mut Rates<D>) {}
    fn cluster(&self, _: &mut Cluster<'_, D>, _: &mut [Rates<D>]) {}
}

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
pub fn interactions_with<const D: usize, K: Sampler + ?Sized, T: RowTerm<D> + ?Sized>(
    world: &World<D>,
    kernel: &K,
    term: &T,
    sums: Sums<'_, D>,
) -> Result<(), StepError> {
    let start = Rates::from_acceleration(world.gravity + world.driving);
    let half = world.lists.sweep_half.as_ref();
    sums_from(world, kernel, term, start, |i| is_wanted(half, i), sums)
}

/// The sums of the particles that are `wanted`, from those that each starts with.
fn sums_from<const D: usize, K: Sampler + ?Sized, T: RowTerm<D> + ?Sized>(
    world: &World<D>,
    kernel: &K,
    term: &T,
    start: Rates<D>,
    wanted: impl Fn(usize) -> bool + Sync,
    sums: Sums<'_, D>,
) -> Result<(), StepError> {
    let sweep = Sweep::new(world, kernel)?;
    let count = sums.acceleration.len().div_ceil(CHUNK);
    let more = Some(sums.more).filter(|more| !more.is_empty());
    let all = sums.acceleration.par_chunks_mut(CHUNK);
    let all = all.zip(blocks_of(sums.scalar, count));
    let all = all.zip(blocks_of(more, count));
    let room = || world.lists.pools.sweeps.acquire();
    all.enumerate()
        .for_each_init(room, |room, (block, ((a, mut s), mut m))| {
            let (buffers, rates) = &mut **room;
            rates.clear();
            rates.resize(a.len(), start);
            sweep.each_wanted(block, &wanted, buffers, |cluster| {
                let own = cluster.members();
                let first = own.start - block * CHUNK;
                term.cluster(cluster, &mut rates[first..first + own.len()]);
            });
            let rates = rates.iter().enumerate();
            for (k, rates) in rates.filter(|(k, _)| wanted(block * CHUNK + k)) {
                a[k] = rates.acceleration;
                if let Some(s) = &mut s {
                    s[k] = rates.scalar;
                }
                if let Some(m) = &mut m {
                    m[k] = rates.more;
                }
            }
        });
    Ok(())
}

/// The blocks of a column, or as many times none.
fn blocks_of<T: Send>(
    column: Option<&mut [T]>,
    blocks: usize,
) -> impl IndexedParallelIterator<Item = Option<&mut [T]>> {
    match column {
        Some(column) => Either::Left(column.par_chunks_mut(CHUNK).map(Some)),
        None => Either::Right((0..blocks).into_par_iter().map(|_| None)),
    }
}

/// Accelerations that one term alone gives the particles that are `wanted`; zero for the others.
pub fn accelerations_of<const D: usize>(
    world: &World<D>,
    term: &dyn Interaction<D>,
    wanted: impl Fn(usize) -> bool + Sync,
    acceleration: &mut [Vect<D>],
) -> Result<(), StepError> {
    let blocks = acceleration.par_chunks_mut(CHUNK);
    blocks.for_each(|block| block.fill(Vect::zeros()));
    let start = Rates::from_acceleration(Vect::zeros());
    term.with_columns(world, &mut |bound| {
        let sums = Sums {
            acceleration: &mut *acceleration,
            scalar: None,
            more: &mut [],
        };
        sums_from(world, &*world.kernel, bound, start, &wanted, sums)
    })
}

pub(crate) struct Sweep<'a, const D: usize, K: ?Sized> {
    pub around: Surroundings<'a, D>,
    kernel: &'a K,
    width: Width,
}

impl<'a, const D: usize, K: Sampler + ?Sized> Sweep<'a, D, K> {
    pub fn new(world: &'a World<D>, kernel: &'a K) -> Result<Self, StepError> {
        Ok(Sweep {
            around: Surroundings::new(world)?,
            kernel,
            width: width(),
        })
    }

    pub fn particles(&self) -> usize {
        self.around.particles()
    }

    /// The clusters of a block, each of at most as many particles as there are lanes.
    pub fn clusters(&self, block: usize) -> impl Iterator<Item = Members<'a>> {
        let lanes = self.width.lanes();
        let all = self.around.lists.of_block(block);
        all.flat_map(move |cluster| groups(cluster, lanes))
    }

    /// Calls `visit` with the clusters of a block where anyone is `wanted`.
    pub fn each_wanted(
        &self,
        block: usize,
        wanted: impl Fn(usize) -> bool,
        buffers: &mut Buffers<D>,
        mut visit: impl FnMut(&mut Cluster<'_, D>),
    ) {
        for members in self.clusters(block) {
            if members.range().any(&wanted) {
                visit(&mut self.measured(buffers, members));
            }
        }
    }

    /// A cluster with all inputs of its terms.
    pub fn measured<'b>(
        &'b self,
        buffers: &'b mut Buffers<D>,
        members: Members<'b>,
    ) -> Cluster<'b, D> {
        let around = &self.around;
        let contacts = &around.world.walls.contacts;
        let mut inverse_renormalisation = [1.0; MOST];
        let (mut domain, mut beside) = (None, false);
        for (k, (i, row)) in members.range().zip(&mut buffers.walls).enumerate() {
            inverse_renormalisation[k] = around.inverse_renormalisation(i);
            let near = around.wrapping(i);
            domain = domain.or(near);
            beside |= around.fill_wall(row, i, near, self.kernel);
            beside |= !contacts.of_particle(i).is_empty();
        }
        let (positions, blocked) = (around.position, &around.world.lists.hidden.particles);
        buffers.measure(self.width, members, positions, domain, blocked, self.kernel);
        let scaling = around.scaling.as_ref();
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
