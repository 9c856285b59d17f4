//! The system of the effective pressure: its particles and their couplings.

use sph_core::{Pool, Vect};
use sph_multiphase::linear::Rows;
use sph_neighbours::{
    Body, Cluster, Lane, LanePair, MOST, Owned, PairNumbers, Particles, dot, splat,
};

/// Role of a particle in the problem.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Part {
    /// No soil.
    Outside,
    /// Soil with the given Δρ, kg/m³, whose pressure is known, Pa.
    Surface(f64, f64),
    /// Soil with the given Δρ, kg/m³.
    Inside(f64),
}

impl Part {
    /// Soil with a Δρ, at its surface or not; `top` over Δρ is the pressure there, m²/s².
    pub fn new(density: Option<f64>, surface: bool, top: f64) -> Self {
        match density {
            None => Part::Outside,
            Some(density) if surface => Part::Surface(density, top * density),
            Some(density) => Part::Inside(density),
        }
    }

    /// The pressure that is not solved for, Pa.
    fn known(self) -> f64 {
        match self {
            Part::Surface(_, pressure) => pressure,
            _ => 0.0,
        }
    }

    /// Δρ where the pressure is solved for, kg/m³.
    fn inside(self) -> Option<f64> {
        match self {
            Part::Inside(density) => Some(density),
            _ => None,
        }
    }
}

pub(crate) struct Couplings<'a, const D: usize> {
    /// The rows that count.
    pub owned: &'a Owned,
    pub parts: &'a [Part],
    /// Of every particle, m^d.
    pub volume: &'a [f64],
    /// m/s².
    pub gravity: Vect<D>,
}

#[derive(Default)]
pub(crate) struct ClusterCoefficients {
    /// c and what it adds to the source, for every candidate, one number per lane each.
    numbers: Vec<f64>,
    /// Columns that are coupled to a row, and their c, one number per lane.
    columns: Vec<u32>,
    couplings: Vec<f64>,
}

impl<const D: usize> Couplings<'_, D> {
    /// True if a particle has a pressure that is solved for, in a row that is not with another owner.
    pub fn is_solved(&self, i: usize) -> bool {
        self.parts[i].inside().is_some() && self.owned.has(i)
    }

    /// Adds the row of a pressure that is known.
    pub fn add_known(&self, i: usize, rows: &mut Rows<f64, 1>) {
        rows.begin(0);
        rows.end(1.0, Vect::from([self.parts[i].known()]));
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
        let (diagonals, sources) = cluster.dispatch(SideBySide {
            parts: self.parts,
            candidates: cluster.candidates(),
            scratch,
        });
        for (lane, i) in cluster.members().enumerate() {
            if !self.is_solved(i) {
                self.add_known(i, rows);
                continue;
            }
            rows.begin(scratch.columns.len());
            let couplings = scratch.couplings.chunks_exact(cluster.lanes());
            for (&column, couplings) in scratch.columns.iter().zip(couplings) {
                let coupling = couplings[lane];
                rows.couple(column, &coupling, coupling != 0.0);
            }
            rows.close(diagonals[lane], Vect::from([sources[lane]]));
        }
    }
}

impl<const D: usize> PairNumbers<D, 2> for Couplings<'_, D> {
    /// V, m^d, and Δρ, kg/m³.
    type Own<L: Lane> = [L; 2];

    #[inline(always)]
    fn own<L: Lane>(&self, all: Particles) -> [L; 2] {
        all.each(|i| [self.volume[i], self.parts[i].inside().unwrap_or(0.0)])
    }

    /// c = −V_a V_b F_ab, and c Δρ g·(r_a − r_b).
    #[inline(always)]
    fn numbers<L: Lane>(&self, here: &[L; 2], j: usize, pair: &LanePair<D, L>) -> [L; 2] {
        let density = match self.parts[j] {
            Part::Outside => return [L::splat(0.0); 2],
            Part::Surface(density, _) | Part::Inside(density) => density,
        };
        let coupling = -here[0] * L::splat(self.volume[j]) * pair.factor;
        let mean = L::splat(0.5) * (here[1] + L::splat(density));
        let weight = dot(&splat(&self.gravity), &pair.separation);
        [coupling, coupling * mean * weight]
    }
}

struct SideBySide<'a> {
    parts: &'a [Part],
    candidates: &'a [u32],
    scratch: &'a mut ClusterCoefficients,
}

impl Body for SideBySide<'_> {
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
        let zero = L::splat(0.0);
        let (mut held, mut sum, mut source) = (zero, zero, zero);
        for (&column, both) in self.candidates.iter().zip(numbers.chunks_exact(2 * L::N)) {
            let coupling = L::load(both);
            match self.parts[column as usize] {
                Part::Outside => continue,
                Part::Inside(_) => {
                    if !coupling.any_nonzero() {
                        continue;
                    }
                    columns.push(column);
                    couplings.extend_from_slice(&both[..L::N]);
                    sum += coupling;
                }
                Part::Surface(_, pressure) => {
                    held += coupling;
                    source += coupling * L::splat(pressure);
                }
            }
            source += L::load(&both[L::N..]);
        }
        // Soil that fills a closed box has no surface: the level is then that of zero.
        let mut diagonal = held + L::splat(FAINT) * sum + L::splat(f64::MIN_POSITIVE);
        for coupling in couplings.chunks_exact(L::N) {
            diagonal += L::load(coupling);
        }
        let mut out = ([0.0; MOST], [0.0; MOST]);
        diagonal.store(&mut out.0);
        source.store(&mut out.1);
        out
    }
}

/// Share of a row's couplings that keeps a system without a surface regular.
const FAINT: f64 = 1e-9;

/// Start of an iteration: the pressure before, or the known one, Pa.
pub(crate) fn start(pressure: f64, part: &Part) -> Vect<1> {
    Vect::from([match part {
        Part::Inside(_) => pressure,
        _ => part.known(),
    }])
}
