//! The space of vectors with a value for each particle.

use std::sync::Arc;

use rayon::prelude::*;
use sph_core::{StepError, Vect};

use crate::decomposition::Link;
use crate::{Owned, World};

/// The vectors of a solve, with a value for each particle: copies of particles that are at home elsewhere follow their
/// owners, and products are those of all rows. Where all particles are here, nothing has to follow.
pub struct Space<const D: usize> {
    link: Option<Arc<Link>>,
    /// The rows that count.
    pub owned: Owned,
    /// Particles, copies among them.
    pub particles: usize,
}

/// Members of one partial sum.
const PART: usize = 2048;
/// Partial sums that are made side by side.
const TOGETHER: usize = 64;
/// Rows of one partial sum where some do not count.
const BATCH: usize = 4096;

impl<const D: usize> World<D> {
    /// The space of a solve, which begins.
    ///
    /// # Errors
    /// If the particles elsewhere are lost.
    pub fn space(&self) -> Result<Space<D>, StepError> {
        if let Some(link) = &self.communicator {
            link.any(false, false)?;
        }
        Ok(Space {
            link: self.communicator.clone(),
            owned: self.owned(),
            particles: self.free.len(),
        })
    }
}

impl<const D: usize> Space<D> {
    /// True if all rows are here.
    pub fn is_whole(&self) -> bool {
        self.link.is_none()
    }

    /// Gives copies the values of their owners.
    pub fn refresh<const C: usize>(&self, values: &mut [Vect<C>]) {
        if let Some(link) = &self.link {
            link.mirror(values);
        }
    }

    /// The same of values that follow from a mark of their particle: `of` makes that of a copy from its owner's.
    pub fn refresh_marked<T>(
        &self,
        values: &mut [T],
        mark: impl Fn(&T) -> bool,
        of: impl Fn(usize, bool) -> T,
    ) {
        let (Some(link), Some(own)) = (&self.link, self.owned.marks()) else {
            return;
        };
        let marks = values.iter().map(|value| f64::from(u8::from(mark(value))));
        let mut marks: Vec<Vect<1>> = marks.map(|mark| Vect::from([mark])).collect();
        link.mirror(&mut marks);
        let all = values.iter_mut().zip(own).enumerate();
        for (i, (value, _)) in all.filter(|(_, (_, own))| !**own) {
            *value = of(i, marks[i][0] > 0.0);
        }
    }

    /// Σ x·y over all rows; the same bits for all.
    pub fn inner<const C: usize>(&self, x: &[Vect<C>], y: &[Vect<C>]) -> f64 {
        self.inner_of(&self.owned, x, y)
    }

    /// The same of rows of which some are `owned`.
    pub fn inner_of<const C: usize>(&self, owned: &Owned, x: &[Vect<C>], y: &[Vect<C>]) -> f64 {
        match (&self.link, owned.marks()) {
            (Some(link), Some(own)) => link.add(inner_of(x, y, own)),
            _ => inner(x, y),
        }
    }

    /// True if it holds for all particles with rows.
    pub fn all(&self, holds: bool) -> bool {
        match &self.link {
            None => holds,
            Some(link) => link.most(f64::from(u8::from(!holds))) == 0.0,
        }
    }

    /// The largest value of all particles with rows.
    pub fn largest(&self, value: f64) -> f64 {
        self.link.as_ref().map_or(value, |link| link.most(value))
    }
}

/// Σ x·y, in an order that does not depend on the number of threads.
pub fn inner<const C: usize>(x: &[Vect<C>], y: &[Vect<C>]) -> f64 {
    let part =
        |(x, y): (&[Vect<C>], &[Vect<C>])| -> f64 { x.iter().zip(y).map(|(a, b)| a.dot(b)).sum() };
    let all = x.chunks(TOGETHER * PART).zip(y.chunks(TOGETHER * PART));
    let mut sum = 0.0;
    for (x, y) in all {
        let mut sums = [0.0; TOGETHER];
        let parts = x.par_chunks(PART).zip(y.par_chunks(PART));
        let count = parts.len();
        let parts = parts.zip(&mut sums);
        parts.for_each(|(both, sum)| *sum = part(both));
        sum = sums[..count].iter().fold(sum, |sum, part| sum + part);
    }
    sum
}

/// Σ x·y over the rows that are one's own, in an order that does not depend on threads.
fn inner_of<const C: usize>(x: &[Vect<C>], y: &[Vect<C>], own: &[bool]) -> f64 {
    let batches = x.par_chunks(BATCH).zip(y.par_chunks(BATCH));
    let parts = batches.zip(own.par_chunks(BATCH)).map(|((x, y), own)| {
        let rows = x.iter().zip(y).zip(own).filter(|(_, own)| **own);
        rows.map(|((x, y), _)| x.dot(y)).sum::<f64>()
    });
    let parts: Vec<f64> = parts.collect();
    parts.iter().sum()
}
