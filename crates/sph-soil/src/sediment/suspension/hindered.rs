//! Grains that settle among others.

/// Speed and flux of grains of one size that settle in a fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HinderedSettling {
    /// Speed w of one grain in still fluid, m/s.
    pub speed: f64,
    /// Exponent n.
    pub exponent: f64,
    /// Concentration C_max of packed grains.
    pub packing: f64,
}

impl HinderedSettling {
    /// n of grains with a Reynolds number wd/ν: 4.65 up to 0.2, 4.35 Re^−0.03 up to 1, 4.45 Re^−0.1 up to 500, 2.39 beyond, far
    /// from walls.
    ///
    /// Source: Richardson and Zaki 1954.
    #[must_use]
    pub fn exponent_of(reynolds: f64) -> f64 {
        match reynolds {
            re if re <= 0.2 => 4.65,
            re if re <= 1.0 => 4.35 * re.powf(-0.03),
            re if re <= 500.0 => 4.45 * re.powf(-0.1),
            _ => 2.39,
        }
    }

    /// w C (1 − C)^n, m/s: the volume of grains that passes a level per area and time.
    #[must_use]
    pub fn flux(&self, concentration: f64) -> f64 {
        self.speed * concentration * (1.0 - concentration).powf(self.exponent)
    }

    /// The concentration of the largest flux.
    #[must_use]
    pub fn fastest(&self) -> f64 {
        1.0 / (1.0 + self.exponent)
    }

    /// The flux that grains of a concentration send down where there is room, m/s.
    #[must_use]
    pub fn demand(&self, concentration: f64) -> f64 {
        self.flux(concentration.min(self.fastest()))
    }

    /// The flux that grains of a concentration let in from above, m/s: none where they are packed. Close to it w (C_max − C),
    /// so that a step that keeps concentrations from below zero keeps them below the packing, too.
    #[must_use]
    pub fn supply(&self, concentration: f64) -> f64 {
        let room = self.speed * (self.packing - concentration).max(0.0);
        self.flux(concentration.max(self.fastest()).min(1.0))
            .min(room)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_are_those_of_richardson_and_zaki() {
        let close = |re: f64, n: f64| (HinderedSettling::exponent_of(re) - n).abs() < 5e-3;
        assert!(close(0.01, 4.65) && close(1.0, 4.35) && close(100.0, 2.808) && close(1e4, 2.39));
    }

    /// min(demand above, supply below) is Godunov's flux: the least of f between C above and C below if C grows downwards, the
    /// largest otherwise.
    #[test]
    fn demand_and_supply_make_the_flux_of_godunov() {
        let law = HinderedSettling {
            speed: 2e-3,
            exponent: 4.65,
            packing: 0.6,
        };
        let levels = |a: f64, b: f64| (0..=2000).map(move |k| a + (b - a) * f64::from(k) / 2000.0);
        for (above, below) in [(0.0, 0.1), (0.1, 0.3), (0.3, 0.1), (0.05, 0.5), (0.5, 0.02)] {
            let flux = law.demand(above).min(law.supply(below));
            let all = levels(above, below).map(|c| law.flux(c));
            let godunov = match above <= below {
                true => all.fold(f64::INFINITY, f64::min),
                false => all.fold(0.0, f64::max),
            };
            assert!(
                (flux / godunov - 1.0).abs() < 1e-5 || godunov == 0.0,
                "{above} {below}"
            );
        }
        assert_eq!(law.supply(0.6), 0.0);
        assert_eq!(law.demand(0.0), 0.0);
    }
}
