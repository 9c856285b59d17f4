//! The linear system of a step with implicit friction, and the memory of those before.

use std::sync::{Mutex, OnceLock};

use sph_core::{StepError, Vect, fields};
use sph_neighbours::{
    Cluster, CouplingRows, CouplingWriter, Couplings, MOST, Neighbourhood, Space, Weak, World,
};

use crate::linear::{Block, Entry};
use crate::viscosity::friction_operator::{FrictionOperator, Matrices, RowsOf};
use crate::viscosity::{BoundCoupling, Coupling, CouplingRow};

/// Coupling of a pair over its smaller mass up to which it is taken explicitly: hundreds of neighbours together are far from
/// the bound of 1, and a step of water beside mud has a matrix of the mud alone.
const SOFT: f64 = 1e-3;

/// (M + θΔt K) u = Δt s with M = diag(m_a γ_a), for the memory that it takes from step to step.
///
/// K is kept as the couplings of pairs side by side, of which products are made in lanes; a matrix is written down where a solver asks
/// for one.
#[derive(Default)]
pub struct FrictionSystem<const D: usize> {
    /// Mγ of every row, kg.
    pub mass: Vec<f64>,
    /// Δt s with the force of weak pairs, N s.
    pub right: Vec<Vect<D>>,
    couplings: Couplings,
    limit: Vec<f64>,
    /// M + θΔt W, and the same with the couplings of a row to others; so is `block`.
    scalar: [Vec<f64>; 2],
    block: [Vec<Block<D>>; 2],
    mixes: bool,
    dt: f64,
    matrices: Mutex<Matrices<D>>,
}

/// The part of friction at the end of a step.
#[derive(Clone, Copy)]
struct Part<'a, const D: usize> {
    coupling: &'a dyn BoundCoupling<D>,
    /// Pairs that are not solved for.
    weak: Option<Weak<'a, D>>,
    /// Mγ of every particle, kg.
    mass: &'a [f64],
    /// θΔt, s.
    ahead: f64,
    /// Δt, s.
    dt: f64,
}

impl<const D: usize> FrictionSystem<D> {
    /// Fills in the system of a step; θ is the share of it for which friction acts from its end. With θ = 1, weak pairs act with
    /// the velocity `earlier`.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn fill(
        &mut self,
        coupling: &dyn Coupling<D>,
        world: &World<D>,
        earlier: &[Vect<D>],
        [share, dt]: [f64; 2],
    ) -> Result<(), StepError> {
        let gamma = world.free.get(fields::RENORMALISATION).ok();
        let mass = world.free.get(fields::MASS)?.iter().enumerate();
        self.mass.clear();
        self.mass
            .extend(mass.map(|(i, m)| gamma.map_or(*m, |g| m * g[i])));
        self.limit.clear();
        self.limit.extend(self.mass.iter().map(|m| SOFT / dt * m));
        let limit = std::mem::take(&mut self.limit);
        let weak = (share == 1.0).then_some(Weak {
            velocity: earlier,
            limit: &limit,
        });
        let filled = self.fill_without(coupling, world, weak, [share * dt, dt]);
        self.limit = limit;
        filled
    }

    /// The same with the masses that are there, without the `weak` pairs, for θΔt and Δt.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn fill_without(
        &mut self,
        coupling: &dyn Coupling<D>,
        world: &World<D>,
        weak: Option<Weak<'_, D>>,
        [ahead, dt]: [f64; 2],
    ) -> Result<(), StepError> {
        self.mixes = coupling.mixes_components();
        self.dt = dt;
        coupling.with_columns(world, &mut |bound| {
            let part = Part {
                coupling: bound,
                weak,
                mass: &self.mass,
                ahead,
                dt,
            };
            let (couplings, right) = (&mut self.couplings, &mut self.right);
            let scalar_walls = |rows: &Neighbourhood<'_, D>| bound.scalar_walls(rows);
            let block_walls = |rows: &Neighbourhood<'_, D>| bound.block_walls(rows);
            match self.mixes {
                false => part.fill(world, couplings, &mut self.scalar, right, scalar_walls),
                true => part.fill(world, couplings, &mut self.block, right, block_walls),
            }
        })
    }

    /// θΔt W over Δt of a particle, N s/m: the friction of walls.
    pub(crate) fn of_walls(&self, particle: usize) -> Block<D> {
        let own = match self.mixes {
            false => Block::<D>::identity() * self.scalar[0][particle],
            true => self.block[0][particle],
        };
        (own - Block::<D>::identity() * self.mass[particle]) / self.dt
    }

    /// The system's left side in the space of a solve, for a world that stands where it was filled.
    ///
    /// # Errors
    /// If the world has no positions.
    pub fn operator<'a>(
        &'a self,
        world: &'a World<D>,
        space: &'a Space<D>,
    ) -> Result<FrictionOperator<'a, D>, StepError> {
        let rows = match self.mixes {
            false => RowsOf::Scalar(&self.scalar[0], &self.scalar[1]),
            true => RowsOf::Block(&self.block[0], &self.block[1]),
        };
        Ok(FrictionOperator {
            couplings: self.couplings.at(world)?,
            coupling_bytes: self.couplings.bytes(),
            rows,
            matrix: OnceLock::new(),
            matrices: &self.matrices,
            space,
        })
    }
}

impl<const D: usize> Part<'_, D> {
    fn fill<E: Entry<D>>(
        &self,
        world: &World<D>,
        couplings: &mut Couplings,
        [own, whole]: &mut [Vec<E>; 2],
        right: &mut Vec<Vect<D>>,
        of_walls: impl Fn(&Neighbourhood<'_, D>) -> CouplingRow<E, D> + Sync,
    ) -> Result<(), StepError> {
        let rows = self.mass.len();
        own.resize(rows, E::ZERO);
        whole.resize(rows, E::ZERO);
        right.resize(rows, Vect::zeros());
        let rows = (&mut own[..], &mut whole[..], &mut right[..]);
        let kinds = self.coupling.kinds();
        couplings.fill(world, kinds, rows, |cluster, keeper, rows| {
            self.add(cluster, keeper, rows, &of_walls);
        })
    }

    /// Mγ + θΔt W, the same with Σ C, and Δt s with the force of the weak pairs, for the members of a cluster.
    fn add<E: Entry<D>>(
        &self,
        cluster: &mut Cluster<'_, D>,
        keeper: &mut CouplingWriter<'_>,
        (own, whole, right): CouplingRows<'_, E, E, Vect<D>>,
        of_walls: &impl Fn(&Neighbourhood<'_, D>) -> CouplingRow<E, D>,
    ) {
        self.coupling.strengths(cluster, keeper.numbers);
        let tallies = keeper.keep(cluster, self.ahead, self.weak);
        let walls = self.walls(cluster, of_walls);
        for (k, i) in cluster.members().enumerate() {
            own[k] = E::unit(self.mass[i]) + walls[k].wall * self.ahead;
            whole[k] = own[k] + E::from_block(&tallies[k].kept);
            right[k] = (walls[k].source + tallies[k].weak) * self.dt;
        }
    }

    /// W and s of all members; those after the last one are nothing.
    fn walls<E: Entry<D>>(
        &self,
        cluster: &mut Cluster<'_, D>,
        of_walls: impl Fn(&Neighbourhood<'_, D>) -> CouplingRow<E, D>,
    ) -> [CouplingRow<E, D>; MOST] {
        let nothing = CouplingRow {
            wall: E::ZERO,
            source: Vect::zeros(),
        };
        let mut walls = [nothing; MOST];
        let needs = |i| self.coupling.walls_need_neighbours(i);
        if cluster.members().any(needs) {
            cluster.rows(|k, rows| walls[k] = of_walls(rows));
        } else {
            for (k, walls) in walls.iter_mut().enumerate().take(cluster.members().len()) {
                let rows = cluster.walls(k);
                // Most particles are far from all walls.
                if !(rows.wall.index.is_empty() && rows.contacts.is_empty()) {
                    *walls = of_walls(&rows);
                }
            }
        }
        walls
    }
}
