//! Members of a cluster with other walls than their own: what a wall does is the difference of such sums.

use crate::term::{BoundTerm, Rates, each};
use crate::{ContactRow, Row};

/// A member of a cluster with chosen walls in the place of its own.
#[derive(Clone, Copy, Debug)]
pub struct Walled<'a, const D: usize> {
    /// Its place in the cluster.
    pub member: usize,
    /// Its wall points.
    pub points: Row<'a, D>,
    /// Its wall elements.
    pub contacts: ContactRow<'a, D>,
    /// 1/γ.
    pub inverse_renormalisation: f64,
}

/// Adds the walls to a sum over free neighbours, and makes rates of it.
#[inline(always)]
pub(crate) fn with_walls<const D: usize, B: BoundTerm<D>>(
    term: &B,
    here: &B::Here,
    mut sum: B::Sum,
    walls: &Walled<'_, D>,
    rates: &mut Rates<D>,
) {
    if !walls.points.index.is_empty() {
        each(&walls.points, |v, pair| term.wall(here, v, pair, &mut sum));
    }
    for contact in walls.contacts {
        term.element(here, &contact, &mut sum);
    }
    term.finish(here, &sum, walls.inverse_renormalisation, rates);
}
