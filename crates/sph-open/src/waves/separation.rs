//! Separation of incoming and reflected waves by gauges.

use nalgebra::Complex;

/// A complex amplitude A of Re(A e^{iωt}), m.
pub type Amplitude = Complex<f64>;

/// The two waves of a frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Separated {
    /// At x = 0, of the wave A e^{i(ωt − kx)} that runs to larger x.
    pub incident: Amplitude,
    /// At x = 0, of the wave A e^{i(ωt + k'x)} that comes back.
    pub reflected: Amplitude,
    /// 1 − |Σ e^{i(k + k')x}|²/n² of the places: 0 where they cannot separate the two waves (two gauges half a wave
    /// apart).
    pub clear: f64,
}

/// Separates the waves of a frequency by least squares: the two amplitudes for which
///
///   Σ_j |A e^{−ikx_j} + B e^{ik'x_j} − η_j|²
///
/// is least, from the amplitudes η_j that gauges at x_j measure and the wavenumbers k there and k' back, which differ where
/// there is a current. With s = Σ e^{i(k + k')x_j} the normal equations are n A + s B = Σ η_j e^{ikx_j} and
/// s* A + n B = Σ η_j e^{−ik'x_j}. None where they have no solution.
///
/// Source: Mansard & Funke 1980 (three gauges); any number as in Zelt & Skjelbreia 1992 with equal weights.
pub fn separated([there, back]: [f64; 2], gauges: &[(f64, Amplitude)]) -> Option<Separated> {
    let n = gauges.len() as f64;
    let [mut s, mut plus, mut minus] = [Complex::ZERO; 3];
    for (x, level) in gauges {
        s += Complex::cis((there + back) * x);
        plus += level * Complex::cis(there * x);
        minus += level * Complex::cis(-back * x);
    }
    let determinant = n * n - s.re * s.re - s.im * s.im;
    let clear = determinant / (n * n);
    if gauges.len() < 2 || clear < 1e-9 {
        return None;
    }
    Some(Separated {
        incident: (plus * n - s * minus) / determinant,
        reflected: (minus * n - s.conj() * plus) / determinant,
        clear,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLACES: [f64; 3] = [3.1, 3.4, 3.87];

    fn signal([k, l]: [f64; 2], x: f64, incident: Amplitude, reflected: Amplitude) -> Amplitude {
        incident * Complex::cis(-k * x) + reflected * Complex::cis(l * x)
    }

    #[test]
    fn two_waves_are_found_to_rounding() {
        // As on a current: a wave that comes back against it is shorter.
        let (incident, reflected) = (Complex::new(0.03, -0.01), Complex::new(0.001, 0.002));
        let k = [2.4, 3.1];
        let gauges = PLACES.map(|x| (x, signal(k, x, incident, reflected)));
        let found = separated(k, &gauges).expect("a solution");
        for error in [found.incident - incident, found.reflected - reflected] {
            assert!(
                error.re.abs() < 1e-15 && error.im.abs() < 1e-15,
                "{found:?}"
            );
        }
    }

    /// Least squares: a change of either amplitude makes the sum of squares larger.
    #[test]
    fn of_signals_with_errors_it_is_the_least() {
        let k = [1.9; 2];
        let errors = [[1e-3, -2e-3], [-5e-4, 1e-3], [2e-3, 5e-4]];
        let (there, back) = (Complex::new(0.02, 0.01), Complex::new(0.004, -0.001));
        let gauges: Vec<(f64, Amplitude)> = (PLACES.iter().zip(errors))
            .map(|(x, [re, im])| (*x, signal(k, *x, there, back) + Complex::new(re, im)))
            .collect();
        let found = separated(k, &gauges).expect("a solution");
        let squares = |a: Amplitude, b: Amplitude| -> f64 {
            let one = |(x, level): &(f64, Amplitude)| (signal(k, *x, a, b) - level).norm_sqr();
            gauges.iter().map(one).sum()
        };
        let least = squares(found.incident, found.reflected);
        for [da, db, dc, dd] in [
            [1e-5, 0.0, 0.0, 0.0],
            [0.0, -1e-5, 0.0, 0.0],
            [0.0, 0.0, 1e-5, 0.0],
            [-1e-5, 1e-5, 1e-5, -1e-5],
        ] {
            let (a, b) = (Complex::new(da, db), Complex::new(dc, dd));
            assert!(squares(found.incident + a, found.reflected + b) > least);
        }
    }

    #[test]
    fn gauges_half_a_wave_apart_tell_nothing() {
        let k = [std::f64::consts::PI; 2];
        let gauges = [0.0, 1.0, 2.0].map(|x| (x, Complex::ONE));
        assert_eq!(separated(k, &gauges), None);
    }
}
