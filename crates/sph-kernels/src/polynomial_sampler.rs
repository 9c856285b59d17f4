//! The sampler of piecewise polynomial kernels, in blocks that become vector instructions.

use crate::factored::{self, Piece};
use crate::sampler::assert_smoothing_length;
use crate::{PiecewisePolynomial, Sampler};

/// Distances per block.
const LANES: usize = 8;

type Block = [f64; LANES];

/// Divisor instead of q = 0 where the first piece has a cusp, f'(0) ≠ 0: F stays finite.
const SMALLEST_Q: f64 = 1e-9;

/// [`Sampler`] of a [`PiecewisePolynomial`].
///
/// Coefficients hold σ_d/h^d and σ_d/h^(d+2). Every block evaluates all pieces at all its
/// distances and selects, so that nothing branches on a distance; a last partial block is
/// filled up, so that all distances see the same operations. There is no fused
/// multiply-add, hence the bits do not depend on the processor.
#[derive(Clone, Debug)]
pub struct PolynomialSampler {
    dimension: usize,
    h: f64,
    per_h: f64,
    support: f64,
    radius: f64,
    radius_squared: f64,
    smallest_divisor: f64,
    value: Vec<Piece>,
    factor: Vec<Piece>,
}

impl PolynomialSampler {
    /// Binds a shape to a dimension (1, 2, 3) and the smoothing length h in m.
    ///
    /// # Panics
    /// If the shape is refused by [`PiecewisePolynomial::check`], the dimension is not 1, 2
    /// or 3 or h is not positive.
    pub fn new(shape: &PiecewisePolynomial, dimension: usize, h: f64) -> Self {
        assert_smoothing_length(h);
        assert_eq!(shape.check(), Ok(()));
        let scale = shape.normalisation(dimension) / h.powi(dimension as i32);
        let factor = factored::factor(shape, scale / (h * h));
        let smallest_divisor = if factor[0].over_q { SMALLEST_Q } else { shape.breaks[1] };
        let radius = shape.support() * h;
        Self {
            dimension,
            h,
            per_h: 1.0 / h,
            support: shape.support(),
            radius,
            radius_squared: radius * radius,
            smallest_divisor,
            value: factored::value(shape, scale),
            factor,
        }
    }

    /// q = r/h, at most the support.
    #[inline(always)]
    fn q(&self, r2: &Block) -> Block {
        let mut q = [0.0; LANES];
        for i in 0..LANES {
            let free = r2[i].sqrt() * self.per_h;
            q[i] = if free > self.support { self.support } else { free };
        }
        q
    }

    /// The piece that holds each q, exactly 0 from the support radius on.
    #[inline(always)]
    fn sum(&self, pieces: &[Piece], r2: &Block, q: &Block) -> Block {
        let mut result = [0.0; LANES];
        for piece in pieces.iter().rev() {
            let p = self.piece(piece, q);
            for i in 0..LANES {
                result[i] = if q[i] >= piece.until { result[i] } else { p[i] };
            }
        }
        for i in 0..LANES {
            result[i] = if r2[i] >= self.radius_squared { 0.0 } else { result[i] };
        }
        result
    }

    #[inline(always)]
    fn piece(&self, piece: &Piece, q: &Block) -> Block {
        let mut s = [0.0; LANES];
        for i in 0..LANES {
            s[i] = (q[i] - piece.origin).abs();
        }
        let mut result = horner(&piece.coefficients, &s);
        if piece.root > 0 {
            let mut u = [0.0; LANES];
            for i in 0..LANES {
                u[i] = self.support - q[i];
            }
            times_power(&mut result, u, piece.root);
        }
        if piece.over_q {
            for i in 0..LANES {
                let small = q[i] < self.smallest_divisor;
                result[i] /= if small { self.smallest_divisor } else { q[i] };
            }
        }
        result
    }

    #[inline(always)]
    fn value_block(&self, r2: &Block) -> Block {
        self.sum(&self.value, r2, &self.q(r2))
    }

    #[inline(always)]
    fn factor_block(&self, r2: &Block) -> Block {
        self.sum(&self.factor, r2, &self.q(r2))
    }

    #[inline(always)]
    fn both_block(&self, r2: &Block) -> (Block, Block) {
        let q = self.q(r2);
        (self.sum(&self.value, r2, &q), self.sum(&self.factor, r2, &q))
    }
}

/// Σ c_n sⁿ with the number of coefficients known to the compiler up to eight.
#[inline(always)]
fn horner(coefficients: &[f64], s: &Block) -> Block {
    #[inline(always)]
    fn unrolled<const N: usize>(c: &[f64; N], s: &Block) -> Block {
        let mut sum = [c[N - 1]; LANES];
        for n in (0..N - 1).rev() {
            for i in 0..LANES {
                sum[i] = sum[i] * s[i] + c[n];
            }
        }
        sum
    }
    macro_rules! by_length {
        ($($n:literal)*) => {
            match coefficients.len() {
                $($n => unrolled::<$n>(coefficients.first_chunk().expect("this length"), s),)*
                _ => {
                    let mut sum = [0.0; LANES];
                    for c in coefficients.iter().rev() {
                        for i in 0..LANES {
                            sum[i] = sum[i] * s[i] + c;
                        }
                    }
                    sum
                }
            }
        };
    }
    by_length!(1 2 3 4 5 6 7 8)
}

/// Multiplies by uⁿ, by repeated squaring.
#[inline(always)]
fn times_power(result: &mut Block, mut u: Block, mut n: usize) {
    loop {
        if n & 1 == 1 {
            for i in 0..LANES {
                result[i] *= u[i];
            }
        }
        n >>= 1;
        if n == 0 {
            return;
        }
        for u in &mut u {
            *u *= *u;
        }
    }
}

/// Applies `f` block by block; the last partial block is filled up with zeros.
#[inline(always)]
fn sweep(r2: &[f64], result: &mut [f64], f: impl Fn(&Block) -> Block) {
    assert_eq!(r2.len(), result.len());
    let (blocks, rest) = r2.as_chunks();
    let (results, result_rest) = result.as_chunks_mut();
    for (r2, result) in blocks.iter().zip(results) {
        *result = f(r2);
    }
    if !rest.is_empty() {
        let mut filled = [0.0; LANES];
        filled[..rest.len()].copy_from_slice(rest);
        result_rest.copy_from_slice(&f(&filled)[..rest.len()]);
    }
}

impl Sampler for PolynomialSampler {
    fn dimension(&self) -> usize {
        self.dimension
    }

    fn smoothing_length(&self) -> f64 {
        self.h
    }

    fn support_radius(&self) -> f64 {
        self.radius
    }

    fn value_at_zero(&self) -> f64 {
        self.at(0.0).0
    }

    fn at(&self, r: f64) -> (f64, f64) {
        let (w, factor) = self.both_block(&[r * r; LANES]);
        (w[0], factor[0])
    }

    fn value(&self, r2: &[f64], w: &mut [f64]) {
        sweep(r2, w, |r2| self.value_block(r2));
    }

    fn gradient_factor(&self, r2: &[f64], factor: &mut [f64]) {
        sweep(r2, factor, |r2| self.factor_block(r2));
    }

    fn both(&self, r2: &[f64], w: &mut [f64], factor: &mut [f64]) {
        sweep(r2, w, |r2| self.value_block(r2));
        sweep(r2, factor, |r2| self.factor_block(r2));
    }
}
