//! The sweeps: one walk over the neighbours of every particle.

use rayon::prelude::*;
use sph_core::{StepError, Vect, fields};
use sph_kernels::Sampler;

use crate::list::CHUNK;
use crate::term::{Interaction, Rates, RowTerm, TRANSPORTED, There};
use crate::{Domain, NeighbourList, Neighbourhood, Scratch, World};

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
    let sums = Sums {
        acceleration,
        scalar,
        more: &mut [],
    };
    all_sums(world, states, terms, sums)
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

/// As [`interactions`], with further scalars.
///
/// # Errors
/// If a term misses a column.
pub fn all_sums<const D: usize>(
    world: &World<D>,
    states: &mut Vec<There<D>>,
    terms: &[Box<dyn Interaction<D>>],
    sums: Sums<'_, D>,
) -> Result<(), StepError> {
    let bound = terms.iter().map(|t| declared(world, &**t));
    let bound = bound.collect::<Result<Vec<_>, _>>()?;
    pack(world, states, Packed::of(terms.iter().map(|t| &**t)))?;
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
    if !cfg!(debug_assertions) {
        return term.bind(world);
    }
    world.free.watch(&term.access());
    let bound = term.bind(world);
    world.free.unwatch(&term.name()).and(bound)
}

/// Which columns of neighbours are packed: those that some term declares.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Packed {
    velocity: bool,
    volume: bool,
    pressure: bool,
    density: bool,
}

impl Packed {
    /// What these terms read of neighbours.
    pub fn of<'t, const D: usize>(terms: impl IntoIterator<Item = &'t dyn Interaction<D>>) -> Self {
        terms.into_iter().fold(Packed::default(), Packed::and)
    }

    fn and<const D: usize>(self, term: &dyn Interaction<D>) -> Self {
        let access = term.access();
        let reads = |name: &str| access.neighbours.iter().any(|f| f.name == name);
        Packed {
            velocity: self.velocity || reads(fields::VELOCITY.name),
            volume: self.volume || reads(fields::VOLUME.name),
            pressure: self.pressure || reads(fields::PRESSURE.name),
            density: self.density || reads(fields::DENSITY.name),
        }
    }
}

/// Packs what most terms read of a neighbour. What no term declares is not a number.
///
/// # Errors
/// If a declared column is missing.
pub fn pack<const D: usize>(
    world: &World<D>,
    states: &mut Vec<There<D>>,
    packed: Packed,
) -> Result<(), StepError> {
    let free = &world.free;
    let column = |field, wanted: bool| match wanted {
        true => free.get(field),
        false => Ok(&[][..]),
    };
    let velocity = match packed.velocity {
        true => free.get(fields::VELOCITY)?,
        false => &[],
    };
    let volume = column(fields::VOLUME, packed.volume)?;
    let pressure = column(fields::PRESSURE, packed.pressure)?;
    let density = column(fields::DENSITY, packed.density)?;
    let scalar = |column: &[f64], i: usize| column.get(i).copied().unwrap_or(f64::NAN);
    let nowhere = || Vect::from_element(f64::NAN);
    let one = |i: usize| There {
        velocity: velocity.get(i).copied().unwrap_or_else(nowhere),
        volume: scalar(volume, i),
        pressure: scalar(pressure, i),
        density: scalar(density, i),
    };
    let all = (0..free.len()).into_par_iter().with_min_len(2048);
    all.map(one).collect_into_vec(states);
    Ok(())
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
    if !more.is_empty() {
        let mut unused = Vec::new();
        let scalar = match scalar {
            Some(scalar) => scalar,
            None => {
                unused.resize(acceleration.len(), 0.0);
                &mut unused[..]
            }
        };
        let all = acceleration
            .par_chunks_mut(CHUNK)
            .zip(scalar.par_chunks_mut(CHUNK));
        all.zip(more.par_chunks_mut(CHUNK))
            .enumerate()
            .for_each_init(new_scratch, |scratch, (c, ((a, s), m))| {
                for i in 0..a.len() {
                    let rates = work(c * CHUNK, scratch, i);
                    (a[i], s[i], m[i]) = (rates.acceleration, rates.scalar, rates.more);
                }
            });
        return Ok(());
    }
    match scalar {
        Some(scalar) => acceleration
            .par_chunks_mut(CHUNK)
            .zip(scalar.par_chunks_mut(CHUNK))
            .enumerate()
            .for_each_init(new_scratch, |scratch, (c, (a, s))| {
                for i in 0..a.len() {
                    let rates = work(c * CHUNK, scratch, i);
                    a[i] = rates.acceleration;
                    s[i] = rates.scalar;
                }
            }),
        None => acceleration
            .par_chunks_mut(CHUNK)
            .enumerate()
            .for_each_init(new_scratch, |scratch, (c, a)| {
                for (i, a) in a.iter_mut().enumerate() {
                    *a = work(c * CHUNK, scratch, i).acceleration;
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

fn wrapping<'a, const D: usize>(
    domain: &'a Domain<D>,
    x: &Vect<D>,
    reach: f64,
) -> Option<&'a Domain<D>> {
    // The particle itself may have left the box by up to the skin since the last build.
    domain.near_periodic_face(x, 2.0 * reach).then_some(domain)
}

/// Σ θ_b w_ab over free neighbours, wall points and the particle itself, 1/m^d.
///
/// Since it looks at all distances, it also leaves the list without its skin in
/// [`Lists::pruned`](crate::Lists::pruned) for the sweeps that follow at the same positions.
///
/// # Errors
/// If the world has no positions.
pub fn kernel_sums<const D: usize>(
    world: &mut World<D>,
    sums: &mut [f64],
) -> Result<(), StepError> {
    let mut pruned = std::mem::take(&mut world.lists.spare);
    let positions = world.free.get(fields::POSITION)?;
    let points = &world.walls.points;
    let list = &world.lists.free;
    let kernel = &*world.kernel;
    let own = kernel.value_at_zero();
    let limit = kernel.support_radius().powi(2);
    let row = |values: &mut Values, i: usize, slots: &mut [u32]| {
        let x = &positions[i];
        let domain = wrapping(&world.domain, x, world.reach());
        let (n, w) = values.prune(x, positions, list.row(i), limit, domain, kernel, slots);
        let mut sum = own + total(w);
        if points.in_sums() {
            let row = world.lists.wall.row(i);
            if !row.is_empty() {
                let w = values.fill(x, &points.position, row, domain, kernel);
                let shares = row.iter().map(|&v| points.share[v as usize]);
                sum += w
                    .iter()
                    .zip(shares)
                    .map(|(w, share)| w * share)
                    .sum::<f64>();
            }
        }
        (n, sum)
    };
    pruned.fill_rows(sums, |i| list.row(i).len(), Values::default, row);
    world.lists.pruned = Some(pruned);
    Ok(())
}

/// Calls `use_row(target, candidates, w)` for every target and collects what it returns: the
/// walk behind Shepard means at walls and probes. `w` is exactly zero beyond the support.
pub fn shepard<const D: usize, R: Send>(
    world: &World<D>,
    targets: &[Vect<D>],
    list: &NeighbourList,
    use_row: impl Fn(usize, &[u32], &[f64]) -> R + Sync,
) -> Result<Vec<R>, StepError> {
    let all = shepard_some(world, targets, list, |_, _| true, use_row)?;
    Ok(all.into_iter().flatten().collect())
}

/// The same for the targets whose candidates are `wanted`; no kernel value is taken for the others.
pub fn shepard_some<const D: usize, R: Send>(
    world: &World<D>,
    targets: &[Vect<D>],
    list: &NeighbourList,
    wanted: impl Fn(usize, &[u32]) -> bool + Sync,
    use_row: impl Fn(usize, &[u32], &[f64]) -> R + Sync,
) -> Result<Vec<Option<R>>, StepError> {
    let positions = world.free.get(fields::POSITION)?;
    let kernel = &*world.kernel;
    Ok(targets
        .par_iter()
        .enumerate()
        .with_min_len(CHUNK)
        .map_init(Values::default, |values, (t, x)| {
            let row = list.row(t);
            wanted(t, row).then(|| {
                let domain = world.domain.any_periodic().then_some(&world.domain);
                let w = values.fill(x, positions, row, domain, kernel);
                use_row(t, row, w)
            })
        })
        .collect())
}

#[derive(Default)]
struct Values {
    distance2: Vec<f64>,
    value: Vec<f64>,
}

impl Values {
    fn reserve(&mut self, n: usize) {
        if self.value.len() < n {
            self.distance2.resize(n.next_power_of_two(), 0.0);
            self.value.resize(n.next_power_of_two(), 0.0);
        }
    }

    /// Kernel values of the candidates within the support; their indices go to `slots`.
    #[allow(clippy::too_many_arguments)]
    fn prune<const D: usize>(
        &mut self,
        x: &Vect<D>,
        sources: &[Vect<D>],
        candidates: &[u32],
        limit: f64,
        domain: Option<&Domain<D>>,
        kernel: &dyn Sampler,
        slots: &mut [u32],
    ) -> (usize, &[f64]) {
        let m = candidates.len();
        self.reserve(m);
        let (distance2, slots) = (&mut self.distance2[..m], &mut slots[..m]);
        let mut n = 0;
        for &j in candidates {
            let mut d = x - sources[j as usize];
            if let Some(domain) = domain {
                d = domain.nearest_image(d);
            }
            let r2 = d.norm_squared();
            slots[n] = j;
            distance2[n] = r2;
            n += usize::from(r2 < limit);
        }
        kernel.value(&distance2[..n], &mut self.value[..n]);
        (n, &self.value[..n])
    }

    fn fill<const D: usize>(
        &mut self,
        x: &Vect<D>,
        sources: &[Vect<D>],
        candidates: &[u32],
        domain: Option<&Domain<D>>,
        kernel: &dyn Sampler,
    ) -> &[f64] {
        let n = candidates.len();
        self.reserve(n);
        let distance2 = &mut self.distance2[..n];
        match domain {
            None => {
                for (r2, &j) in distance2.iter_mut().zip(candidates) {
                    *r2 = (x - sources[j as usize]).norm_squared();
                }
            }
            Some(domain) => {
                for (r2, &j) in distance2.iter_mut().zip(candidates) {
                    *r2 = domain.nearest_image(x - sources[j as usize]).norm_squared();
                }
            }
        }
        kernel.value(distance2, &mut self.value[..n]);
        &self.value[..n]
    }
}

/// A sum over four lanes in a fixed order.
fn total(values: &[f64]) -> f64 {
    let (whole, rest) = values.as_chunks::<4>();
    let mut lanes = [0.0; 4];
    for chunk in whole {
        for k in 0..4 {
            lanes[k] += chunk[k];
        }
    }
    (lanes[0] + lanes[2]) + (lanes[1] + lanes[3]) + rest.iter().sum::<f64>()
}
