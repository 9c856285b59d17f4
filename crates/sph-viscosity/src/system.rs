//! The linear system of a step with implicit friction.

use std::sync::Arc;

use sph_core::{StepError, Vect, fields};
use sph_implicit::{Assembly, Block, Entries, Matrix, Values, dot};
use sph_neighbours::World;

use crate::friction_rows::{FrictionEntry, FrictionRows};
use crate::{Coupling, Weak};

/// Coupling of a pair over its smaller mass up to which it is taken explicitly: hundreds of neighbours together are far from
/// the bound of 1, and a step of water beside mud has a matrix of the mud alone.
const SOFT: f64 = 1e-3;

/// A system on the way to its solver, and the memory of those before.
#[derive(Default)]
pub(crate) struct System<const D: usize> {
    pub matrix: Matrix<D>,
    /// Mγ of every row, kg.
    pub mass: Vec<f64>,
    /// Δt s.
    pub right: Vec<Vect<D>>,
    scalar: Assembly<f64, D>,
    block: Assembly<Block<D>, D>,
    limit: Vec<f64>,
}

impl<const D: usize> System<D> {
    /// Fills in the system of a step; `part` is the share of it for which friction acts from its end, and Δt.
    pub fn fill(
        &mut self,
        coupling: &dyn Coupling<D>,
        world: &World<D>,
        earlier: &[Vect<D>],
        [share, dt]: [f64; 2],
    ) -> Result<(), StepError> {
        self.give_back();
        let gamma = world.free.get(fields::RENORMALISATION).ok();
        let mass = world.free.get(fields::MASS)?.iter().enumerate();
        self.mass.clear();
        self.mass
            .extend(mass.map(|(i, m)| gamma.map_or(*m, |g| m * g[i])));
        self.limit.clear();
        self.limit.extend(self.mass.iter().map(|m| SOFT / dt * m));
        let bound = coupling.bind(world)?;
        let rows = FrictionRows {
            coupling: &*bound,
            weak: (share == 1.0).then_some(Weak {
                velocity: earlier,
                limit: &self.limit,
            }),
            mass: &self.mass,
            ahead: share * dt,
            dt,
        };
        self.matrix = match coupling.mixes_components() {
            false => filled(
                &mut self.scalar,
                Entries::Scalar,
                world,
                &rows,
                &mut self.right,
            )?,
            true => filled(
                &mut self.block,
                Entries::Block,
                world,
                &rows,
                &mut self.right,
            )?,
        };
        Ok(())
    }

    /// Lets the memory of the last matrix be used again.
    fn give_back(&mut self) {
        let Matrix { pattern, entries } = std::mem::take(&mut self.matrix);
        let pattern = Arc::try_unwrap(pattern).unwrap_or_default();
        match entries {
            Entries::Scalar(values) => {
                (self.scalar.pattern, self.scalar.values) = (pattern, values);
            }
            Entries::Block(values) => {
                (self.block.pattern, self.block.values) = (pattern, values);
            }
        }
    }
}

/// The matrix of an assembly, and its right-hand side.
fn filled<const D: usize, E: FrictionEntry<D>>(
    assembly: &mut Assembly<E, D>,
    entries: impl FnOnce(Values<E>) -> Entries<D>,
    world: &World<D>,
    rows: &FrictionRows<'_, D>,
    right: &mut Vec<Vect<D>>,
) -> Result<Matrix<D>, StepError> {
    assembly.fill(world, |cluster, all| rows.add(cluster, all))?;
    std::mem::swap(right, &mut assembly.sources);
    let pattern = std::mem::take(&mut assembly.pattern);
    Ok(Matrix::new(
        pattern,
        entries(std::mem::take(&mut assembly.values)),
    ))
}

/// Vectors of a start, for their memory.
#[derive(Default)]
pub(crate) struct Start<const D: usize> {
    /// K uⁿ, with the mass.
    pub image: Vec<Vect<D>>,
    ahead: Vec<Vect<D>>,
    image_ahead: Vec<Vect<D>>,
    missing: Vec<Vect<D>>,
}

impl<const D: usize> Start<D> {
    /// The best start on the line from uⁿ to u*, in the norm of the matrix: where friction balances the
    /// other forces it is uⁿ, where there is little of it u*. `image` is there already.
    pub fn between(&mut self, system: &System<D>, earlier: &[Vect<D>], velocity: &mut [Vect<D>]) {
        let ahead = velocity.iter().zip(earlier).map(|(u, e)| u - e);
        put(&mut self.ahead, ahead);
        self.image_ahead.resize(self.ahead.len(), Vect::zeros());
        system.matrix.multiply(&self.ahead, &mut self.image_ahead);
        let missing = system.right.iter().zip(&self.image).map(|(b, a)| b - a);
        put(&mut self.missing, missing);
        let along = dot(&self.ahead, &self.missing);
        let curvature = dot(&self.ahead, &self.image_ahead);
        let part = if curvature > 0.0 {
            along / curvature
        } else {
            0.0
        };
        let both = velocity.iter_mut().zip(earlier).zip(&self.ahead);
        both.for_each(|((u, e), a)| *u = e + a * part);
    }
}

/// Fills a vector anew.
pub(crate) fn put<T>(to: &mut Vec<T>, from: impl Iterator<Item = T>) {
    to.clear();
    to.extend(from);
}
