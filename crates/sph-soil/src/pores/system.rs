//! The system of the excess pore pressure: fluxes between particles of the soil.

use sph_core::{Pool, Vect};
use sph_multiphase::linear::Rows;
use sph_neighbours::{Cluster, Lane, LanePair, PairNumbers, Particles};

/// Coefficients of the fluxes, and what stands on the diagonal and the right-hand side besides them.
pub(crate) struct PoreSystem<'a> {
    /// Of every particle, m^d.
    pub volume: &'a [f64],
    /// γ, where there are walls.
    pub gamma: Option<&'a [f64]>,
    /// k/η of every particle, m²/(Pa s); 0 outside of the soil.
    pub mobility: &'a [f64],
    /// m^d/(Pa s).
    pub diagonal: &'a [f64],
    /// m^d/s.
    pub source: &'a [f64],
}

impl PoreSystem<'_> {
    /// Adds the rows of a cluster.
    pub fn add<const D: usize>(
        &self,
        cluster: &mut Cluster<'_, D>,
        rows: &mut Rows<f64, 1>,
        pool: &Pool<Vec<f64>>,
    ) {
        let mut numbers = pool.acquire();
        cluster.numbers(self, &mut numbers);
        for (lane, i) in cluster.members().enumerate() {
            if self.mobility[i] == 0.0 {
                self.add_outside(rows);
                continue;
            }
            rows.begin(cluster.candidates().len());
            let couplings = numbers.chunks_exact(cluster.lanes());
            for (&column, couplings) in cluster.candidates().iter().zip(couplings) {
                let coupling = couplings[lane];
                rows.couple(column, &coupling, coupling != 0.0);
            }
            rows.end(self.diagonal[i], Vect::from([self.source[i]]));
        }
    }

    /// Adds the row of a particle outside of the soil: no pressure.
    pub fn add_outside(&self, rows: &mut Rows<f64, 1>) {
        rows.begin(0);
        rows.end(1.0, Vect::from([0.0]));
    }
}

impl<const D: usize> PairNumbers<D, 1> for PoreSystem<'_> {
    /// V, m^d; γ; k/η, m²/(Pa s).
    type Own<L: Lane> = [L; 3];

    #[inline(always)]
    fn own<L: Lane>(&self, all: Particles) -> [L; 3] {
        let gamma = |i: usize| self.gamma.map_or(1.0, |g| g[i]);
        all.each(|i| [self.volume[i], gamma(i), self.mobility[i]])
    }

    /// c = −2 V_a V_b F_ab m_ab/γ_ab, with the harmonic mean m_ab of k/η and the mean γ_ab.
    #[inline(always)]
    fn numbers<L: Lane>(&self, own: &[L; 3], j: usize, pair: &LanePair<D, L>) -> [L; 1] {
        let mobility = self.mobility[j];
        if mobility == 0.0 {
            return [L::splat(0.0)];
        }
        let [volume, gamma, here] = *own;
        let there = L::splat(mobility);
        let gammas = gamma + L::splat(self.gamma.map_or(1.0, |g| g[j]));
        let means = L::splat(-8.0 * self.volume[j]) * here * there / ((here + there) * gammas);
        [volume * pair.factor * means]
    }
}
