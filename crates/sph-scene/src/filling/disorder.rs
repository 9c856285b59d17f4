//! Random displacement and velocity of particles, the same on every machine.

use sph_core::SplitMix;

use crate::filling::fill::BodyParticles;
use crate::geometry::periodic_place::wrapped;

/// Displaces every particle along each axis by at most `fraction` of the spacing, at random.
///
/// The same seed gives the same displacements. A particle that leaves a periodic box enters it on the other side.
pub fn disturb<const D: usize>(
    bodies: &mut [BodyParticles<D>],
    spacing: f64,
    fraction: f64,
    seed: u64,
    periodic: &[Option<[f64; 2]>; D],
) {
    if fraction == 0.0 {
        return;
    }
    let mut random = SplitMix(seed);
    for x in bodies.iter_mut().flat_map(|b| b.positions.iter_mut()) {
        let moved = x.map(|c| c + fraction * spacing * (2.0 * random.unit() - 1.0));
        *x = wrapped(&moved, periodic);
    }
}

/// A random velocity, along each axis at most `amplitude`, that depends on the particle's number and the seed alone.
pub fn noise<const D: usize>(particle: u32, amplitude: f64, seed: u64) -> [f64; D] {
    // The numbers of a seed that displacements do not use.
    let mut random = SplitMix(SplitMix(!seed).next() ^ u64::from(particle));
    std::array::from_fn(|_| amplitude * (2.0 * random.unit() - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_repeats_is_bounded_and_has_no_mean() {
        let all: Vec<[f64; 2]> = (0..10_000).map(|i| noise(i, 0.1, 3)).collect();
        assert_eq!(all[7], noise(7, 0.1, 3));
        assert_ne!(all[7], noise(7, 0.1, 4));
        for axis in 0..2 {
            let mean = all.iter().map(|u| u[axis]).sum::<f64>() / 1e4;
            let square = all.iter().map(|u| u[axis].powi(2)).sum::<f64>() / 1e4;
            assert!(all.iter().all(|u| u[axis].abs() <= 0.1));
            // Five standard errors, 0.1/√3/100 of the mean; a third of the square.
            assert!(mean.abs() < 5.0 * 0.1 / 3f64.sqrt() / 100.0, "{mean}");
            assert!((square / (0.01 / 3.0) - 1.0).abs() < 0.05, "{square}");
        }
    }

    #[test]
    fn displacements_repeat_and_stay_within_the_fraction() {
        let start = || {
            vec![BodyParticles {
                body: 0,
                positions: vec![[0.5, 0.5]; 100],
            }]
        };
        let (mut a, mut b) = (start(), start());
        disturb(&mut a, 0.1, 0.2, 7, &[None; 2]);
        disturb(&mut b, 0.1, 0.2, 7, &[None; 2]);
        assert_eq!(a, b);
        let near = |x: &[f64; 2]| x.iter().all(|c| (c - 0.5).abs() <= 0.02);
        assert!(a[0].positions.iter().all(near));
        assert_ne!(a[0].positions[0], a[0].positions[1]);
    }
}
