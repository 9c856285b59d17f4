//! Sums over pairs, their formula written once for lanes.

use sph_kernels::lanes::{Body, InLanes, Lane, dispatch_at};

use crate::lanes::particles::Rows;
use crate::lists::buffer::grow;
use crate::{Cluster, LanePair, Particles};

/// A sum over free neighbours: of several particles side by side, or of one.
///
/// A pair beyond the support, where F = 0 and w = 0, has to add exactly zero.
pub trait PairSum<const D: usize>: Sync {
    /// True if pairs carry kernel values.
    const VALUES: bool = false;
    /// True if walls that scale the kernel do so in this sum: w is s_a s_b w there, γ is 1, and no elements are seen.
    const SCALED: bool = false;
    /// Own values of `L::N` particles.
    type Own<L: Lane>: Copy;
    /// The sum, from zero.
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
    /// Adds the part of a pair by the slope of s, which carries s_a s_b w; called beside [`pair`](Self::pair) where
    /// walls scale some pair of a cluster.
    #[inline(always)]
    fn pair_at_walls<L: Lane>(
        &self,
        _own: &Self::Own<L>,
        _neighbour: usize,
        _pair: &LanePair<D, L>,
        _sum: &mut Self::Sum<L>,
    ) {
    }
}

/// Sums over all candidates of a cluster into rows.
pub(crate) fn sum_cluster<const D: usize, S: PairSum<D>>(
    sum: &S,
    cluster: &Cluster<'_, D>,
    rows: &mut Rows,
) {
    grow(rows, S::Sum::<f64>::NUMBERS);
    dispatch_at(cluster.width, ClusterPairSum { sum, cluster, rows });
}

struct ClusterPairSum<'a, 'c, const D: usize, S> {
    sum: &'a S,
    cluster: &'a Cluster<'c, D>,
    rows: &'a mut Rows,
}

impl<const D: usize, S: PairSum<D>> Body for ClusterPairSum<'_, '_, D, S> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lane>(self) {
        match S::SCALED && self.cluster.scaled {
            true => self.add_up::<L, true>(),
            false => self.add_up::<L, false>(),
        }
    }
}

impl<const D: usize, S: PairSum<D>> ClusterPairSum<'_, '_, D, S> {
    #[inline(always)]
    fn add_up<L: Lane, const SCALED: bool>(self) {
        let members = self.cluster.members;
        let own = self.sum.own::<L>(members.into());
        let mut sums = S::Sum::<L>::zero();
        let buffers = &*self.cluster.buffers;
        let n = members.candidates.len() * L::N;
        let (factors, values) = match (SCALED, S::VALUES) {
            (true, _) => (&buffers.scaled[0][..n], &buffers.scaled[1][..n]),
            (false, true) => (&buffers.factor[..n], &buffers.value[..n]),
            (false, false) => (&buffers.factor[..n], &buffers.factor[..n]),
        };
        // Chunks of a length that the compiler knows are read without a check.
        let measures = buffers.distance2[..n]
            .chunks_exact(L::N)
            .zip(factors.chunks_exact(L::N))
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
                value: match S::VALUES || SCALED {
                    true => L::load(value),
                    false => L::splat(0.0),
                },
            };
            self.sum.pair(&own, j as usize, &pair, &mut sums);
            if SCALED {
                self.sum.pair_at_walls(&own, j as usize, &pair, &mut sums);
            }
        }
        sums.store(self.rows);
    }
}
