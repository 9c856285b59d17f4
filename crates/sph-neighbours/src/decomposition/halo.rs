//! Particles of which a rank needs copies.

use std::collections::BTreeMap;

use rayon::prelude::*;
use sph_core::{FieldError, fields};

use crate::World;
use crate::decomposition::ghosts::{Needs, around_own};

/// Ghosts: particles that others own and a rank needs, because they are within reach of the box around its own, or of
/// a wall that one of its own touches.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Halo {
    /// Number of copies that each rank has from each of the others.
    copies: Vec<BTreeMap<u32, usize>>,
}

impl Halo {
    /// Counts the ghosts of all ranks, where every particle of a world has an owner; `rings` is how often a stage goes from
    /// particles to their neighbours.
    ///
    /// # Errors
    /// If there is no position column.
    pub fn new<const D: usize>(
        world: &World<D>,
        owners: &[u32],
        ranks: usize,
        rings: usize,
    ) -> Result<Self, FieldError> {
        let places = world.free.get(fields::POSITION)?;
        let needs = Needs::new(world, rings);
        let copies = |rank: usize| {
            let around = around_own(places, owners, rank);
            let mut copies = BTreeMap::new();
            for ghost in needs.slots(places, &around, |k| owners[k] as usize != rank) {
                *copies.entry(owners[ghost as usize]).or_default() += 1;
            }
            copies
        };
        let copies = (0..ranks).into_par_iter().map(copies).collect();
        Ok(Halo { copies })
    }

    /// Ghosts that a rank has.
    pub fn ghosts(&self, rank: usize) -> usize {
        self.copies[rank].values().sum()
    }

    /// Particles that a rank sends to others, each as often as it is sent.
    pub fn sent(&self, rank: usize) -> usize {
        let rank = rank as u32;
        self.copies.iter().filter_map(|from| from.get(&rank)).sum()
    }

    /// Ranks that a rank has ghosts of, ascending.
    pub fn partners(&self, rank: usize) -> Vec<usize> {
        let from = self.copies[rank].keys();
        from.map(|from| *from as usize).collect()
    }
}
