//! The excess pressure of pores that drain.

use sph_core::{Pool, StepError, Vect, fields};
use sph_multiphase::linear::{
    Assembly, ConjugateGradient, Entries, LinearSolver, Matrix, ParticleMatrix, Preconditioner,
};
use sph_neighbours::World;
use sph_rheology::state::Reference;

use super::contract::{DRAINED_PRESSURE, EXCESS_PORE_PRESSURE, Skeleton, Supply};
use super::system::PoreSystem;

/// Buffers of a solve, kept for their memory.
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

/// The skeleton that drains, and the solver of its excess pressure.
pub(crate) struct Drainage {
    pub skeleton: Skeleton,
    /// A wall that feeds the pores, with its number.
    pub supply: Option<(u32, Supply)>,
    /// Stiffness of the contacts, Pa.
    pub contacts: f64,
    solver: ConjugateGradient,
}

/// Stiffness of the contacts over ρ₀c²: soils whose sound is ten times faster than √(gH) are compressed by 10⁻³.
const STIFF: f64 = 10.0;

impl Drainage {
    /// Of a soil with a reference state.
    pub fn new(skeleton: Skeleton, supply: Option<(u32, Supply)>, soil: &Reference) -> Self {
        let stiff = STIFF * soil.density * soil.sound_speed.powi(2);
        Drainage {
            contacts: skeleton.modulus.unwrap_or(stiff),
            solver: ConjugateGradient {
                preconditioner: Preconditioner::IncompleteDiagonal,
                tolerance: skeleton.tolerance,
                iterations: skeleton.iterations,
                ..ConjugateGradient::default()
            },
            skeleton,
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
        let Scratch {
            assembly,
            pool,
            mobility,
            diagonal,
            source,
            excess,
            product,
            ..
        } = scratch;
        let system = PoreSystem {
            volume: world.free.get(fields::VOLUME)?,
            gamma: world.free.get(fields::RENORMALISATION).ok(),
            mobility,
            diagonal,
            source,
        };
        let owned = space.owned();
        assembly.fill_wanted(
            world,
            |i| system.mobility[i] != 0.0 && owned.has(i),
            |rows, cluster| system.add(cluster, rows, pool),
            |rows, others| others.for_each(|_| system.add_outside(rows)),
        )?;
        let values = std::mem::take(&mut assembly.values);
        let matrix = Matrix::on(assembly.pattern.clone(), Entries::Scalar(values));
        let operator = ParticleMatrix::new(&matrix, &space, None);
        let solved = self.solver.solve(&operator, &assembly.sources, excess);
        let drained = world.free.get(DRAINED_PRESSURE)?;
        for (i, p) in excess.iter_mut().enumerate() {
            p[0] = p[0].min(drained[i] + self.skeleton.load);
        }
        product.clear();
        product.resize(excess.len(), Vect::zeros());
        matrix.multiply(excess, product);
        if let Entries::Scalar(values) = matrix.entries {
            assembly.values = values;
        }
        solved.map_err(|e| StepError::stage("pore pressure", e.to_string()))?;
        let mut column = world.free.take(EXCESS_PORE_PRESSURE)?;
        let both = column.iter_mut().zip(&*excess);
        both.for_each(|(column, p)| *column = p[0]);
        Ok(world.free.put(EXCESS_PORE_PRESSURE, column)?)
    }
}
