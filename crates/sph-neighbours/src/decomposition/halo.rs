//! Particles of which a rank needs copies.

use std::collections::BTreeMap;

use rayon::prelude::*;
use sph_core::{FieldError, fields};

use crate::World;
use crate::decomposition::ghosts::{Needs, RankBox};

/// Ghosts: particles that others own and a rank needs, because they are within reach of the box around its own, or of
/// a wall that one of its own touches.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Halo {
    ranks: usize,
    owned: Vec<usize>,
    /// Number of copies to (first) from (second).
    sent: BTreeMap<[u32; 2], usize>,
    /// Number of copies that each rank sends.
    given: Vec<usize>,
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
        let mut halo = Halo {
            ranks,
            owned: vec![0; ranks],
            sent: BTreeMap::new(),
            given: vec![0; ranks],
        };
        owners.iter().for_each(|o| halo.owned[*o as usize] += 1);
        let of = |rank: usize| {
            let own = places.iter().zip(owners);
            let own = own.filter(|(_, o)| **o as usize == rank).map(|(x, _)| x);
            let around = RankBox::around(own);
            needs.slots(places, &around, |k| owners[k] as usize != rank)
        };
        let ghosts: Vec<Vec<u32>> = (0..ranks).into_par_iter().map(of).collect();
        for (rank, ghosts) in ghosts.into_iter().enumerate() {
            for ghost in ghosts {
                let from = owners[ghost as usize];
                *halo.sent.entry([rank as u32, from]).or_default() += 1;
                halo.given[from as usize] += 1;
            }
        }
        Ok(halo)
    }

    /// Number of ranks.
    pub fn ranks(&self) -> usize {
        self.ranks
    }

    /// Particles that a rank owns.
    pub fn owned(&self, rank: usize) -> usize {
        self.owned[rank]
    }

    /// Ghosts that a rank has.
    pub fn ghosts(&self, rank: usize) -> usize {
        self.to(rank).map(|(_, count)| count).sum()
    }

    /// Particles that a rank sends to others, each as often as it is sent.
    pub fn sent(&self, rank: usize) -> usize {
        self.given[rank]
    }

    /// Ranks that a rank has ghosts of, ascending.
    pub fn partners(&self, rank: usize) -> Vec<usize> {
        self.to(rank).map(|([_, from], _)| *from as usize).collect()
    }

    /// Copies for a rank.
    fn to(&self, rank: usize) -> impl Iterator<Item = (&[u32; 2], &usize)> {
        let rank = rank as u32;
        self.sent.range([rank, 0]..=[rank, u32::MAX])
    }
}
