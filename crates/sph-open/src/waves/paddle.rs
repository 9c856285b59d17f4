//! The shape of a paddle, the waves that it makes, and those that stay at it.

use sph_core::parameters;

/// Waves of the near field that are summed; they fall as 1/j³.
const TERMS: usize = 64;

/// The shape of a paddle.
#[parameters]
#[derive(PartialEq)]
pub enum Paddle {
    /// It slides: the same way at all heights.
    #[default]
    Piston,
    /// It turns about a hinge at this height above the floor, m; below the floor if negative.
    Flap(f64),
}

impl Paddle {
    /// Height of a wave over the stroke of the paddle at the still level, H/S, by linear theory far from the paddle.
    ///
    ///   H/S = 4 sinh kd/(sinh 2kd + 2kd) · k ∫ f(z) cosh k(z + d) dz
    ///
    /// with f the motion at a height over that at the still level, from the floor or the hinge to it: 1 for a piston,
    /// 1 + z/l for a flap with its hinge l below the level,
    ///
    ///   k ∫ f cosh = sinh kd − [cosh kd − cosh k(d − l)⁺]/(k l).
    ///
    /// For a piston H/S = 2 (cosh 2kd − 1)/(sinh 2kd + 2kd).
    ///
    /// Source: Biesel 1951; Dean & Dalrymple 1991, Eq. 6.24–6.26.
    pub fn transfer(self, wavenumber: f64, depth: f64) -> f64 {
        let kd = wavenumber * depth;
        // Over e^kd, so that short waves do not overflow.
        let (less, twice) = ((-2.0 * kd).exp(), (-4.0 * kd).exp());
        let (sinh, cosh) = (0.5 * (1.0 - less), 0.5 * (1.0 + less));
        let moved = match self {
            Paddle::Piston => sinh,
            Paddle::Flap(hinge) => {
                let arm = depth - hinge;
                let low = wavenumber * (depth - arm).max(0.0);
                let at_hinge = 0.5 * ((low - kd).exp() + (-low - kd).exp());
                sinh - (cosh - at_hinge) / (wavenumber * arm)
            }
        };
        let whole = 0.5 * (1.0 - twice) + 2.0 * kd * less;
        4.0 * sinh * moved / whole
    }

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
    fn a_piston_has_its_closed_form() {
        for kd in [0.05_f64, 0.5, 1.3, 4.0] {
            let closed = 2.0 * ((2.0 * kd).cosh() - 1.0) / ((2.0 * kd).sinh() + 2.0 * kd);
            let found = Paddle::Piston.transfer(kd / 0.6, 0.6);
            let error = (found / closed - 1.0).abs();
            assert!(error < 1e-12, "{kd}: {found} {closed}");
        }
    }

    /// H/S = kd for pistons and kd/2 for flaps hinged at the floor where waves are long; 2 where they are short.
    #[test]
    fn long_and_short_waves_have_their_limits() {
        let [long, short] = [1e-3, 400.0];
        assert!((Paddle::Piston.transfer(long, 1.0) / long - 1.0).abs() < 1e-6);
        assert!((Paddle::Flap(0.0).transfer(long, 1.0) / (0.5 * long) - 1.0).abs() < 1e-6);
        assert!((Paddle::Piston.transfer(short, 1.0) - 2.0).abs() < 1e-12);
        assert!((Paddle::Flap(0.0).transfer(short, 1.0) - 2.0 * (1.0 - 1.0 / 400.0)).abs() < 1e-12);
    }

    /// The closed integral against the midpoint rule, with hinges above, at and far below the floor; the last is a piston.
    #[test]
    fn flaps_are_their_integral() {
        let (k, d) = (2.1_f64, 0.8_f64);
        for hinge in [0.3, 0.0, -0.5, -1e7] {
            let arm = d - hinge;
            let low = -arm.min(d);
            let n = 200_000;
            let dz = -low / n as f64;
            let f = |z: f64| (1.0 + z / arm) * (k * (z + d)).cosh();
            let sum: f64 = (0..n).map(|j| f(low + (j as f64 + 0.5) * dz) * dz).sum();
            let (kd, whole) = (k * d, (2.0 * k * d).sinh() + 2.0 * k * d);
            let exact = 4.0 * kd.sinh() / whole * k * sum;
            let found = Paddle::Flap(hinge).transfer(k, d);
            let error = (found / exact - 1.0).abs();
            assert!(error < 1e-8, "{hinge}: {found} {exact}");
        }
        let piston = Paddle::Piston.transfer(k, d);
        assert!((Paddle::Flap(-1e7).transfer(k, d) / piston - 1.0).abs() < 1e-6);
    }

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
