//! Start values of a solve.

use sph_core::Vect;

use crate::linear::Operator;

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
    pub fn between(
        &mut self,
        (operator, right): (&dyn Operator<D>, &[Vect<D>]),
        earlier: &[Vect<D>],
        velocity: &mut [Vect<D>],
    ) {
        let ahead = velocity.iter().zip(earlier).map(|(u, e)| u - e);
        put(&mut self.ahead, ahead);
        self.image_ahead.resize(self.ahead.len(), Vect::zeros());
        operator.multiply(&self.ahead, &mut self.image_ahead);
        let missing = right.iter().zip(&self.image).map(|(b, a)| b - a);
        put(&mut self.missing, missing);
        let along = operator.inner(&self.ahead, &self.missing);
        let curvature = operator.inner(&self.ahead, &self.image_ahead);
        let part = match curvature > 0.0 {
            true => along / curvature,
            false => 0.0,
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
