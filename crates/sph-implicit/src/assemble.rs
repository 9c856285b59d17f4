//! From the neighbour lists to a matrix.

use rayon::prelude::*;
use sph_core::{StepError, Vect};
use sph_neighbours::{CHUNK, Neighbourhood, Rows, Surroundings, World};

use crate::{Entry, Pattern, Values};

/// What a row has besides its neighbours, in a system of C components: the dimensions of space for velocities, one for a
/// pressure.
#[derive(Clone, Copy, Debug)]
pub struct Row<E, const C: usize> {
    /// What stands on the diagonal besides the sum of the couplings: mass, walls.
    pub own: E,
    /// Part of the right-hand side.
    pub source: Vect<C>,
}

/// Rows of one chunk of particles.
struct Part<E, const C: usize> {
    counts: Vec<u32>,
    columns: Vec<u32>,
    others: Vec<E>,
    diagonal: Vec<E>,
    sources: Vec<Vect<C>>,
}

/// Buffers of one thread.
struct Buffers<E, const D: usize> {
    rows: Rows<D>,
    couplings: Vec<(u32, E)>,
    /// Columns in the upper half, places in `couplings` in the lower.
    order: Vec<u64>,
}

/// The matrix with −c_ij beside and own_i + Σ_j c_ij on the diagonal, and the sources.
///
/// `row` gets a neighbourhood (without packed states) and writes j and the coupling c_ij for each of its free
/// neighbours that is coupled. The memory of `former` values is used again: to ask for tens of megabytes anew in every step costs
/// a tenth of it.
///
/// # Errors
/// If the world has no positions.
pub fn assemble<const D: usize, const C: usize, E: Entry<C>>(
    world: &World<D>,
    former: Values<E>,
    row: impl Fn(&Neighbourhood<'_, D>, &mut Vec<(u32, E)>) -> Row<E, C> + Sync,
) -> Result<(Pattern, Values<E>, Vec<Vect<C>>), StepError> {
    assemble_some(world, former, |_| None, row)
}

/// The same with some rows that are `known` without their neighbours, to which they are not coupled.
///
/// # Errors
/// If the world has no positions.
pub fn assemble_some<const D: usize, const C: usize, E: Entry<C>>(
    world: &World<D>,
    former: Values<E>,
    known: impl Fn(usize) -> Option<Row<E, C>> + Sync,
    row: impl Fn(&Neighbourhood<'_, D>, &mut Vec<(u32, E)>) -> Row<E, C> + Sync,
) -> Result<(Pattern, Values<E>, Vec<Vect<C>>), StepError> {
    let surroundings = Surroundings::new(world)?;
    let particles = surroundings.particles();
    let one = |buffers: &mut Buffers<E, D>, part: &mut Part<E, C>, i: usize| {
        let couplings = &mut buffers.couplings;
        couplings.clear();
        let row = match known(i) {
            Some(row) => row,
            None => row(&surroundings.of(i, &mut buffers.rows), couplings),
        };
        let mut diagonal = row.own;
        let order = &mut buffers.order;
        order.clear();
        for (k, (j, c)) in couplings.iter().enumerate() {
            diagonal = diagonal.plus(c);
            order.push(u64::from(*j) << 32 | k as u64);
        }
        order.sort_unstable();
        let place = |key: &u64| *key as u32 as usize;
        part.counts.push(order.len() as u32);
        part.columns
            .extend(order.iter().map(|key| (key >> 32) as u32));
        part.others
            .extend(order.iter().map(|key| couplings[place(key)].1.times(-1.0)));
        part.diagonal.push(diagonal);
        part.sources.push(row.source);
    };
    let new = || Buffers {
        rows: Rows::default(),
        couplings: Vec::new(),
        order: Vec::new(),
    };
    let chunks = particles.div_ceil(CHUNK);
    let parts: Vec<Part<E, C>> = (0..chunks)
        .into_par_iter()
        .map_init(new, |buffers, c| {
            let mut part = Part {
                counts: Vec::with_capacity(CHUNK),
                columns: Vec::new(),
                others: Vec::new(),
                diagonal: Vec::with_capacity(CHUNK),
                sources: Vec::with_capacity(CHUNK),
            };
            for i in c * CHUNK..((c + 1) * CHUNK).min(particles) {
                one(buffers, &mut part, i);
            }
            part
        })
        .collect();
    Ok(joined(parts, particles, former))
}

fn joined<const C: usize, E: Entry<C>>(
    parts: Vec<Part<E, C>>,
    rows: usize,
    mut values: Values<E>,
) -> (Pattern, Values<E>, Vec<Vect<C>>) {
    let entries = parts.iter().map(|p| p.columns.len()).sum();
    let mut pattern = Pattern {
        starts: Vec::with_capacity(rows + 1),
        columns: Vec::with_capacity(entries),
    };
    values.diagonal.clear();
    values.diagonal.reserve(rows);
    values.others.resize(entries, E::ZERO);
    let mut rest = &mut values.others[..];
    let mut places = Vec::with_capacity(parts.len());
    for part in &parts {
        let (place, after) = rest.split_at_mut(part.others.len());
        places.push(place);
        rest = after;
    }
    let copied = places.into_par_iter().zip(&parts);
    copied.for_each(|(place, part)| place.copy_from_slice(&part.others));
    let mut sources = Vec::with_capacity(rows);
    let mut start = 0;
    pattern.starts.push(0);
    for part in parts {
        for count in part.counts {
            start += count;
            pattern.starts.push(start);
        }
        pattern.columns.extend(part.columns);
        values.diagonal.extend(part.diagonal);
        sources.extend(part.sources);
    }
    (pattern, values, sources)
}
