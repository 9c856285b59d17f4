//! Length of a wave of a period.

/// The wavenumber k > 0 of ω² = g k tanh(k d), 1/m, from ω in rad/s, d in m and g in m/s².
///
/// Newton's method for x = k d in x tanh x = ω² d/g, from the estimate of Eckart, x = y/√(tanh y); to rounding within a few
/// steps for all depths.
///
/// Source: Airy 1845; Eckart 1952 (estimate).
pub fn wavenumber(omega: f64, depth: f64, gravity: f64) -> f64 {
    let y = omega * omega * depth / gravity;
    let mut x = y / y.tanh().sqrt();
    for _ in 0..8 {
        let t = x.tanh();
        x -= (x * t - y) / (t + x * (1.0 - t * t));
    }
    x / depth
}

/// The wavenumber k > 0 of ω = √(g k tanh k d) + k U, 1/m: waves that run along with a uniform current U, m/s, or against it
/// (U < 0). None where the current takes them along: then no wave of this frequency runs against it.
///
/// Against a current the frequency rises with k up to where the waves' energy stands still, c_g = −U; of the two waves below
/// that the longer is meant, which comes from still water.
///
/// Source: Peregrine 1976.
pub fn wavenumber_on(omega: f64, depth: f64, gravity: f64, current: f64) -> Option<f64> {
    if current == 0.0 {
        return Some(wavenumber(omega, depth, gravity));
    }
    if !current.is_finite() {
        return None;
    }
    let frequency = |k: f64| (gravity * k * (k * depth).tanh()).sqrt() + k * current;
    let speed = |k: f64| {
        let x = k * depth;
        let within = (gravity * x.tanh() / k).sqrt();
        0.5 * within * (1.0 + 2.0 * x / (2.0 * x).sinh()) + current
    };
    // With a current waves are longer than at rest; against it they are shorter, and stop where their energy does.
    let mut high = wavenumber(omega, depth, gravity);
    if current < 0.0 {
        if speed(1e-6 / depth) <= 0.0 {
            return None;
        }
        while speed(high) > 0.0 {
            high *= 2.0;
        }
        high = halved([1e-6 / depth, high], |k| speed(k) < 0.0);
        if frequency(high) < omega {
            return None;
        }
    }
    Some(halved([0.0, high], |k| frequency(k) > omega))
}

/// Boundary between two numbers from which a condition holds, to rounding.
fn halved([mut low, mut high]: [f64; 2], holds: impl Fn(f64) -> bool) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        match holds(middle) {
            true => high = middle,
            false => low = middle,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn waves_on_a_current_have_its_frequency_and_stop_where_it_is_too_fast() {
        let (depth, gravity, omega) = (0.5, 9.81, 5.236);
        for current in [-0.3, -0.1, 0.1, 0.5, 2.0] {
            let k = wavenumber_on(omega, depth, gravity, current).expect("a wave");
            let back = (gravity * k * (k * depth).tanh()).sqrt() + k * current;
            assert!((back / omega - 1.0).abs() < 1e-12, "{current}: {k}");
            let still = wavenumber(omega, depth, gravity);
            assert_eq!(k > still, current < 0.0, "{current}: {k} {still}");
        }
        // In deep water waves stop at a quarter of the speed that they have at rest, g/ω.
        let stops = -0.25 * gravity / 12.0;
        assert!(wavenumber_on(12.0, 5.0, gravity, 0.999 * stops).is_some());
        assert_eq!(wavenumber_on(12.0, 5.0, gravity, 1.001 * stops), None);
        assert_eq!(wavenumber_on(omega, depth, gravity, -2.3), None);
        assert_eq!(wavenumber_on(omega, depth, gravity, f64::NAN), None);
    }

    #[test]
    fn short_medium_and_long_waves_disperse() {
        let (depth, gravity) = (0.7, 9.81);
        for omega in [0.01, 0.3, 2.0, 5.0, 12.0, 60.0] {
            let k = wavenumber(omega, depth, gravity);
            let back = gravity * k * (k * depth).tanh();
            assert!((back / (omega * omega) - 1.0).abs() < 1e-13, "{omega}: {k}");
        }
    }
}
