//! Logarithm and angle in lanes, of the same bits in every width and on every processor.
//!
//! The C library picks other variants by the processor, whose last digits differ.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, LN_2, PI};

use crate::lanes::Lane;

/// Below this over the larger of both sides atan is its series; from [`STEEP`] on it is taken from π/4.
const FLAT: f64 = 7.0 / 16.0;
const STEEP: f64 = 11.0 / 16.0;
/// atan(1/2), and its rounding error.
const ATAN_HALF: [f64; 2] = [4.636_476_090_008_061e-1, 2.269_877_745_296_169e-17];
/// Rounding error of π/4.
const QUARTER_LOW: f64 = 3.061_616_997_868_383e-17;
/// atan(t) = t − t³ Σ c_n t²ⁿ for |t| ≤ 7/16: Remez, error 2⁻⁵⁹ (fdlibm 5.3, s_atan.c).
const ATAN: [f64; 11] = [
    3.333_333_333_333_293e-1,
    -1.999_999_999_987_648_3e-1,
    1.428_571_427_250_346_6e-1,
    -1.111_111_040_546_235_6e-1,
    9.090_887_133_436_507e-2,
    -7.691_876_205_044_83e-2,
    6.661_073_137_387_531e-2,
    -5.833_570_133_790_573_5e-2,
    4.976_877_994_615_932e-2,
    -3.653_157_274_421_691_6e-2,
    1.628_582_011_536_578_2e-2,
];
/// ln 2 in two parts: products of the first with whole numbers are exact.
const LN_2_HIGH: f64 = 0.693_147_180_369_123_8;
const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;
/// ln(1 + f) = f − f²/2 + s (f²/2 + Σ c_n s²ⁿ⁺²), s = f/(2 + f): Remez, error 2⁻⁵⁸ (fdlibm 5.3, e_log.c).
const LOG: [f64; 7] = [
    6.666_666_666_666_735e-1,
    3.999_999_999_940_942e-1,
    2.857_142_874_366_239e-1,
    2.222_219_843_214_978_4e-1,
    1.818_357_216_161_805e-1,
    1.531_383_769_920_937_3e-1,
    1.479_819_860_511_658_6e-1,
];

/// c₀ + c₁ x + …
#[inline(always)]
fn series<L: Lane, const N: usize>(coefficients: &[f64; N], x: L) -> L {
    let mut sum = L::splat(coefficients[N - 1]);
    for c in coefficients.iter().rev().skip(1) {
        sum = sum * x + L::splat(*c);
    }
    sum
}

/// The angle of (x, y) from the x axis, in (−π, π], as [`f64::atan2`] to two units in the last place; 0 at the origin. A y of −0 is 0.
#[inline(always)]
pub fn atan2<L: Lane>(y: L, x: L) -> L {
    let zero = L::splat(0.0);
    let (across, along) = (y.abs(), x.abs());
    let steep = across - along;
    let less = steep.where_positive(along, across);
    let more = steep.where_positive(across, along);
    // atan(less/more) from 0, from atan(1/2) or from π/4, with one division.
    let from_half = less - L::splat(FLAT) * more;
    let from_quarter = less - L::splat(STEEP) * more;
    let pick = |flat: f64, half: f64, quarter: f64| {
        let some = from_half.where_positive(L::splat(half), L::splat(flat));
        from_quarter.where_positive(L::splat(quarter), some)
    };
    let half = (L::splat(2.0) * less - more, L::splat(2.0) * more + less);
    let numerator = from_half.where_positive(half.0, less);
    let numerator = from_quarter.where_positive(less - more, numerator);
    let denominator = from_half.where_positive(half.1, more);
    let denominator = from_quarter.where_positive(less + more, denominator);
    let t = numerator / denominator.where_positive(denominator, L::splat(1.0));
    let t2 = t * t;
    let rest = t * t2 * series(&ATAN, t2) - pick(0.0, ATAN_HALF[1], QUARTER_LOW);
    let angle = pick(0.0, ATAN_HALF[0], FRAC_PI_4) - (rest - t);
    let upright = L::splat(FRAC_PI_2) - (angle - L::splat(2.0 * QUARTER_LOW));
    let angle = steep.where_positive(upright, angle);
    let behind = L::splat(PI) - (angle - L::splat(4.0 * QUARTER_LOW));
    let angle = (zero - x).where_positive(behind, angle);
    (zero - y).where_positive(zero - angle, angle)
}

/// The natural logarithm of normal positive numbers to one unit in the last place; of others, something finite.
#[inline(always)]
pub fn ln<L: Lane>(x: L) -> L {
    let (mantissa, exponent) = x.parts();
    let f = mantissa - L::splat(1.0);
    let s = f / (L::splat(2.0) + f);
    let s2 = s * s;
    let half = L::splat(0.5) * f * f;
    let rest = s * (half + s2 * series(&LOG, s2)) + exponent * L::splat(LN_2_LOW);
    exponent * L::splat(LN_2_HIGH) - ((half - rest) - f)
}

const _: () = assert!(LN_2_HIGH < LN_2);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{Body, Lanes, Width, dispatch_at};

    fn ulps_between(a: f64, b: f64) -> f64 {
        let unit = f64::EPSILON * b.abs().max(f64::MIN_POSITIVE);
        (a - b).abs() / unit
    }

    #[test]
    fn angles_are_those_of_the_library() {
        let mut worst: f64 = 0.0;
        for k in 0..200_000 {
            let direction = f64::from(k) * 3.2e-5 - 3.1999;
            let size = 10f64.powi(k % 40 - 20);
            let (y, x) = (size * direction.sin(), size * direction.cos());
            worst = worst.max(ulps_between(atan2(y, x), y.atan2(x)));
        }
        assert!(worst <= 2.0, "{worst} units in the last place");
        let flat = [(0.0, 0.0), (0.0, 1.0), (0.0, -1.0), (1e-300, 1.0)];
        let steep = [(1.0, 0.0), (-1.0, 0.0), (1.0, 1e-300)];
        for (y, x) in flat.into_iter().chain(steep) {
            assert_eq!(atan2(y, x), f64::atan2(y, x), "{y} {x}");
        }
    }

    #[test]
    fn logarithms_are_those_of_the_library() {
        let mut worst: f64 = 0.0;
        for k in 0..200_000 {
            let x = 1.000_37f64.powi(k - 100_000) * (1.0 + 1e-7 * f64::from(k % 1000));
            worst = worst.max(ulps_between(ln(x), x.ln()));
        }
        assert!(worst <= 1.0, "{worst} units in the last place");
        assert_eq!(ln(1.0), 0.0);
    }

    struct Elementwise<'a>(&'a [f64], &'a mut [f64]);

    impl Body for Elementwise<'_> {
        type Output = ();
        #[inline(always)]
        fn call<L: Lane>(self) {
            for (x, out) in self.0.chunks_exact(L::N).zip(self.1.chunks_exact_mut(L::N)) {
                let x = L::load(x);
                (ln(x) + atan2(x - L::splat(3.0), L::splat(1.5) - x)).store(out);
            }
        }
    }

    #[test]
    fn bits_do_not_hang_on_the_width() {
        let x: Vec<f64> = (1..=800).map(|k| 0.013 * f64::from(k)).collect();
        let alone: Vec<f64> = x.iter().map(|&x| ln(x) + atan2(x - 3.0, 1.5 - x)).collect();
        for width in [Width::Two, Width::Four, Width::Eight] {
            let mut together = vec![0.0; x.len()];
            dispatch_at(width, Elementwise(&x, &mut together));
            assert_eq!(together, alone, "{width:?}");
        }
        assert_eq!(<Lanes<2> as Lane>::N, 2);
    }
}
