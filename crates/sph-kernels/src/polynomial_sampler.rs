//! The sampler of piecewise polynomial kernels: slices in vector instructions.

use crate::factored;
use crate::formula::{AnyPieces, Formula, Product, Selection};
use crate::lanes::{Body, Lane, dispatch};
use crate::sampler::assert_smoothing_length;
use crate::{PiecewisePolynomial, Sampler};

/// The fast [`Sampler`] of a shape in d = 1, 2, 3 dimensions with the smoothing length h in m.
///
/// Coefficients hold σ_d/h^d and σ_d/h^(d+2). All pieces are evaluated at every distance and
/// one is selected, so that nothing branches on a distance; the sizes of all built-in kernels
/// are known to the compiler, and other shapes take a general and slower path. There is no
/// fused multiply-add: the bits depend neither on the place in the slice nor on the processor.
///
/// # Panics
/// If the shape is refused by [`PiecewisePolynomial::check`], the dimension is not 1, 2 or 3 or h is not positive.
pub fn polynomial_sampler(
    shape: &PiecewisePolynomial,
    dimension: usize,
    h: f64,
) -> Box<dyn Sampler> {
    assert_smoothing_length(h);
    assert_eq!(shape.check(), Ok(()));
    let scale = shape.normalisation(dimension) / h.powi(dimension as i32);
    let value = factored::value(shape, scale);
    let factor = factored::factor(shape, scale / (h * h));
    let radius = shape.support() * h;
    let range = Range {
        dimension,
        h,
        per_h: 1.0 / h,
        support: shape.support(),
        radius,
        radius_squared: radius * radius,
    };
    macro_rules! first_fit {
        ($($value:ty, $factor:ty;)*) => {
            $(if let (Some(value), Some(factor)) = (<$value>::from_pieces(&value), <$factor>::from_pieces(&factor)) {
                return Box::new(PolynomialSampler { range, value, factor });
            })*
        };
    }
    first_fit! {
        Product<4, 2>, Product<3, 1>;                   // Wendland C2
        Product<6, 3>, Product<5, 2>;                   // C4
        Product<8, 4>, Product<7, 3>;                   // C6
        Selection<2, 4, false>, Selection<2, 3, true>;  // cubic spline
        Selection<3, 5, false>, Selection<3, 4, true>;  // quartic
        Selection<3, 6, false>, Selection<3, 5, true>;  // quintic
    }
    Box::new(PolynomialSampler {
        range,
        value: AnyPieces(value),
        factor: AnyPieces(factor),
    })
}

#[derive(Clone, Debug)]
struct Range {
    dimension: usize,
    h: f64,
    per_h: f64,
    support: f64,
    radius: f64,
    radius_squared: f64,
}

impl Range {
    /// q = r/h, the support itself from the support radius on.
    #[inline(always)]
    fn q(&self, r2: f64) -> f64 {
        let free = r2.sqrt() * self.per_h;
        let outside = (r2 >= self.radius_squared) | (free > self.support);
        if outside { self.support } else { free }
    }

    /// Leaves a formula's values at the squared distances in `out`.
    fn fill<F: Formula>(&self, formula: &F, r2: &[f64], out: &mut [f64]) {
        assert_eq!(r2.len(), out.len());
        dispatch(Loop {
            range: self,
            formula,
            r2,
            out,
        });
    }
}

#[derive(Clone, Debug)]
struct PolynomialSampler<V, F> {
    range: Range,
    value: V,
    factor: F,
}

impl<V: Formula, F: Formula> Sampler for PolynomialSampler<V, F> {
    fn dimension(&self) -> usize {
        self.range.dimension
    }
    fn smoothing_length(&self) -> f64 {
        self.range.h
    }
    fn support_radius(&self) -> f64 {
        self.range.radius
    }
    fn value_at_zero(&self) -> f64 {
        self.value.at(0.0)
    }
    fn at(&self, r: f64) -> (f64, f64) {
        let q = self.range.q(r * r);
        (self.value.at(q), self.factor.at(q))
    }
    fn value(&self, r2: &[f64], w: &mut [f64]) {
        self.range.fill(&self.value, r2, w);
    }
    fn gradient_factor(&self, r2: &[f64], factor: &mut [f64]) {
        self.range.fill(&self.factor, r2, factor);
    }
}

/// A formula over a slice; the compiler fills lanes of any width.
struct Loop<'a, F> {
    range: &'a Range,
    formula: &'a F,
    r2: &'a [f64],
    out: &'a mut [f64],
}

impl<F: Formula> Body for Loop<'_, F> {
    type Output = ();
    #[inline(always)]
    fn call<L: Lane>(self) {
        for (out, r2) in self.out.iter_mut().zip(self.r2) {
            *out = self.formula.at(self.range.q(*r2));
        }
    }
}
