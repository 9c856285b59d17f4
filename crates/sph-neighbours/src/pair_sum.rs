//! Sums over pairs, their formula written once for lanes.

use sph_core::Vect;
use sph_lanes::{Body, InLanes, Lane, MOST, dispatch_at};

use crate::cluster::Cluster;
use crate::lane_pair::LanePair;
use crate::members::Members;

/// A sum over free neighbours: of several particles side by side, or of one.
///
/// A pair beyond the support, where F = 0 and w = 0, has to add exactly zero.
pub trait PairSum<const D: usize>: Sync {
    /// Whether pairs carry kernel values.
    const VALUES: bool = false;
    /// Own values of `L::N` particles.
    type Own<L: Lane>: Copy;
    /// What is summed, from zero.
    type Sum<L: Lane>: InLanes<L, One = Self::Sum<f64>>;
    /// Reads the own values.
    fn own<L: Lane>(&self, particles: Particles) -> Self::Own<L>;
    /// Adds a free neighbour to the sums of all lanes.
    fn pair<L: Lane>(
        &self,
        own: &Self::Own<L>,
        neighbour: usize,
        pair: &LanePair<D, L>,
        sum: &mut Self::Sum<L>,
    );
}

/// Particles that follow each other, one in each lane; the last one fills the lanes that are left over.
#[derive(Clone, Copy, Debug)]
pub struct Particles {
    from: usize,
    last: usize,
}

impl Particles {
    /// One particle.
    #[inline(always)]
    pub fn one(particle: usize) -> Self {
        Particles {
            from: particle,
            last: particle,
        }
    }

    /// The first ones, at least one.
    #[inline(always)]
    pub(crate) fn first(count: usize) -> Self {
        Particles {
            from: 0,
            last: count - 1,
        }
    }

    /// The particle of a lane.
    #[inline(always)]
    pub fn at(self, lane: usize) -> usize {
        (self.from + lane).min(self.last)
    }

    /// Numbers that are computed for each particle, through memory: lanes that are set one by one are taken apart by the
    /// compiler, and each goes its own way.
    #[inline(always)]
    pub fn each<L: Lane, const N: usize>(self, mut of: impl FnMut(usize) -> [f64; N]) -> [L; N] {
        let mut memory = [[0.0; MOST]; N];
        for lane in 0..L::N {
            let values = of(self.at(lane));
            for (memory, value) in memory.iter_mut().zip(values) {
                memory[lane] = value;
            }
        }
        let mut lanes = [L::splat(0.0); N];
        for n in 0..N {
            lanes[n] = L::load(&memory[n]);
        }
        lanes
    }

    /// Their numbers in a column.
    #[inline(always)]
    pub fn numbers<L: Lane>(self, column: &[f64]) -> L {
        match self.last - self.from + 1 >= L::N {
            true => L::load(&column[self.from..]),
            false => self.each(|i| [column[i]])[0],
        }
    }

    /// Their vectors in a column.
    #[inline(always)]
    pub fn vectors<const D: usize, L: Lane>(self, column: &[Vect<D>]) -> [L; D] {
        self.each(|i| column[i].data.0[0])
    }

    /// Their phases, which are small whole numbers, exact as any; 0 without a column.
    #[inline(always)]
    pub fn phases<L: Lane>(self, column: Option<&[u32]>) -> L {
        match column {
            Some(column) => self.each(|i| [f64::from(column[i])])[0],
            None => L::splat(0.0),
        }
    }
}

impl From<Members<'_>> for Particles {
    #[inline(always)]
    fn from(members: Members<'_>) -> Self {
        Particles {
            from: members.from,
            last: members.from + members.count - 1,
        }
    }
}

/// Sums of a few particles, a row for each number.
pub(crate) type Rows = Vec<[f64; MOST]>;

/// Makes room for as many numbers.
pub(crate) fn make_room(rows: &mut Rows, numbers: usize) {
    if rows.len() < numbers {
        rows.resize(numbers, [0.0; MOST]);
    }
}

/// Sums over all candidates of a cluster into rows.
pub(crate) fn sum_cluster<const D: usize, S: PairSum<D>>(
    sum: &S,
    cluster: &Cluster<'_, D>,
    rows: &mut Rows,
) {
    make_room(rows, S::Sum::<f64>::NUMBERS);
    dispatch_at(cluster.width, OfCluster { sum, cluster, rows });
}

struct OfCluster<'a, 'c, const D: usize, S> {
    sum: &'a S,
    cluster: &'a Cluster<'c, D>,
    rows: &'a mut Rows,
}

impl<const D: usize, S: PairSum<D>> Body for OfCluster<'_, '_, D, S> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lane>(self) {
        let members = self.cluster.members;
        let own = self.sum.own::<L>(members.into());
        let mut sums = S::Sum::<L>::zero();
        let buffers = &*self.cluster.buffers;
        let n = members.candidates.len() * L::N;
        let values = match S::VALUES {
            true => &buffers.value[..n],
            false => &buffers.factor[..n],
        };
        // Chunks of a length that the compiler knows are read without a check.
        let measures = buffers.distance2[..n]
            .chunks_exact(L::N)
            .zip(buffers.factor[..n].chunks_exact(L::N))
            .zip(values.chunks_exact(L::N));
        let separations = buffers.separation[..D * n].chunks_exact(D * L::N);
        let all = members.candidates.iter().zip(separations).zip(measures);
        for ((&j, apart), ((distance2, factor), value)) in all {
            let mut separation = [L::splat(0.0); D];
            for k in 0..D {
                separation[k] = L::load(&apart[k * L::N..]);
            }
            let pair = LanePair {
                separation,
                distance2: L::load(distance2),
                factor: L::load(factor),
                value: match S::VALUES {
                    true => L::load(value),
                    false => L::splat(0.0),
                },
            };
            self.sum.pair(&own, j as usize, &pair, &mut sums);
        }
        sums.store(self.rows);
    }
}
