//! Every lane has the bits of `f64`, at every width.

use sph_kernels::lanes::{
    Body, Lane, Lanes, MOST, Width, add_scaled, dispatch, dispatch_at, dot, width,
};

/// Numbers of all sizes and signs, from a fixed start.
fn numbers(n: usize) -> Vec<f64> {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    };
    (0..n).map(|_| next() * (40.0 * next()).exp()).collect()
}

/// A formula with every operation there is.
#[inline(always)]
fn formula<L: Lane>(a: L, b: L, c: L) -> L {
    let quotient = (a * b - c) / (b + c);
    let root = (a * a + b.abs() * b.abs()).sqrt().max(c);
    let mut sum = [quotient, -root, a];
    add_scaled(&mut sum, &[a, b, c], root);
    sum[0] -= quotient;
    sum[1] += root.where_positive(quotient, a);
    c.where_positive(dot(&sum, &[b, c, a]), sum[1])
}

struct All<'a>([&'a [f64]; 3]);

impl Body for All<'_> {
    type Output = (usize, Vec<u64>);
    #[inline(always)]
    fn call<L: Lane>(self) -> Self::Output {
        let [a, b, c] = self.0;
        let mut out = vec![0.0; a.len()];
        for k in (0..a.len()).step_by(L::N) {
            let value = formula(L::load(&a[k..]), L::load(&b[k..]), L::load(&c[k..]));
            value.store(&mut out[k..]);
        }
        (L::N, out.into_iter().map(f64::to_bits).collect())
    }
}

#[test]
fn every_width_has_the_bits_of_single_numbers() {
    let all = numbers(3 * 8 * 500);
    let [a, b, c] = [0, 1, 2].map(|k| &all[k * 4000..(k + 1) * 4000]);
    let single: Vec<u64> = (0..a.len())
        .map(|k| formula(a[k], b[k], c[k]).to_bits())
        .collect();
    for asked in [Width::Two, Width::Four, Width::Eight] {
        let (lanes, bits) = dispatch_at(asked, All([a, b, c]));
        assert!(lanes <= asked.lanes() && lanes <= MOST);
        assert!(bits == single, "{lanes} lanes differ");
    }
    assert_eq!(dispatch(All([a, b, c])).0, width().lanes());
}

#[test]
fn nan_is_neither_less_nor_positive() {
    let mut x = Lanes::<4>::splat(1.0);
    x.set(2, f64::NAN);
    let chosen = x.where_positive(Lanes::splat(5.0), Lanes::splat(7.0));
    let chosen: Vec<f64> = (0..4).map(|lane| chosen.at(lane)).collect();
    assert_eq!(chosen, [5.0, 5.0, 7.0, 5.0]);
    assert!(!Lanes::<2>::splat(f64::NAN).any_less(Lanes::splat(1.0)));
    assert!(x.any_less(Lanes::splat(2.0)));
}
