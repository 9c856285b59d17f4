//! The shape of a paddle.

use sph_core::parameters;

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
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_piston_has_its_closed_form() {
        for kd in [0.05_f64, 0.5, 1.3, 4.0] {
            let closed = 2.0 * ((2.0 * kd).cosh() - 1.0) / ((2.0 * kd).sinh() + 2.0 * kd);
            let found = Paddle::Piston.transfer(kd / 0.6, 0.6);
            assert!(
                (found / closed - 1.0).abs() < 1e-12,
                "{kd}: {found} {closed}"
            );
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
            assert!(
                (found / exact - 1.0).abs() < 1e-8,
                "{hinge}: {found} {exact}"
            );
        }
        let piston = Paddle::Piston.transfer(k, d);
        assert!((Paddle::Flap(-1e7).transfer(k, d) / piston - 1.0).abs() < 1e-6);
    }
}
