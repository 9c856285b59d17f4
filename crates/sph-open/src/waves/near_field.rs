//! Waves that stay at a paddle.

use crate::waves::Paddle;

/// Waves of the near field that are summed; they fall as 1/j³.
const TERMS: usize = 64;

impl Paddle {
    /// Elevation at the paddle of the waves that stay there, over the displacement at the still level, E.
    ///
    ///   E = Σ_j C_j sin k_j d,   C_j = 4 k_j ∫ f cos k_j(z + d) dz/(2 k_j d + sin 2 k_j d),   ω² = −g k_j tan k_j d
    ///
    /// with f as in [`transfer`](Self::transfer). It is in phase with the displacement; the wave that leaves is in phase with the
    /// velocity.
    ///
    /// Source: Biesel 1951; Dean & Dalrymple 1991, Eq. 6.19–6.23.
    pub fn near_field(self, frequency: f64, depth: f64, gravity: f64) -> f64 {
        let y = frequency * frequency * depth / gravity;
        let term = |j: usize| {
            let x = root(j, y);
            let moved = match self {
                Paddle::Piston => x.sin(),
                Paddle::Flap(hinge) => {
                    let arm = (depth - hinge) / depth;
                    let low = x * (1.0 - arm).max(0.0);
                    // A hinge below the floor: the motion of the flap there does not count.
                    x.sin() + (x.cos() - low.cos()) / (x * arm)
                }
            };
            4.0 * moved * x.sin() / (2.0 * x + (2.0 * x).sin())
        };
        // From the smallest on.
        (1..=TERMS).rev().map(term).sum()
    }
}

/// The j-th root x = k d of x tan x = −y, between (j − ½)π and jπ.
fn root(j: usize, y: f64) -> f64 {
    let top = j as f64 * std::f64::consts::PI;
    // x = jπ − atan(y/x) contracts: its slope is y/(x² + y²), below 1/π.
    (0..60).fold(top, |x, _| top - (y / x).atan())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_roots_and_a_piston_is_a_flap_hinged_far_below() {
        for y in [0.01, 1.0, 30.0] {
            for j in [1, 2, 7] {
                let x = root(j, y);
                assert!((x * x.sin() + y * x.cos()).abs() < 1e-9, "{j} {y}: {x}");
            }
        }
        let piston = Paddle::Piston.near_field(5.0, 0.5, 9.81);
        let flap = Paddle::Flap(-1e7).near_field(5.0, 0.5, 9.81);
        assert!((piston - flap).abs() < 1e-6, "{piston} {flap}");
    }

    /// f is the sum of all its waves, of which cosh k(z + d) is the first: at the still level
    /// 1 = C₀ cosh kd + Σ C_j cos k_j d. The elevation is that sum with −ω²/(g k_j) for tan, so that it follows from the same C_j.
    #[test]
    fn the_waves_of_a_piston_add_up_to_it() {
        let (omega, depth, gravity) = (4.0_f64, 0.6, 9.81);
        let y = omega * omega * depth / gravity;
        let kd = depth * crate::waves::wavenumber(omega, depth, gravity);
        let first = 4.0 * kd.sinh() * kd.cosh() / (2.0 * kd + (2.0 * kd).sinh());
        let rest: f64 = (1..4000)
            .map(|j| root(j, y))
            .map(|x| 4.0 * x.sin() * x.cos() / (2.0 * x + (2.0 * x).sin()))
            .sum();
        // The rest falls as 1/j².
        assert!((first + rest - 1.0).abs() < 1e-3, "{first} {rest}");
        assert!(Paddle::Piston.near_field(omega, depth, gravity) > 0.0);
    }
}
