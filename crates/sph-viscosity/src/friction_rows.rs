//! Rows of the system M + θΔt K, cluster by cluster.

use sph_core::Vect;
use sph_implicit::{Block, Entry, Rows};
use sph_neighbours::{Cluster, MOST, Neighbourhood};

use crate::{BoundCoupling, CouplingRow, Weak};

/// An entry of a friction's matrix: a number, or a block where components are mixed.
pub trait FrictionEntry<const D: usize>: Entry<D> {
    /// W and s of walls.
    fn walls(coupling: &dyn BoundCoupling<D>, rows: &Neighbourhood<'_, D>) -> CouplingRow<Self, D>;
}

impl<const D: usize> FrictionEntry<D> for f64 {
    fn walls(coupling: &dyn BoundCoupling<D>, rows: &Neighbourhood<'_, D>) -> CouplingRow<f64, D> {
        coupling.scalar_walls(rows)
    }
}

impl<const D: usize> FrictionEntry<D> for Block<D> {
    fn walls(
        coupling: &dyn BoundCoupling<D>,
        rows: &Neighbourhood<'_, D>,
    ) -> CouplingRow<Block<D>, D> {
        coupling.block_walls(rows)
    }
}

/// What the rows of a system are made of.
pub struct FrictionRows<'a, const D: usize> {
    /// The friction.
    pub coupling: &'a dyn BoundCoupling<D>,
    /// Pairs that are not solved for.
    pub weak: Option<Weak<'a, D>>,
    /// Mγ of every particle, kg.
    pub mass: &'a [f64],
    /// θΔt, s.
    pub ahead: f64,
    /// Δt, s.
    pub dt: f64,
}

impl<const D: usize> FrictionRows<'_, D> {
    /// Adds the rows of a cluster: Mγ + θΔt (W + Σ C) on the diagonal, −θΔt C beside it, and Δt s with the force of the weak pairs.
    pub fn add<E: FrictionEntry<D>>(&self, cluster: &mut Cluster<'_, D>, rows: &mut Rows<E, D>) {
        let mut numbers = std::mem::take(&mut rows.numbers);
        self.coupling.strengths(cluster, &mut numbers);
        let walls = self.walls::<E>(cluster);
        let all = cluster.candidates().len();
        let lanes = cluster.lanes();
        let numbers_of = numbers.chunks_exact(3 * lanes);
        for ((lane, i), walls) in cluster.members().enumerate().zip(walls) {
            rows.begin(all);
            let mut of_weak = Vect::zeros();
            // Summed along with the couplings, which need not be read again.
            let mut diagonal = E::unit(self.mass[i]).plus(&walls.wall.times(self.ahead));
            let pairs = cluster.candidates().iter().zip(numbers_of.clone());
            for (&column, numbers) in pairs {
                let norm = numbers[2 * lanes + lane];
                // Half of a cluster's candidates are beyond the support of any one member.
                if norm == 0.0 {
                    continue;
                }
                let j = column as usize;
                let (even, along) = (numbers[lane], numbers[lanes + lane]);
                let limit = self.weak.map_or(0.0, |w| w.limit[i].min(w.limit[j]));
                // Not ">": what is not a number has to be seen by the solver.
                let strong = norm.is_nan() || norm > limit;
                let apart = cluster.separation(i, j);
                // Both for all pairs, one of them 0: strong and weak ones follow each other without a pattern.
                let pick = |a: f64, of: bool| if of { a } else { 0.0 };
                let coupled = [pick(even, strong), pick(along, strong)];
                let entry = E::central(coupled[0], coupled[1], &apart).times(self.ahead);
                rows.couple(column, &entry, strong);
                diagonal = diagonal.plus(&entry);
                if let Some(weak) = self.weak {
                    let u = weak.velocity[i] - weak.velocity[j];
                    let [even, along] = [pick(even, !strong), pick(along, !strong)];
                    of_weak -= u * even + apart * (along * u.dot(&apart));
                }
            }
            rows.close(diagonal, (walls.source + of_weak) * self.dt);
        }
        rows.numbers = numbers;
    }

    /// W and s of all members; those after the last one are nothing.
    fn walls<E: FrictionEntry<D>>(
        &self,
        cluster: &mut Cluster<'_, D>,
    ) -> [CouplingRow<E, D>; MOST] {
        let nothing = CouplingRow {
            wall: E::ZERO,
            source: Vect::zeros(),
        };
        let mut walls = [nothing; MOST];
        let coupling = self.coupling;
        if cluster.members().any(|i| coupling.walls_need_neighbours(i)) {
            cluster.rows(|k, rows| walls[k] = E::walls(coupling, rows));
        } else {
            for (k, walls) in walls.iter_mut().enumerate().take(cluster.members().len()) {
                *walls = E::walls(coupling, &cluster.walls(k));
            }
        }
        walls
    }
}
