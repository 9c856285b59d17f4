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

/// Adds walls to sums over free neighbours, and makes rates of them. Not in the loop over lanes, which every sweep runs.
#[inline(never)]
pub(crate) fn with_walls<const D: usize, B: BoundTerm<D>>(
    term: &B,
    heres: &[B::Here],
    sums: &[B::Sum],
    walled: &[Walled<'_, D>],
    rates: &mut [Rates<D>],
) {
    for (walled, rates) in walled.iter().zip(rates) {
        let (here, mut sum) = (&heres[walled.member], sums[walled.member]);
        if !walled.points.index.is_empty() {
            each(&walled.points, |v, pair| term.wall(here, v, pair, &mut sum));
        }
        for contact in walled.contacts {
            term.element(here, &contact, &mut sum);
        }
        term.finish(here, &sum, walled.inverse_renormalisation, rates);
    }
}
