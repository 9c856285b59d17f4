//! The order of insertion: rounds of growing size, each along a Hilbert curve.
//!
//! Rounds keep the expected cost at O(n log n) for any input; the curve keeps successive spheres close,
//! so that walks are short and memory is near. Sources: Amenta, Choi & Rote 2003 (biased randomised
//! insertion order); Skilling 2004 (Hilbert curve).

use sph_core::{SplitMix, bounds};

use crate::triangulation::Sphere;

/// Spheres in the order of insertion.
pub fn insertion_order(spheres: &[Sphere]) -> Vec<u32> {
    let [low, high] = bounds(spheres.iter().map(|s| s.centre.into()));
    let size = (0..3).map(|k| high[k] - low[k]);
    let size = size.fold(f64::MIN_POSITIVE, f64::max);
    // A round of about 32 begins; each is twice the one before.
    let rounds = (spheres.len() / 32).max(1).ilog2();
    let key = |(i, s): (usize, &Sphere)| {
        let cells = f64::from(1_u32 << BITS);
        let at = |k: usize| (((s.centre[k] - low[k]) / size) * cells).min(cells - 1.0) as u32;
        // A number's bits in disorder.
        let mixed = SplitMix((i as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15)).next();
        let round = rounds - mixed.trailing_zeros().min(rounds);
        (round, hilbert([at(0), at(1), at(2)]), i as u32)
    };
    let mut keys: Vec<_> = spheres.iter().enumerate().map(key).collect();
    keys.sort_unstable();
    keys.into_iter().map(|(_, _, i)| i).collect()
}

/// Bits of a coordinate on the curve.
const BITS: u32 = 20;

/// Place on the Hilbert curve of a cell of a grid of 2^BITS cells a side.
fn hilbert(mut x: [u32; 3]) -> u64 {
    let mut q = 1 << (BITS - 1);
    while q > 1 {
        let p = q - 1;
        for k in 0..3 {
            if x[k] & q != 0 {
                x[0] ^= p;
            } else {
                let t = (x[0] ^ x[k]) & p;
                x[0] ^= t;
                x[k] ^= t;
            }
        }
        q >>= 1;
    }
    x[1] ^= x[0];
    x[2] ^= x[1];
    let (mut t, mut q) = (0, 1 << (BITS - 1));
    while q > 1 {
        if x[2] & q != 0 {
            t ^= q - 1;
        }
        q >>= 1;
    }
    let bit = |v: u32, b: u32| u64::from(v >> b & 1);
    (0..BITS).rev().fold(0, |h, b| {
        let digit = bit(x[0] ^ t, b) << 2 | bit(x[1] ^ t, b) << 1 | bit(x[2] ^ t, b);
        h << 3 | digit
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Neighbours on the curve are neighbours in space: it never jumps.
    #[test]
    fn the_curve_visits_every_cell_by_steps_of_one() {
        let side = 8;
        let shift = BITS - 3;
        let mut cells = Vec::new();
        for i in 0..side * side * side {
            let x = [i % side, i / side % side, i / side / side];
            cells.push((hilbert(x.map(|c| c << shift)) >> (3 * shift), x));
        }
        cells.sort_unstable();
        for (n, pair) in cells.windows(2).enumerate() {
            assert_eq!(pair[0].0, n as u64);
            let step: u32 = (0..3).map(|k| pair[0].1[k].abs_diff(pair[1].1[k])).sum();
            assert_eq!(step, 1, "from {:?} to {:?}", pair[0].1, pair[1].1);
        }
    }

    #[test]
    fn every_sphere_is_inserted_once() {
        let sphere = |i| Sphere::new([f64::from(i), 0.0, 0.0], 0.1);
        let spheres: Vec<_> = (0..1000).map(sphere).collect();
        let mut order = insertion_order(&spheres);
        assert_ne!(order, (0..1000).collect::<Vec<_>>());
        order.sort_unstable();
        assert_eq!(order, (0..1000).collect::<Vec<_>>());
    }
}
