//! The linear system of a step with implicit friction.

use sph_core::{StepError, Vect, fields};
use sph_implicit::{Block, Entries, Entry, Matrix, Row, Values, assemble, dot};
use sph_neighbours::{Neighbourhood, World};

use crate::{Coupling, Weak};

/// Coupling of a pair over its smaller mass up to which it is taken explicitly: hundreds of neighbours together are far from
/// the bound of 1, and a step of water beside mud has a matrix of the mud alone.
const SOFT: f64 = 1e-3;

/// A system on the way to its solver.
pub(crate) struct System<const D: usize> {
    pub matrix: Matrix<D>,
    /// Mγ of every row, kg.
    pub mass: Vec<f64>,
    /// Δt s.
    pub right: Vec<Vect<D>>,
}

impl<const D: usize> System<D> {
    /// The system of a step; `part` is the share of it for which friction acts from its end, and Δt. The memory of
    /// `former` entries is used again.
    pub fn of(
        coupling: &dyn Coupling<D>,
        world: &World<D>,
        earlier: &[Vect<D>],
        part: [f64; 2],
        former: Option<Entries<D>>,
    ) -> Result<Self, StepError> {
        match (coupling.mixes_components(), former) {
            (false, Some(Entries::Scalar(former))) => {
                Self::scalar(coupling, world, earlier, part, former)
            }
            (false, _) => Self::scalar(coupling, world, earlier, part, Values::default()),
            (true, Some(Entries::Block(former))) => {
                Self::block(coupling, world, earlier, part, former)
            }
            (true, _) => Self::block(coupling, world, earlier, part, Values::default()),
        }
    }

    fn scalar(
        coupling: &dyn Coupling<D>,
        world: &World<D>,
        earlier: &[Vect<D>],
        part: [f64; 2],
        former: Values<f64>,
    ) -> Result<Self, StepError> {
        let bound = coupling.bind(world)?;
        let entries = (former, Entries::Scalar);
        Self::with(world, earlier, part, entries, |rows, weak, out| {
            let row = bound.scalar_row(rows, weak, out);
            (row.wall, row.source)
        })
    }

    fn block(
        coupling: &dyn Coupling<D>,
        world: &World<D>,
        earlier: &[Vect<D>],
        part: [f64; 2],
        former: Values<Block<D>>,
    ) -> Result<Self, StepError> {
        let bound = coupling.bind(world)?;
        let entries = (former, Entries::Block);
        Self::with(world, earlier, part, entries, |rows, weak, out| {
            let row = bound.block_row(rows, weak, out);
            (row.wall, row.source)
        })
    }

    fn with<E: Entry<D>>(
        world: &World<D>,
        earlier: &[Vect<D>],
        [share, dt]: [f64; 2],
        (former, entries): (Values<E>, impl FnOnce(Values<E>) -> Entries<D>),
        friction: impl Fn(
            &Neighbourhood<'_, D>,
            Option<Weak<'_, D>>,
            &mut Vec<(u32, E)>,
        ) -> (E, Vect<D>)
        + Sync,
    ) -> Result<Self, StepError> {
        let gamma = world.free.get(fields::RENORMALISATION).ok();
        let mass = world.free.get(fields::MASS)?.iter().enumerate();
        let mass: Vec<f64> = mass.map(|(i, m)| gamma.map_or(*m, |g| m * g[i])).collect();
        let limit: Vec<f64> = mass.iter().map(|m| SOFT / dt * m).collect();
        let weak = (share == 1.0).then_some(Weak {
            velocity: earlier,
            limit: &limit,
        });
        let (pattern, values, right) = assemble(world, former, |rows, out: &mut Vec<(u32, E)>| {
            let (wall, source) = friction(rows, weak, out);
            out.iter_mut().for_each(|(_, c)| *c = c.times(share * dt));
            Row {
                own: E::unit(mass[rows.particle]).plus(&wall.times(share * dt)),
                source: source * dt,
            }
        })?;
        Ok(System {
            matrix: Matrix::new(pattern, entries(values)),
            mass,
            right,
        })
    }
}

/// The best start on the line from uⁿ to u*, in the norm of the matrix: where friction balances the
/// other forces it is uⁿ, where there is little of it u*.
pub(crate) fn start_between<const D: usize>(
    system: &System<D>,
    image: &[Vect<D>],
    earlier: &[Vect<D>],
    velocity: &mut [Vect<D>],
) {
    let ahead: Vec<Vect<D>> = velocity.iter().zip(earlier).map(|(u, e)| u - e).collect();
    let mut image_ahead = vec![Vect::zeros(); ahead.len()];
    system.matrix.multiply(&ahead, &mut image_ahead);
    let missing: Vec<Vect<D>> = system.right.iter().zip(image).map(|(b, a)| b - a).collect();
    let (along, curvature) = (dot(&ahead, &missing), dot(&ahead, &image_ahead));
    let part = if curvature > 0.0 {
        along / curvature
    } else {
        0.0
    };
    let both = velocity.iter_mut().zip(earlier).zip(&ahead);
    both.for_each(|((u, e), a)| *u = e + a * part);
}
