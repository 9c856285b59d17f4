//! Separation of incoming and reflected waves by gauges.

/// A complex amplitude A of Re(A e^{iωt}), m: real and imaginary part.
pub type Amplitude = [f64; 2];

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

fn times(a: Amplitude, b: Amplitude) -> Amplitude {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn conjugate(a: Amplitude) -> Amplitude {
    [a[0], -a[1]]
}

fn turned(angle: f64) -> Amplitude {
    let (sine, cosine) = angle.sin_cos();
    [cosine, sine]
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
    let (mut s, mut plus, mut minus) = ([0.0; 2], [0.0; 2], [0.0; 2]);
    let add = |sum: &mut Amplitude, x: Amplitude| {
        sum[0] += x[0];
        sum[1] += x[1];
    };
    for (x, level) in gauges {
        add(&mut s, turned((there + back) * x));
        add(&mut plus, times(*level, turned(there * x)));
        add(&mut minus, times(*level, turned(-back * x)));
    }
    let determinant = n * n - s[0] * s[0] - s[1] * s[1];
    let clear = determinant / (n * n);
    if gauges.len() < 2 || clear < 1e-9 {
        return None;
    }
    let solved = |own: Amplitude, s: Amplitude, other: Amplitude| {
        let mixed = times(s, other);
        [0, 1].map(|c| (n * own[c] - mixed[c]) / determinant)
    };
    Some(Separated {
        incident: solved(plus, s, minus),
        reflected: solved(minus, conjugate(s), plus),
        clear,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLACES: [f64; 3] = [3.1, 3.4, 3.87];

    fn signal([k, l]: [f64; 2], x: f64, incident: Amplitude, reflected: Amplitude) -> Amplitude {
        let there = times(incident, turned(-k * x));
        let back = times(reflected, turned(l * x));
        [there[0] + back[0], there[1] + back[1]]
    }

    #[test]
    fn two_waves_are_found_to_rounding() {
        // As on a current: a wave that comes back against it is shorter.
        let (k, incident, reflected) = ([2.4, 3.1], [0.03, -0.01], [0.001, 0.002]);
        let gauges = PLACES.map(|x| (x, signal(k, x, incident, reflected)));
        let found = separated(k, &gauges).expect("a solution");
        for c in 0..2 {
            assert!((found.incident[c] - incident[c]).abs() < 1e-15, "{found:?}");
            let error = (found.reflected[c] - reflected[c]).abs();
            assert!(error < 1e-15, "{found:?}");
        }
    }

    /// Least squares: a change of either amplitude makes the sum of squares larger.
    #[test]
    fn of_signals_with_errors_it_is_the_least() {
        let k = [1.9; 2];
        let errors = [[1e-3, -2e-3], [-5e-4, 1e-3], [2e-3, 5e-4]];
        let gauges: Vec<(f64, Amplitude)> = (0..3)
            .map(|j| {
                let clean = signal(k, PLACES[j], [0.02, 0.01], [0.004, -0.001]);
                (
                    PLACES[j],
                    [clean[0] + errors[j][0], clean[1] + errors[j][1]],
                )
            })
            .collect();
        let found = separated(k, &gauges).expect("a solution");
        let squares = |a: Amplitude, b: Amplitude| -> f64 {
            let one = |(x, level): &(f64, Amplitude)| {
                let fit = signal(k, *x, a, b);
                (fit[0] - level[0]).powi(2) + (fit[1] - level[1]).powi(2)
            };
            gauges.iter().map(one).sum()
        };
        let least = squares(found.incident, found.reflected);
        for [da, db, dc, dd] in [
            [1e-5, 0.0, 0.0, 0.0],
            [0.0, -1e-5, 0.0, 0.0],
            [0.0, 0.0, 1e-5, 0.0],
            [-1e-5, 1e-5, 1e-5, -1e-5],
        ] {
            let a = [found.incident[0] + da, found.incident[1] + db];
            let b = [found.reflected[0] + dc, found.reflected[1] + dd];
            assert!(squares(a, b) > least);
        }
    }

    #[test]
    fn gauges_half_a_wave_apart_tell_nothing() {
        let k = [std::f64::consts::PI; 2];
        let gauges = [0.0, 1.0, 2.0].map(|x| (x, [1.0, 0.0]));
        assert_eq!(separated(k, &gauges), None);
    }
}
