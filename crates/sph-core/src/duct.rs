//! Developed flow in a rectangular duct: inlets impose it, and references are compared with it.

use std::f64::consts::{FRAC_PI_2, PI};

/// Terms of the series; they fall as 1/n³ and change their signs, and 80 leave out 10⁻⁷ of the whole.
const TERMS: usize = 80;

/// φ(y, z), m², of the developed laminar flow u = G φ/η in a rectangular duct, with G the fall of the pressure per length and
/// η the viscosity; 0 on its walls and beyond.
///
/// `from_middle` are y and z from the axis, m, `half` half the sides a and b, m:
///
///   φ = 16 a²/π³ Σ_n (−1)^((n−1)/2) [1 − cosh(nπz/2a)/cosh(nπb/2a)] cos(nπy/2a)/n³,   n = 1, 3, 5, …
///
/// Source: White 2006, Viscous Fluid Flow, Eq. 3-48.
pub fn rectangular_duct(from_middle: [f64; 2], half: [f64; 2]) -> f64 {
    let [mut y, mut z] = from_middle.map(f64::abs);
    let [mut a, mut b] = half;
    if y >= a || z >= b {
        return 0.0;
    }
    // Along the shorter side the series converges faster.
    if a > b {
        (y, z, a, b) = (z, y, b, a);
    }
    let term = |k: usize| {
        let n = (2 * k + 1) as f64;
        let (x, wall) = (n * FRAC_PI_2 * z / a, n * FRAC_PI_2 * b / a);
        // cosh x / cosh X without numbers that are too large.
        let fallen = ((x - wall).exp() + (-x - wall).exp()) / (1.0 + (-2.0 * wall).exp());
        let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        sign * (1.0 - fallen) * (n * FRAC_PI_2 * y / a).cos() / n.powi(3)
    };
    16.0 * a * a / PI.powi(3) * (0..TERMS).rev().map(term).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// White 2006, Table 3-1 and Eq. 3-48: in a square of the side 2a the flow is 0.5623 a⁴ G/η, and u in the middle 0.29469 a² G/η.
    #[test]
    fn a_square_has_its_known_discharge() {
        let middle = rectangular_duct([0.0; 2], [1.0; 2]);
        assert!((middle - 0.294_685).abs() < 1e-5, "{middle}");
        let n = 200;
        let at = |i: usize| (2.0 * i as f64 + 1.0) / n as f64 - 1.0;
        let all = (0..n * n).map(|k| rectangular_duct([at(k / n), at(k % n)], [1.0; 2]));
        let discharge = all.sum::<f64>() * (2.0 / n as f64).powi(2);
        assert!((discharge - 0.562_31).abs() < 1e-4, "{discharge}");
    }

    #[test]
    fn its_laplacian_is_minus_one_and_its_walls_are_at_rest() {
        let half = [0.7, 0.3];
        let at = |y: f64, z: f64| rectangular_duct([y, z], half);
        let (y, z, h) = (0.4, -0.11, 1e-2);
        let around = at(y + h, z) + at(y - h, z) + at(y, z + h) + at(y, z - h);
        let laplacian = (around - 4.0 * at(y, z)) / (h * h);
        assert!((laplacian + 1.0).abs() < 1e-2, "{laplacian}");
        assert!(at(0.699_999_9, 0.1) < 1e-6 && at(0.1, 0.299_999_9) < 1e-6);
        assert_eq!(at(0.8, 0.0), 0.0);
    }

    #[test]
    fn a_wide_duct_is_a_channel_between_plates() {
        let channel = |z: f64| 0.5 * (1.0 - z * z);
        for z in [0.0, 0.3, 0.9] {
            let wide = rectangular_duct([0.0, z], [50.0, 1.0]);
            assert!((wide - channel(z)).abs() < 1e-6, "{wide}");
        }
    }
}
