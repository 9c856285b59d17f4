//! Which particles a rank needs copies of.

use std::collections::BTreeMap;

use rayon::prelude::*;
use sph_core::Vect;
use sph_neighbours::{CellGrid, Domain};

/// Particles that one task looks at.
const CHUNK: usize = 1024;

/// Guests: particles that others own and a rank needs, because they are within reach of one of its own.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Halo {
    ranks: usize,
    owned: Vec<usize>,
    /// How many go to (first) from (second).
    sent: BTreeMap<[u32; 2], usize>,
    /// How many each rank sends.
    given: Vec<usize>,
}

impl Halo {
    /// Counts the guests of all ranks, exactly. `reach` is that of the lists, m.
    pub fn of<const D: usize>(
        places: &[Vect<D>],
        owners: &[u32],
        ranks: usize,
        reach: f64,
        domain: &Domain<D>,
    ) -> Self {
        let grid = CellGrid::new(places, reach, domain);
        let near = |k: usize, there: &mut Vec<u32>| {
            there.clear();
            grid.ranges(&places[k], reach, |range| {
                for &j in &grid.order()[range] {
                    let owner = owners[j as usize];
                    if owner == owners[k] || there.contains(&owner) {
                        continue;
                    }
                    let apart = domain.nearest_image(places[k] - places[j as usize]);
                    if apart.norm_squared() < reach * reach {
                        there.push(owner);
                    }
                }
            });
        };
        let chunks = (0..places.len()).into_par_iter().chunks(CHUNK);
        let counted: Vec<BTreeMap<[u32; 2], usize>> = chunks
            .map(|chunk| {
                let (mut sent, mut there) = (BTreeMap::new(), Vec::new());
                for k in chunk {
                    near(k, &mut there);
                    for to in &there {
                        *sent.entry([*to, owners[k]]).or_default() += 1;
                    }
                }
                sent
            })
            .collect();
        let mut halo = Halo {
            ranks,
            owned: vec![0; ranks],
            sent: BTreeMap::new(),
            given: vec![0; ranks],
        };
        owners.iter().for_each(|o| halo.owned[*o as usize] += 1);
        for (pair, count) in counted.into_iter().flatten() {
            *halo.sent.entry(pair).or_default() += count;
            halo.given[pair[1] as usize] += count;
        }
        halo
    }

    /// Number of ranks.
    pub fn ranks(&self) -> usize {
        self.ranks
    }

    /// Particles that a rank owns.
    pub fn owned(&self, rank: usize) -> usize {
        self.owned[rank]
    }

    /// Guests that a rank has.
    pub fn guests(&self, rank: usize) -> usize {
        self.to(rank).map(|(_, count)| count).sum()
    }

    /// Particles that a rank sends to others, each as often as it is sent.
    pub fn sent(&self, rank: usize) -> usize {
        self.given[rank]
    }

    /// Ranks that a rank has guests of, ascending.
    pub fn partners(&self, rank: usize) -> Vec<usize> {
        self.to(rank).map(|([_, from], _)| *from as usize).collect()
    }

    /// What goes to a rank.
    fn to(&self, rank: usize) -> impl Iterator<Item = (&[u32; 2], &usize)> {
        let rank = rank as u32;
        self.sent.range([rank, 0]..=[rank, u32::MAX])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bisect;
    use nalgebra::Vector2;

    #[test]
    fn guests_are_those_that_a_count_of_all_pairs_finds() {
        let mut state = 1_u64;
        let mut random = || {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (state >> 40) as f64 / (1_u64 << 24) as f64
        };
        let places: Vec<_> = (0..900)
            .map(|_| Vector2::new(3.0 * random(), random()))
            .collect();
        let mut domain = Domain::open(Vector2::new(0.0, 0.0), Vector2::new(3.0, 1.0));
        for periodic in [[false, false], [true, false], [true, true]] {
            domain.periodic = periodic;
            let owners = bisect(&places, &vec![1.0; places.len()], 6).expect("owners");
            let reach = 0.15;
            let halo = Halo::of(&places, &owners, 6, reach, &domain);
            for rank in 0..6 {
                let near = |k: usize| {
                    let close = |j: usize| {
                        owners[j] as usize == rank
                            && domain.nearest_image(places[k] - places[j]).norm() < reach
                    };
                    owners[k] as usize != rank && (0..places.len()).any(close)
                };
                let guests = (0..places.len()).filter(|k| near(*k)).count();
                assert_eq!(halo.guests(rank), guests, "rank {rank}, {periodic:?}");
                assert!(guests > 20, "the test sees no halo");
            }
            let all: usize = (0..6).map(|r| halo.guests(r)).sum();
            assert_eq!(all, (0..6).map(|r| halo.sent(r)).sum::<usize>());
        }
    }
}
