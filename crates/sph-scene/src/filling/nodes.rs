//! The lattice of one body: how many nodes along each axis and where they are.

use crate::geometry::periodic_place::{PeriodicRegion, ROUNDING};

/// Origin of the lattice of a body, counted from the lower corner of the box around it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Offset {
    /// Nodes at whole spacings: a row stands one spacing off the body's side. A node is kept if
    /// it is at least half a spacing inside.
    None,
    /// Nodes at half spacings: a row stands half a spacing off the body's side. A node is kept
    /// if it is inside.
    Half,
}

impl Offset {
    /// The offset as a fraction of the spacing.
    pub fn shift(self) -> f64 {
        match self {
            Offset::None => 0.0,
            Offset::Half => 0.5,
        }
    }
}

/// Nodes lo + (k + shift)·δr for k below the count, along every axis.
pub(crate) struct Nodes<const D: usize> {
    origin: [f64; D],
    step: [f64; D],
    counts: [usize; D],
}

impl<const D: usize> Nodes<D> {
    pub fn new(placed: &PeriodicRegion<'_, D>, spacing: f64, offset: Offset) -> Self {
        let (lo, hi) = placed.bounds();
        let spans = placed.spans();
        let shift = offset.shift();
        let length = |k: usize| (hi[k] - lo[k]) / spacing;
        let counts = |k: usize| match (spans[k], offset) {
            (true, _) => length(k).round().max(1.0) as usize,
            (false, Offset::None) => (length(k) + ROUNDING).floor() as usize + 1,
            (false, Offset::Half) => (length(k) + 0.5).ceil() as usize,
        };
        let step = |k: usize| match spans[k] {
            true => (hi[k] - lo[k]) / length(k).round().max(1.0),
            false => spacing,
        };
        let step: [f64; D] = std::array::from_fn(step);
        Nodes {
            origin: std::array::from_fn(|k| lo[k] + shift * step[k]),
            step,
            counts: std::array::from_fn(counts),
        }
    }

    /// Every node, the first axis running slowest.
    pub fn iter(&self) -> impl Iterator<Item = [f64; D]> + '_ {
        let mut index = [0usize; D];
        let mut done = self.counts.contains(&0);
        std::iter::from_fn(move || {
            if done {
                return None;
            }
            let node = std::array::from_fn(|k| self.origin[k] + index[k] as f64 * self.step[k]);
            done = true;
            for k in (0..D).rev() {
                index[k] += 1;
                if index[k] < self.counts[k] {
                    done = false;
                    break;
                }
                index[k] = 0;
            }
            Some(node)
        })
    }
}
