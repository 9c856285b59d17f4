//! Rates of transport along a bed.

use super::grains::Grains;

/// 8 (θ − θ_c)^(3/2). Source: Meyer-Peter and Müller 1948.
#[must_use]
pub(super) fn meyer_peter_muller(shields: f64, critical: f64) -> f64 {
    8.0 * (shields - critical).max(0.0).powf(1.5)
}

/// 3.97 (θ − θ_c)^(3/2). Source: Wong and Parker 2006, Eq. 24.
#[must_use]
pub(super) fn wong_parker(shields: f64, critical: f64) -> f64 {
    3.97 * (shields - critical).max(0.0).powf(1.5)
}

/// 5 p (√θ − 0.7 √θ_c) with the share p = (1 + (π μ/(6 (θ − θ_c)))⁴)^(−1/4) of the grains at the surface that move, and the
/// coefficient of friction μ = 0.51. Source: Engelund and Fredsøe 1976; Fredsøe and Deigaard 1992, Eq. 7.59.
#[must_use]
pub(super) fn engelund_fredsoe(shields: f64, critical: f64) -> f64 {
    const FRICTION: f64 = 0.51;
    let excess = shields - critical;
    if excess <= 0.0 {
        return 0.0;
    }
    let held = std::f64::consts::PI * FRICTION / (6.0 * excess);
    let moving = (1.0 + held.powi(4)).powf(-0.25);
    5.0 * moving * (shields.sqrt() - 0.7 * critical.sqrt())
}

/// 0.053 T^2.1/D*^0.3 with T = (θ − θ_c)/θ_c,flat. Source: van Rijn 1984, Part I, Eq. 22; the division by θ_c,flat on slopes is
/// ours, because θ_c vanishes at the angle of repose.
#[must_use]
pub(super) fn van_rijn(shields: f64, critical: f64, grains: &Grains) -> f64 {
    let excess = (shields - critical).max(0.0) / grains.critical_shields();
    0.053 * excess.powf(2.1) / grains.dimensionless_diameter().powf(0.3)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAND: Grains = Grains {
        diameter: 1e-3,
        relative_density: 2.65,
        viscosity: 1e-6,
        gravity: 9.81,
    };

    #[test]
    fn nothing_moves_up_to_the_threshold() {
        for theta in [0.0, 0.02, 0.047] {
            assert_eq!(meyer_peter_muller(theta, 0.047), 0.0);
            assert_eq!(wong_parker(theta, 0.047), 0.0);
            assert_eq!(engelund_fredsoe(theta, 0.047), 0.0);
            assert_eq!(van_rijn(theta, 0.047, &SAND), 0.0);
        }
    }

    /// At θ = 0.247, θ_c = 0.047: 8 · 0.2^1.5 = 0.7155 and 3.97 · 0.2^1.5 = 0.3551; p of Engelund and Fredsøe is
    /// (1 + 1.3352⁴)^(−1/4) = 0.6999; D* = 25.30 of van Rijn.
    #[test]
    fn rates_are_those_of_the_sources() {
        let (theta, critical) = (0.247, 0.047);
        assert!((meyer_peter_muller(theta, critical) - 0.715_542).abs() < 1e-6);
        assert!((wong_parker(theta, critical) - 0.355_088).abs() < 1e-6);
        let p = (1.0 + 1.335_177_f64.powi(4)).powf(-0.25);
        let exact = 5.0 * p * (0.247_f64.sqrt() - 0.7 * 0.047_f64.sqrt());
        assert!((engelund_fredsoe(theta, critical) - exact).abs() < 1e-6);
        let diameter = SAND.dimensionless_diameter();
        let exact = 0.053 * (0.2 / SAND.critical_shields()).powf(2.1) / diameter.powf(0.3);
        assert!((van_rijn(theta, critical, &SAND) - exact).abs() < 1e-12);
        // All grains of the surface move in a strong flow.
        let strong = engelund_fredsoe(100.0, critical);
        assert!((strong / (5.0 * (10.0 - 0.7 * critical.sqrt())) - 1.0).abs() < 1e-6);
    }
}
