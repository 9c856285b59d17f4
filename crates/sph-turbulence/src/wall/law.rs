//! The mean velocity near a wall, and the friction velocity that belongs to a velocity.

/// u⁺(z⁺) near a smooth or rough wall, from the wall to the logarithmic layer:
///
/// u⁺ = ln(1 + κz⁺)/κ + (B − ln κ/κ)(1 − e^{−z⁺/11} − z⁺/11 e^{−z⁺/3}) − ΔB(k_s⁺)
///
/// with u⁺ = u/u*, z⁺ = z u*/ν, k_s⁺ = k_s u*/ν. It tends to u⁺ = z⁺ for z⁺ → 0 and to ln(z⁺)/κ + B for z⁺ → ∞. The
/// roughness takes off ΔB = (B − D + ln(k_s⁺)/κ) sin(π/2 · ln(k_s⁺/2.25)/ln(90/2.25)), the sine being 0 below
/// k_s⁺ = 2.25 and 1 above 90: there u⁺ = ln(z/k_s)/κ + D, Nikuradse's law.
///
/// Sources: Reichardt 1951 (blend; his constant 7.8 is B − ln κ/κ here); Issa 2004, Eq. 6.22, 6.23 and 6.29 (κ, B, D);
/// Cebeci and Bradshaw 1977, Eq. 6.127 (transition).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallLaw {
    /// Von Kármán's κ.
    pub karman: f64,
    /// B of the smooth wall.
    pub smooth: f64,
    /// D of the fully rough wall.
    pub rough: f64,
    /// Equivalent sand roughness k_s, m; 0 for a smooth wall.
    pub roughness: f64,
}

/// Below this k_s⁺ a wall is smooth.
const SMOOTH_BELOW: f64 = 2.25;
/// Above this k_s⁺ it is fully rough.
const ROUGH_ABOVE: f64 = 90.0;
/// Newton's steps at most; a bracket halves where they leave it.
const STEPS: usize = 100;

impl Default for WallLaw {
    /// κ = 0.41, B = 5.2, D = 8.5, smooth: Issa 2004, Eq. 6.22 and 6.29.
    fn default() -> Self {
        WallLaw {
            karman: 0.41,
            smooth: 5.2,
            rough: 8.5,
            roughness: 0.0,
        }
    }
}

impl WallLaw {
    /// ΔB and its derivative by ln k_s⁺.
    fn shift(&self, sand: f64) -> [f64; 2] {
        if sand <= SMOOTH_BELOW {
            return [0.0; 2];
        }
        let full = self.smooth - self.rough + sand.ln() / self.karman;
        if sand >= ROUGH_ABOVE {
            return [full, 1.0 / self.karman];
        }
        let per = std::f64::consts::FRAC_PI_2 / (ROUGH_ABOVE / SMOOTH_BELOW).ln();
        let (sine, cosine) = (per * (sand / SMOOTH_BELOW).ln()).sin_cos();
        [full * sine, sine / self.karman + full * per * cosine]
    }

    /// u⁺ and z⁺ ∂u⁺/∂z⁺ at z⁺ over a smooth wall.
    fn smooth_wall(&self, z: f64) -> [f64; 2] {
        let constant = self.smooth - self.karman.ln() / self.karman;
        let (outer, inner) = ((-z / 11.0).exp(), (-z / 3.0).exp());
        let value =
            (self.karman * z).ln_1p() / self.karman + constant * (1.0 - outer - z / 11.0 * inner);
        let slope =
            z / (1.0 + self.karman * z) + constant * z / 11.0 * (outer - inner + z / 3.0 * inner);
        [value, slope]
    }

    /// u⁺ at z⁺ for a roughness k_s⁺.
    pub fn velocity(&self, z: f64, sand: f64) -> f64 {
        self.smooth_wall(z)[0] - self.shift(sand)[0]
    }

    /// z⁺ ∂u⁺/∂z⁺ at z⁺: 1/κ in the logarithmic layer, z⁺ at the wall.
    pub fn slope(&self, z: f64) -> f64 {
        self.smooth_wall(z)[1]
    }

    /// Velocity at a distance, m, for a friction velocity u*, m/s, and a kinematic viscosity, m²/s.
    pub fn speed(&self, friction_velocity: f64, distance: f64, viscosity: f64) -> f64 {
        let per_length = friction_velocity / viscosity;
        friction_velocity * self.velocity(distance * per_length, self.roughness * per_length)
    }

    /// Nearest distance at which the fully rough law has a velocity, m.
    pub fn least_distance(&self) -> f64 {
        self.roughness * (-self.karman * self.rough).exp()
    }

    /// u*, m/s, at which the law has a given speed, m/s, at a distance, m: Newton's iterations within a bracket.
    ///
    /// # Errors
    /// If a number is impossible.
    pub fn friction_velocity(
        &self,
        speed: f64,
        distance: f64,
        viscosity: f64,
    ) -> Result<f64, String> {
        let least = self.least_distance();
        let positive = |x: f64| x > 0.0 && x.is_finite();
        let expected = "where a positive number was expected";
        Err(match speed {
            _ if !positive(distance) => {
                format!("the distance from the wall is {distance} m {expected}")
            }
            _ if !positive(viscosity) => {
                format!("the kinematic viscosity is {viscosity} m²/s {expected}")
            }
            _ if !(speed >= 0.0 && speed.is_finite()) => format!(
                "the speed along the wall is {speed} m/s where a number from 0 on was expected"
            ),
            _ if distance <= least => format!(
                "the distance of {distance} m from the wall is within its roughness, where the law has no velocity: more \
                 than {least} m was expected"
            ),
            0.0 => return Ok(0.0),
            _ => return Ok(self.solve(speed, distance, viscosity)),
        })
    }

    /// The root of u* u⁺ − u, which grows with u*.
    fn solve(&self, speed: f64, distance: f64, viscosity: f64) -> f64 {
        let [per_z, per_sand] = [distance / viscosity, self.roughness / viscosity];
        let residual = |u: f64| {
            let [value, slope] = self.smooth_wall(per_z * u);
            let [shift, turn] = self.shift(per_sand * u);
            let plus = value - shift;
            [u * plus - speed, plus + slope - turn]
        };
        // u⁺ = z⁺ of the sublayer, u⁺ = 8.3 z⁺^(1/7) beyond it (Werner and Wengle 1993).
        let reynolds = speed * distance / viscosity;
        let plus = reynolds.sqrt().max((reynolds / 8.3).powf(0.875));
        let mut u = plus * viscosity / distance;
        let (mut low, mut high) = (0.0, f64::INFINITY);
        for _ in 0..STEPS {
            let [value, slope] = residual(u);
            match value > 0.0 {
                true => high = u,
                false => low = u,
            }
            let mut next = u - value / slope;
            if !(next > low && next < high) {
                next = match high.is_finite() {
                    true => 0.5 * (low + high),
                    false => 2.0 * u,
                };
            }
            // Newton's error is squared by each step: the rest of the next is below rounding.
            let squeezed = high.is_finite() && high - low <= 1e-15 * high;
            if squeezed || (next - u).abs() <= 1e-10 * u {
                return next;
            }
            u = next;
        }
        u
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NU: f64 = 1e-6;

    fn rough(roughness: f64) -> WallLaw {
        WallLaw {
            roughness,
            ..WallLaw::default()
        }
    }

    /// Page §4.10 `wall-function`: the velocity of a law gives its u* back, to 1e-10.
    #[test]
    fn the_friction_velocity_of_a_velocity_of_the_law_comes_back() {
        for roughness in [0.0, 1e-5, 1e-4, 1e-3] {
            let law = rough(roughness);
            for exponent in -40..=30 {
                let z_plus = 10f64.powf(0.1 * f64::from(exponent));
                for friction in [1e-4, 0.05, 3.0] {
                    let distance = z_plus * NU / friction;
                    if distance <= roughness {
                        continue;
                    }
                    let u = law.speed(friction, distance, NU);
                    let found = law.friction_velocity(u, distance, NU).expect("a root");
                    let error = (found / friction - 1.0).abs();
                    assert!(error < 1e-10, "z+ {z_plus}, k {roughness}: {error:e}");
                }
            }
        }
    }

    #[test]
    fn it_is_the_sublayer_at_the_wall_and_the_logarithm_far_off() {
        let law = WallLaw::default();
        // The next term is of second order: z⁺²(−κ/2 + C(1/33 − 1/242)), 0.012 of z⁺ at z⁺ = 0.1 at most.
        assert!((law.velocity(0.1, 0.0) / 0.1 - 1.0).abs() < 0.012);
        assert!((law.velocity(1e-3, 0.0) / 1e-3 - 1.0).abs() < 1.2e-4);
        for z in [1e3f64, 1e4, 1e6] {
            let log = z.ln() / 0.41 + 5.2;
            // ln(1 + κz⁺) − ln(κz⁺) = 1/(κz⁺), over κ.
            let bound = 1.0 / (0.41 * 0.41 * z) + 1e-9;
            assert!((law.velocity(z, 0.0) - log).abs() < bound, "{z}");
            assert!((law.slope(z) - 1.0 / 0.41).abs() < bound, "{z}");
        }
    }

    /// Issa 2004, Table 6.1 and Eq. 6.23: 5 to 30 is the buffer between u⁺ = z⁺ and the logarithm.
    #[test]
    fn between_it_lies_below_both() {
        let law = WallLaw::default();
        for z in [5.0f64, 10.0, 20.0, 30.0] {
            let u = law.velocity(z, 0.0);
            assert!(u < z && u < z.ln() / 0.41 + 5.2 + 0.5, "{z}: {u}");
        }
    }

    #[test]
    fn slopes_are_those_of_the_velocity() {
        let law = WallLaw::default();
        for z in [0.3, 3.0, 30.0, 300.0] {
            let step = 1e-5;
            let ends = [1.0 + step, 1.0 - step].map(|f: f64| law.velocity(f * z, 0.0));
            let found = (ends[0] - ends[1]) / (2.0 * step);
            assert!((found / law.slope(z) - 1.0).abs() < 1e-7, "{z}");
        }
    }

    /// Page §4.7: u* = 0.05 m/s, k_s = 10 mm, k_s⁺ = 500: Nikuradse's law, for any viscosity.
    #[test]
    fn a_fully_rough_wall_has_nikuradses_law() {
        let law = rough(0.01);
        for z in [0.02f64, 0.1, 0.4] {
            let exact = 0.05 * ((z / 0.01).ln() / 0.41 + 8.5);
            let found = law.speed(0.05, z, NU);
            let bound = 0.05 / (0.41 * 0.41 * z * 0.05 / NU);
            assert!((found - exact).abs() < bound, "{z}: {found}, {exact}");
        }
        // Page §4.7: 0.8749 m/s at the surface.
        assert!((law.speed(0.05, 0.4, NU) - 0.8749).abs() < 1e-4);
    }

    /// Page §4.5: 0.7371 m/s at z⁺ = 50 and 1.4677 m/s at 20 000, of the bare logarithm. Reichardt's blend is
    /// C e^{−50/11} − 1/(κ²50) off at 50: 0.04 u* below.
    #[test]
    fn the_numbers_of_the_smooth_channel() {
        let law = WallLaw::default();
        assert!((law.speed(0.05, 0.4, NU) - 1.4677).abs() < 1e-4);
        assert!((law.speed(0.05, 1e-3, NU) - 0.7371).abs() < 0.05 * 0.06);
    }

    #[test]
    fn roughness_acts_from_2_25_on_and_without_a_jump() {
        let law = WallLaw::default();
        assert_eq!(law.shift(2.25), [0.0; 2]);
        for sand in [2.25f64, 90.0] {
            let [below, above] =
                [sand * (1.0 - 1e-9), sand * (1.0 + 1e-9)].map(|s| law.shift(s)[0]);
            assert!((below - above).abs() < 1e-7, "{sand}");
        }
        let before = law.shift(20.0)[0];
        assert!(before > 0.0 && before < law.shift(40.0)[0]);
    }

    #[test]
    fn impossible_numbers_are_refused() {
        let law = rough(0.01);
        let refused = |u, z, nu| law.friction_velocity(u, z, nu).expect_err("refused");
        assert!(refused(1.0, -1.0, NU).contains("distance from the wall is -1 m"));
        assert!(refused(1.0, 0.1, 0.0).contains("viscosity is 0"));
        assert!(refused(-1.0, 0.1, NU).contains("speed along the wall is -1"));
        assert!(refused(f64::NAN, 0.1, NU).contains("NaN"));
        // e^{−κD} = 1/32.6 of the roughness.
        assert!(refused(1.0, 0.0003, NU).contains("within its roughness"));
        assert_eq!(law.friction_velocity(0.0, 0.1, NU), Ok(0.0));
    }
}
