//! Spectra of the sea, and phases from a seed.

use std::f64::consts::TAU;

use sph_core::SplitMix;

/// Frequencies, Hz, and amplitudes, m, of the waves of a growing sea: the multiples of `step` between `low` and `high`, so that it
/// repeats itself after 1/step. From its spectrum over frequency, S(f) in m² s,
///
///   S(f) = β f⁻⁵ exp(−5/4 (f_p/f)⁴) γ^exp(−(f − f_p)²/(2σ²f_p²)), σ = 0.07 for f ≤ f_p, 0.09 above,
///
/// with β such that 4 √(∫ S df) = 4 √(Σ ½ a²) is the significant height H_m0, m, the peak frequency f_p, Hz, and the peak
/// enhancement γ.
///
/// Source: Hasselmann et al. 1973 (JONSWAP); γ = 1 is Pierson & Moskowitz 1964.
pub(crate) fn jonswap(
    [height, peak, enhancement]: [f64; 3],
    step: f64,
    [low, high]: [f64; 2],
) -> Vec<[f64; 2]> {
    // S(f)/β.
    let shape = |f: f64| {
        let sigma = if f <= peak { 0.07 } else { 0.09 };
        let off = (f / peak - 1.0) / sigma;
        let sea = (-1.25 * (peak / f).powi(4)).exp() / (f / peak).powi(5);
        sea * enhancement.powf((-0.5 * off * off).exp())
    };
    let first = (low / step).ceil().max(1.0) as usize;
    let last = (high / step).floor() as usize;
    let frequency = |n: usize| n as f64 * step;
    let all = || (first..=last).map(|n| shape(frequency(n)));
    let whole: f64 = all().sum();
    let part = |(n, s): (usize, f64)| {
        let energy = s / whole * height * height / 16.0;
        [frequency(n), (2.0 * energy).sqrt()]
    };
    (first..=last).zip(all()).map(part).collect()
}

/// Phases between 0 and 2π, the same for the same seed on every machine.
pub(crate) fn phases(seed: u64) -> impl Iterator<Item = f64> {
    let mut random = SplitMix(seed);
    std::iter::repeat_with(move || TAU * random.unit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_have_the_height_and_the_peak_of_the_sea() {
        let all = jonswap([0.1, 0.7, 3.3], 0.02, [0.35, 2.1]);
        let energy: f64 = all.iter().map(|[_, a]| 0.5 * a * a).sum();
        assert!((4.0 * energy.sqrt() / 0.1 - 1.0).abs() < 1e-12);
        let peak = all.iter().max_by(|a, b| a[1].total_cmp(&b[1]));
        let peak = peak.expect("one");
        assert!((peak[0] - 0.7).abs() < 1e-12, "{peak:?}");
    }

    /// Without enhancement ∫ S df = β f_p⁻⁴/5 (closed form), and the share above 2 f_p is 1 − exp(−5/64).
    #[test]
    fn a_sea_without_enhancement_is_that_of_pierson_and_moskowitz() {
        let all = jonswap([0.1, 0.7, 1.0], 0.001, [0.1, 40.0]);
        let energy = |from: f64| -> f64 {
            let above = all.iter().filter(|[f, _]| *f > from);
            above.map(|[_, a]| 0.5 * a * a).sum()
        };
        let share = energy(1.4) / energy(0.0);
        let exact = 1.0 - (-1.25_f64 / 16.0).exp();
        assert!((share / exact - 1.0).abs() < 5e-3, "{share} {exact}");
    }

    /// The published first value of the generator with seed 1234567.
    #[test]
    fn phases_are_those_of_the_published_generator() {
        let first = phases(1_234_567).next().expect("one");
        let published = 6_457_827_717_110_365_317_u64;
        let exact = (published >> 11) as f64 / (1_u64 << 53) as f64 * TAU;
        assert!((first - exact).abs() < 1e-15, "{first} {exact}");
    }
}
