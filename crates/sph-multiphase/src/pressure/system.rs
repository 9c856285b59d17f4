//! The system of the pressure: the couplings of particles, and their diagonal.

use sph_core::{Pool, Vect};
use sph_neighbours::{
    Body, Cluster, Lane, LanePair, MOST, Owned, PairNumbers, Particles, dot, splat,
};

use crate::linear::Rows;

/// Couplings of the pressures of two particles.
pub(crate) struct Couplings<'a, const D: usize> {
    /// The rows that count.
    pub owned: &'a Owned,
    /// V, m^d.
    pub volume: &'a [f64],
    /// ρ, kg/m³.
    pub density: &'a [f64],
    /// γ, where there are walls that cut supports.
    pub gamma: Option<&'a [f64]>,
    /// The other entries of a row.
    pub parts: &'a [Part],
    /// m/s².
    pub gravity: Vect<D>,
    /// Δt², s².
    pub squared_step: f64,
    /// Σ 2V|F| of a particle whose support is full, 1/m²; where surfaces are known.
    pub full: f64,
}

/// The own entries of a particle in its row.
#[derive(Clone, Copy, Default)]
pub(crate) struct Part {
    /// γV/(ρc²), m^d/Pa.
    pub compliance: f64,
    /// Compliance times the pressure of the equation of state, less Δt γ V D{u}, m^d.
    pub source: f64,
    /// True if a free surface is within reach: the missing part of the support, besides walls, is at the pressure
    /// `outside`.
    pub open: bool,
    /// Pa.
    pub outside: f64,
}

/// Numbers of a cluster for its rows.
#[derive(Default)]
pub(crate) struct ClusterCoefficients {
    /// c and its part of the source, for every candidate, one number per lane each.
    numbers: Vec<f64>,
    /// Columns that are coupled to a row, and their c, one number per lane.
    columns: Vec<u32>,
    couplings: Vec<f64>,
}

impl<const D: usize> Couplings<'_, D> {
    /// Adds a row that holds a pressure at 0: the owner has the right one.
    pub fn add_other(rows: &mut Rows<f64, 1>) {
        rows.begin(0);
        rows.end(1.0, Vect::from([0.0]));
    }

    /// Adds the rows of a cluster: their sums side by side, in the order of the columns as one row alone would.
    pub fn add(
        &self,
        cluster: &Cluster<'_, D>,
        rows: &mut Rows<f64, 1>,
        scratch_pool: &Pool<ClusterCoefficients>,
    ) {
        let mut scratch = scratch_pool.acquire();
        let scratch = &mut *scratch;
        cluster.numbers(self, &mut scratch.numbers);
        let (couplings, sources) = cluster.dispatch(ClusterSums {
            candidates: cluster.candidates(),
            scratch,
        });
        for (lane, i) in cluster.members().enumerate() {
            if !self.owned.has(i) {
                Self::add_other(rows);
                continue;
            }
            rows.begin(scratch.columns.len());
            let others = scratch.couplings.chunks_exact(cluster.lanes());
            for (&column, others) in scratch.columns.iter().zip(others) {
                rows.couple(column, &others[lane], others[lane] != 0.0);
            }
            let part = self.parts[i];
            let lacking = self.lacking(i, couplings[lane]);
            let held = part.compliance + lacking;
            let source = part.source + sources[lane] + lacking * part.outside;
            rows.close(held + couplings[lane], Vect::from([source]));
        }
    }

    /// 1/γ: by it the gradient of the pressure grows beside walls, and nothing that moves a particle may exceed the
    /// solution.
    #[inline(always)]
    fn growth(&self, i: usize) -> f64 {
        self.gamma.map_or(1.0, |gamma| 1.0 / gamma[i])
    }

    /// Missing couplings of a support that is cut by a free surface.
    fn lacking(&self, i: usize, coupling: f64) -> f64 {
        let full = self.squared_step * self.full * self.volume[i] / self.density[i];
        match self.parts[i].open {
            true => (full - coupling).max(0.0),
            false => 0.0,
        }
    }
}

impl<const D: usize> PairNumbers<D, 2> for Couplings<'_, D> {
    /// Δt² V, s² m^d, 1/γ, and 1/(γρ), m³/kg.
    type Own<L: Lane> = [L; 3];

    #[inline(always)]
    fn own<L: Lane>(&self, all: Particles) -> [L; 3] {
        all.each(|i| {
            let growth = self.growth(i);
            let size = self.squared_step * self.volume[i];
            [size, growth, growth / self.density[i]]
        })
    }

    /// c = −Δt² V_a V_b F_ab [1/(γ_aρ_a) + 1/(γ_bρ_b)], and −Δt² V_a V_b F_ab (1/γ_a + 1/γ_b) g·(r_a − r_b).
    #[inline(always)]
    fn numbers<L: Lane>(&self, here: &[L; 3], j: usize, pair: &LanePair<D, L>) -> [L; 2] {
        let flux = -here[0] * L::splat(self.volume[j]) * pair.factor;
        let growth = self.growth(j);
        let lightness = here[2] + L::splat(growth / self.density[j]);
        let weight = dot(&splat(&self.gravity), &pair.separation);
        [
            flux * lightness,
            (here[1] + L::splat(growth)) * flux * weight,
        ]
    }
}

struct ClusterSums<'a> {
    candidates: &'a [u32],
    scratch: &'a mut ClusterCoefficients,
}

impl Body for ClusterSums<'_> {
    /// Σc and sources.
    type Output = ([f64; MOST], [f64; MOST]);

    #[inline(always)]
    fn call<L: Lane>(self) -> Self::Output {
        let ClusterCoefficients {
            numbers,
            columns,
            couplings,
        } = self.scratch;
        columns.clear();
        couplings.clear();
        let (mut sum, mut source) = (L::splat(0.0), L::splat(0.0));
        for (&column, both) in self.candidates.iter().zip(numbers.chunks_exact(2 * L::N)) {
            let coupling = L::load(both);
            if !coupling.any_nonzero() {
                continue;
            }
            columns.push(column);
            couplings.extend_from_slice(&both[..L::N]);
            sum += coupling;
            source += L::load(&both[L::N..]);
        }
        let mut out = ([0.0; MOST], [0.0; MOST]);
        sum.store(&mut out.0);
        source.store(&mut out.1);
        out
    }
}
