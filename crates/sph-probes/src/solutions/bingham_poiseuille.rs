//! Plane Poiseuille flow of a fluid with a yield stress.

use sph_core::{Vect, plugin};

use crate::{Solution, SolutionEntry, solutions::along};

/// u = n/(n+1) (G/K)^(1/n) [(b − y₀)^(1+1/n) − (max(|y|, y₀) − y₀)^(1+1/n)] with G = ρa and a plug of half
/// width y₀ = τ_y/G; b is half the height of the channel and y counts from its middle.
///
/// n = 1 is the Bingham fluid. With `stress_growth` m the fluid is that of Papanastasiou: the shear
/// rate s = |u′| solves K sⁿ + τ_y (1 − e^(−ms)) = G|y|, and since y is known as a function of s,
/// u = ∫ s dy = 1/G [K n/(n+1) s^(n+1) − τ_y (s + 1/m) e^(−ms)] between s(|y|) and s(b), which is exact.
///
/// The flow is steady; beyond the walls the profile goes on.
///
/// Source: Ghaïtanellis 2017, Eq. 5.9–5.10, for n = 1; the regularised profile is ours.
///
/// ```toml
/// [reference.profile]
/// field = "velocity"
/// solution = "bingham-poiseuille"
/// norm = "l2"
/// [reference.profile.parameters]
/// density = 1.0
/// viscosity = 1.0
/// yield_stress = 1.0
/// stress_growth = 10.0
/// acceleration = 10.0
/// height = 1.0
/// ```
#[plugin(SolutionEntry [2, 3], "bingham-poiseuille", "steady channel flow with a yield stress, ideal or regularised",
    source: "Ghaïtanellis 2017, Eq. 5.9–5.10")]
pub struct BinghamPoiseuille {
    /// Density ρ.
    #[parameter(unit: "kg/m³", above: 0.0)]
    pub density: f64,
    /// Plastic viscosity K, or consistency where n is not 1.
    #[parameter(unit: "Pa s", above: 0.0)]
    pub viscosity: f64,
    /// Exponent n of Herschel and Bulkley.
    #[parameter(default: 1.0, unit: "1", above: 0.0)]
    pub exponent: f64,
    /// Yield stress τ_y.
    #[parameter(unit: "Pa", min: 0.0)]
    pub yield_stress: f64,
    /// Stress growth time m of the regularised fluid; the ideal one if left out.
    #[parameter(unit: "s", above: 0.0)]
    pub stress_growth: Option<f64>,
    /// Driving acceleration a along x.
    #[parameter(unit: "m/s²")]
    pub acceleration: f64,
    /// Height 2b of the channel.
    #[parameter(unit: "m", above: 0.0)]
    pub height: f64,
    /// Ordinate of the lower wall.
    #[parameter(default, unit: "m")]
    pub bottom: f64,
}

impl BinghamPoiseuille {
    /// u in the direction of the acceleration at the distance |y| from the middle.
    fn speed(&self, distance: f64) -> f64 {
        let drive = self.density * self.acceleration.abs();
        let wall = 0.5 * self.height;
        match (drive > 0.0, self.stress_growth) {
            (false, _) => 0.0,
            (true, None) => {
                let n = self.exponent;
                let plug = self.yield_stress / drive;
                let power = |y: f64| (y - plug).max(0.0).powf(1.0 + 1.0 / n);
                let scale = n / (n + 1.0) * (drive / self.viscosity).powf(1.0 / n);
                scale * (power(wall) - power(distance))
            }
            (true, Some(m)) => {
                let at = |y: f64| self.primitive(self.shear_rate(drive * y, m), m);
                (at(wall) - at(distance)) / drive
            }
        }
    }

    /// ∫₀ˢ s dτ with the stress τ(s) of the regularised fluid.
    fn primitive(&self, s: f64, m: f64) -> f64 {
        let n = self.exponent;
        let grown = -(-m * s).exp_m1() / m - s * (-m * s).exp();
        self.viscosity * n / (n + 1.0) * s.powf(n + 1.0) + self.yield_stress * grown
    }

    /// The root s of K sⁿ + τ_y (1 − e^(−ms)) = τ: Newton's steps, halving where they leave the bracket.
    fn shear_rate(&self, stress: f64, m: f64) -> f64 {
        let (k, n, tau) = (self.viscosity, self.exponent, self.yield_stress);
        let ideal = |stress: f64| (stress.max(0.0) / k).powf(1.0 / n);
        let (mut low, mut high) = (ideal(stress - tau), ideal(stress));
        let mut s = 0.5 * (low + high);
        for _ in 0..200 {
            let excess = k * s.powf(n) - tau * (-m * s).exp_m1() - stress;
            match excess > 0.0 {
                true => high = s,
                false => low = s,
            }
            let slope = k * n * s.powf(n - 1.0) + tau * m * (-m * s).exp();
            let newton = s - excess / slope;
            // Before the test of the bracket: a last step of no length ends on its edge.
            if (newton - s).abs() <= 1e-15 * s {
                return newton;
            }
            s = match newton > low && newton < high {
                true => newton,
                false => 0.5 * (low + high),
            };
        }
        s
    }
}

impl<const D: usize> Solution<D> for BinghamPoiseuille {
    fn velocity(&self, position: &Vect<D>, _time: f64) -> Option<Vect<D>> {
        let middle = self.bottom + 0.5 * self.height;
        let speed = self.speed((position[D - 1] - middle).abs());
        along(0, self.acceleration.signum() * speed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn thesis(stress_growth: Option<f64>) -> BinghamPoiseuille {
        BinghamPoiseuille {
            density: 1.0,
            viscosity: 1.0,
            exponent: 1.0,
            yield_stress: 1.0,
            stress_growth,
            acceleration: 10.0,
            height: 1.0,
            bottom: -0.5,
        }
    }

    /// 100 u⁺ with u⁺ = u η_∞/(ρ g L²), which was computed independently to eight digits.
    #[test]
    fn the_table_of_profiles_is_met() {
        let places = [0.0, 0.05, 0.10, 0.15, 0.20, 0.30, 0.40];
        let table = [
            (None, [8.0, 8.0, 8.0, 7.875, 7.5, 6.0, 3.5]),
            (
                Some(10.0),
                [8.1, 8.086672, 8.032690, 7.875652, 7.500005, 6.0, 3.5],
            ),
            (
                Some(100.0),
                [8.01, 8.008489, 8.000912, 7.875, 7.5, 6.0, 3.5],
            ),
        ];
        for (growth, row) in table {
            let flow = thesis(growth);
            for (y, table) in places.into_iter().zip(row) {
                for sign in [-1.0, 1.0] {
                    let at = Vect::from([0.3, sign * y]);
                    let u = flow.velocity(&at, 0.0).expect("a velocity").x;
                    let error = (10.0 * u - table).abs();
                    assert!(error < 5.01e-7, "{growth:?} {y}: {u}");
                }
            }
        }
    }

    #[test]
    fn the_mean_of_the_ideal_profile_is_known() {
        let (flow, n) = (thesis(None), 100_000);
        let middle = |k: i32| (f64::from(k) + 0.5) / f64::from(n) * 0.5;
        let mean: f64 = (0..n).map(|k| flow.speed(middle(k))).sum::<f64>() / f64::from(n);
        let bingham = 0.1_f64;
        let exact = 10.0 * (1.0 - 3.0 * bingham + 4.0 * bingham.powi(3)) / 12.0;
        assert!((mean / exact - 1.0).abs() < 1e-9, "{mean}");
    }

    /// The closed form against Gauss–Legendre quadrature of s over y, and s against its equation.
    #[test]
    fn the_regularised_profile_is_the_integral_of_the_shear_rate() {
        const NODES: [(f64, f64); 4] = [
            (0.183_434_642_495_649_8, 0.362_683_783_378_362),
            (0.525_532_409_916_329, 0.313_706_645_877_887_3),
            (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
            (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
        ];
        let (mut worst, mut residual): (f64, f64) = (0.0, 0.0);
        for (growth, exponent) in [(10.0, 1.0), (100.0, 1.0), (3.0, 1.6), (10.0, 0.7)] {
            let mut flow = thesis(Some(growth));
            flow.exponent = exponent;
            let rate = |y: f64| flow.shear_rate(10.0 * y, growth);
            for y in [0.02, 0.09, 0.1, 0.13, 0.3, 0.45] {
                let (panels, mut sum) = (400, 0.0);
                let half = 0.5 * (0.5 - y) / f64::from(panels);
                for k in 0..panels {
                    let centre = y + (2.0 * f64::from(k) + 1.0) * half;
                    let both = |(x, w): (f64, f64)| {
                        w * (rate(centre - x * half) + rate(centre + x * half))
                    };
                    sum += half * NODES.into_iter().map(both).sum::<f64>();
                }
                worst = worst.max((flow.speed(y) - sum).abs());
                let s = rate(y);
                let stress = s.powf(exponent) - (-growth * s).exp_m1();
                residual = residual.max((stress / (10.0 * y) - 1.0).abs());
            }
        }
        println!("profile against quadrature {worst:e}, residual of s {residual:e}");
        assert!(worst < 1e-12 && residual < 1e-14, "{worst:e} {residual:e}");
    }

    #[test]
    fn ideal_shear_balances_the_drive_outside_of_the_plug() {
        // Krimi et al. 2018 with G = 1000 Pa/m: 0.446429 m/s.
        let mut flow = BinghamPoiseuille {
            viscosity: 0.7,
            yield_stress: 25.0,
            density: 1000.0,
            acceleration: 1.0,
            height: 0.1,
            bottom: 0.0,
            ..thesis(None)
        };
        assert!((flow.speed(0.0) - 0.446_429).abs() < 1e-6);
        flow.acceleration = -1.0;
        for n in [0.5, 1.0, 1.8] {
            flow.exponent = n;
            let h = 1e-6;
            for y in [0.03, 0.04, 0.049] {
                let slope = (flow.speed(y - h) - flow.speed(y + h)) / (2.0 * h);
                let stress = 25.0 + 0.7 * slope.powf(n);
                assert!((stress / (1000.0 * y) - 1.0).abs() < 1e-6, "{n}: {stress}");
            }
            assert_eq!(flow.speed(0.0), flow.speed(0.0249));
            assert_eq!(flow.speed(0.05), 0.0);
            let at = |y: f64| Solution::<3>::velocity(&flow, &Vect::from([0.0, 9.0, y]), 0.0);
            assert!(at(0.05).is_some_and(|u| u.x < 0.0 && u.x == -flow.speed(0.0)));
        }
        // A drive that is too weak moves nothing.
        flow.yield_stress = 60.0;
        assert_eq!(flow.speed(0.0), 0.0);
    }
}
