//! The excess pressure of pores that drain, and its system: fluxes between particles of the soil.

use sph_core::{Pool, StepError, Vect, fields};
use sph_multiphase::linear::{
    Assembly, ConjugateGradient, Entries, LinearSolver, Matrix, ParticleMatrix, Rows,
};
use sph_neighbours::{Cluster, Lane, LanePair, PairNumbers, Particles, World};
use sph_rheology::state::Reference;

use crate::pores::{DRAINED_PRESSURE, Darcy, EXCESS_PORE_PRESSURE, Supply};
use crate::stress::conjugate_gradient;

#[derive(Default)]
pub(crate) struct Scratch {
    assembly: Assembly<f64, 1>,
    pool: Pool<Vec<f64>>,
    pub mobility: Vec<f64>,
    /// Storage and the slope of the law, without outlets, m^d/(Pa s).
    pub storage: Vec<f64>,
    pub diagonal: Vec<f64>,
    pub source: Vec<f64>,
    /// Inflow through walls that feed pores without an excess pressure, m^d/s.
    pub fed: Vec<f64>,
    pub excess: Vec<Vect<1>>,
    pub product: Vec<Vect<1>>,
    pub growth: Vec<f64>,
}

pub(crate) struct Drainage {
    pub darcy: Darcy,
    /// A wall that feeds the pores, with its number.
    pub supply: Option<(u32, Supply)>,
    /// Stiffness of the contacts, Pa.
    pub contacts: f64,
    solver: ConjugateGradient<1>,
}

/// Stiffness of the contacts over ρ₀c²: soils whose sound is ten times faster than √(gH) are compressed by 10⁻³.
const STIFF: f64 = 10.0;

impl Drainage {
    /// Of a soil with a reference state.
    pub fn new(darcy: Darcy, supply: Option<(u32, Supply)>, soil: &Reference) -> Self {
        let stiff = STIFF * soil.density * soil.sound_speed.powi(2);
        Drainage {
            contacts: darcy.modulus.unwrap_or(stiff),
            solver: conjugate_gradient(darcy.tolerance, darcy.iterations),
            darcy,
            supply,
        }
    }

    /// Solves, and leaves the product of the matrix with the solution, whose grains all keep a pressure of 0 or more.
    pub fn solve<const D: usize>(
        &mut self,
        world: &mut World<D>,
        scratch: &mut Scratch,
    ) -> Result<(), StepError> {
        let space = world.space()?;
        let system = PoreSystem {
            volume: world.free.get(fields::VOLUME)?,
            gamma: world.free.get(fields::RENORMALISATION).ok(),
            mobility: &scratch.mobility,
            diagonal: &scratch.diagonal,
            source: &scratch.source,
        };
        let owned = &space.owned;
        let assembly = &mut scratch.assembly;
        assembly.fill_wanted(
            world,
            |i| system.mobility[i] != 0.0 && owned.has(i),
            |rows, cluster| system.add(cluster, rows, &scratch.pool),
            |rows, others| others.for_each(|_| system.add_outside(rows)),
        )?;
        let values = std::mem::take(&mut assembly.values);
        let matrix = Matrix::on(assembly.pattern.clone(), Entries::Scalar(values));
        let operator = ParticleMatrix::new(&matrix, &space, None);
        let (solver, excess) = (&mut self.solver, &mut scratch.excess);
        let solved = solver.solve(&operator, &assembly.sources, excess);
        let drained = world.free.get(DRAINED_PRESSURE)?;
        for (i, p) in excess.iter_mut().enumerate() {
            p[0] = p[0].min(drained[i] + self.darcy.load);
        }
        scratch.product.clear();
        scratch.product.resize(excess.len(), Vect::zeros());
        matrix.multiply(excess, &mut scratch.product);
        if let Entries::Scalar(values) = matrix.entries {
            assembly.values = values;
        }
        solved.map_err(|e| StepError::stage("pore pressure", e))?;
        let column = world.free.get_mut(EXCESS_PORE_PRESSURE)?;
        let both = column.iter_mut().zip(excess);
        both.for_each(|(column, p)| *column = p[0]);
        Ok(())
    }
}

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
