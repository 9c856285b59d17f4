//! The sweep: one walk over the neighbours of every particle sums all terms.

use rayon::prelude::*;
use sph_core::{StepError, Vect, fields};
use sph_kernels::Sampler;

use crate::list::CHUNK;
use crate::packed::{Packed, pack};
use crate::term::{Interaction, Rates, RowTerm, TRANSPORTED};
use crate::{Domain, NeighbourList, Neighbourhood, Scratch, There, World};

/// Sums all terms of all particles.
///
/// `rates` receives accelerations, starting from gravity and driving; `scalar`, where the
/// formulation evolves one, its rate. One virtual call per particle and unfused term.
///
/// `states` is a buffer for the packed states.
///
/// # Errors
/// If a term misses a column.
pub fn interactions<const D: usize>(
    world: &World<D>,
    states: &mut Vec<There<D>>,
    terms: &[Box<dyn Interaction<D>>],
    acceleration: &mut [Vect<D>],
    scalar: Option<&mut [f64]>,
) -> Result<(), StepError> {
    let packed = Packed::of(terms.iter().map(|t| &**t));
    let sums = Sums {
        acceleration,
        scalar,
        more: &mut [],
    };
    all_sums(world, states, packed, terms, sums)
}

/// Where a sweep leaves what it sums, one entry per particle.
pub struct Sums<'a, const D: usize> {
    /// Accelerations, m/s².
    pub acceleration: &'a mut [Vect<D>],
    /// Rates of the formulation's scalar, where it evolves one.
    pub scalar: Option<&'a mut [f64]>,
    /// Rates of the scalars of [`World::transported`]; empty if there is none.
    pub more: &'a mut [[f64; TRANSPORTED]],
}

/// As [`interactions`], with further scalars, for terms that are known to read what is `packed`.
///
/// # Errors
/// If a term misses a column.
pub fn all_sums<const D: usize>(
    world: &World<D>,
    states: &mut Vec<There<D>>,
    packed: Packed,
    terms: &[Box<dyn Interaction<D>>],
    sums: Sums<'_, D>,
) -> Result<(), StepError> {
    let bound = terms.iter().map(|t| declared(world, &**t));
    let bound = bound.collect::<Result<Vec<_>, _>>()?;
    pack(world, states, packed)?;
    let kernel = &*world.kernel;
    match &bound[..] {
        [one] => interactions_with(world, states, kernel, &**one, sums),
        _ => interactions_with(world, states, kernel, &Several(&bound), sums),
    }
}

/// A term with its columns, held to those that it declares.
fn declared<'a, const D: usize>(
    world: &'a World<D>,
    term: &'a dyn Interaction<D>,
) -> Result<Box<dyn RowTerm<D> + 'a>, StepError> {
    world.free.watch(|| term.access());
    let bound = term.bind(world);
    world.free.unwatch(|| term.name()).and(bound)
}

struct Several<'a, 'b, const D: usize>(&'a [Box<dyn RowTerm<D> + 'b>]);

impl<const D: usize> RowTerm<D> for Several<'_, '_, D> {
    fn row(&self, neighbourhood: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        for term in self.0 {
            term.row(neighbourhood, rates);
        }
    }
}

/// The sweep for a kernel and a term known by type or as objects.
///
/// # Errors
/// If the world has no positions.
pub fn interactions_with<const D: usize, K, T>(
    world: &World<D>,
    states: &[There<D>],
    kernel: &K,
    term: &T,
    sums: Sums<'_, D>,
) -> Result<(), StepError>
where
    K: Sampler + ?Sized,
    T: RowTerm<D> + ?Sized,
{
    let sweep = Sweep::new(world, states, kernel)?;
    let start = Rates::of(world.gravity + world.driving);
    let work = |from: usize, scratch: &mut [Scratch<D>; 2], i: usize| {
        sweep.rates(term, start, scratch, from + i)
    };
    let new_scratch = || [Scratch::new(), Scratch::new()];
    let Sums {
        acceleration,
        scalar,
        more,
    } = sums;
    let all = acceleration.par_chunks_mut(CHUNK);
    match (scalar, more) {
        (Some(scalar), []) => all
            .zip(scalar.par_chunks_mut(CHUNK))
            .enumerate()
            .for_each_init(new_scratch, |scratch, (c, (a, s))| {
                for i in 0..a.len() {
                    let rates = work(c * CHUNK, scratch, i);
                    (a[i], s[i]) = (rates.acceleration, rates.scalar);
                }
            }),
        (None, []) => all
            .enumerate()
            .for_each_init(new_scratch, |scratch, (c, a)| {
                for (i, a) in a.iter_mut().enumerate() {
                    *a = work(c * CHUNK, scratch, i).acceleration;
                }
            }),
        (Some(scalar), more) => all
            .zip(scalar.par_chunks_mut(CHUNK))
            .zip(more.par_chunks_mut(CHUNK))
            .enumerate()
            .for_each_init(new_scratch, |scratch, (c, ((a, s), m))| {
                for i in 0..a.len() {
                    let rates = work(c * CHUNK, scratch, i);
                    (a[i], s[i], m[i]) = (rates.acceleration, rates.scalar, rates.more);
                }
            }),
        (None, more) => all
            .zip(more.par_chunks_mut(CHUNK))
            .enumerate()
            .for_each_init(new_scratch, |scratch, (c, (a, m))| {
                for i in 0..a.len() {
                    let rates = work(c * CHUNK, scratch, i);
                    (a[i], m[i]) = (rates.acceleration, rates.more);
                }
            }),
    }
    Ok(())
}

/// Accelerations that one term alone gives the particles that are `wanted`; zero for the others.
///
/// # Errors
/// If the term misses a column.
pub fn accelerations_of<const D: usize>(
    world: &World<D>,
    states: &[There<D>],
    term: &dyn Interaction<D>,
    wanted: impl Fn(usize) -> bool + Sync,
    acceleration: &mut [Vect<D>],
) -> Result<(), StepError> {
    let bound = term.bind(world)?;
    let sweep = Sweep::new(world, states, &*world.kernel)?;
    let start = Rates::of(Vect::zeros());
    let all = acceleration.par_iter_mut().enumerate().with_min_len(CHUNK);
    let new_scratch = || [Scratch::new(), Scratch::new()];
    all.for_each_init(new_scratch, |scratch, (i, a)| {
        *a = match wanted(i) {
            true => sweep.rates(&*bound, start, scratch, i).acceleration,
            false => Vect::zeros(),
        };
    });
    Ok(())
}

/// What a walk over neighbourhoods looks at.
struct Sweep<'a, const D: usize, K: ?Sized> {
    world: &'a World<D>,
    states: &'a [There<D>],
    kernel: &'a K,
    positions: &'a [Vect<D>],
    points: &'a [Vect<D>],
    renormalisation: Option<&'a [f64]>,
    list: &'a NeighbourList,
    /// Whether the list has nobody beyond the support.
    pruned: bool,
}

impl<'a, const D: usize, K: Sampler + ?Sized> Sweep<'a, D, K> {
    fn new(world: &'a World<D>, states: &'a [There<D>], kernel: &'a K) -> Result<Self, StepError> {
        let (list, pruned) = match &world.lists.pruned {
            Some(list) => (list, true),
            None => (&world.lists.free, false),
        };
        Ok(Sweep {
            world,
            states,
            kernel,
            positions: world.free.get(fields::POSITION)?,
            points: match world.walls.points.in_sums() {
                true => &world.walls.points.position,
                false => &[],
            },
            renormalisation: world.free.get(fields::RENORMALISATION).ok(),
            list,
            pruned,
        })
    }

    /// What a term adds to `start` for one particle.
    #[inline(always)]
    fn rates<T: RowTerm<D> + ?Sized>(
        &self,
        term: &T,
        start: Rates<D>,
        scratch: &mut [Scratch<D>; 2],
        i: usize,
    ) -> Rates<D> {
        let world = self.world;
        let x = &self.positions[i];
        let domain = wrapping(&world.domain, x, world.reach());
        let [free, wall] = scratch;
        let row = self.list.row(i);
        free.fill(x, self.positions, row, self.pruned, domain, self.kernel);
        wall.clear();
        if !self.points.is_empty() {
            let candidates = world.lists.wall.row(i);
            if !candidates.is_empty() {
                wall.fill(x, self.points, candidates, false, domain, self.kernel);
            }
        }
        let neighbourhood = Neighbourhood {
            particle: i,
            free: free.row(),
            states: self.states,
            wall: wall.row(),
            contacts: world.walls.contacts.of(i),
            inverse_renormalisation: self.renormalisation.map_or(1.0, |g| 1.0 / g[i]),
        };
        let mut rates = start;
        term.row(&neighbourhood, &mut rates);
        rates
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
