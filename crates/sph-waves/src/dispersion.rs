//! How long a wave of a period is.

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

#[cfg(test)]
mod tests {
    use super::*;

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
