//! The mean velocity over a wall as a solution.

use sph_core::{Vect, plugin};
use sph_probes::{Solution, SolutionEntry};

use super::law::WallLaw;

/// u = u* u⁺(z u*/ν, k_s u*/ν) along x: the law of the wall over a flat bed, which in a wide open channel holds up to the
/// surface if the mixing length is κz√(1 − z/H).
///
/// Sources: Issa 2004, Eq. 6.21–6.23 and 6.29; the blend of [`WallLaw`] near the wall.
#[plugin(SolutionEntry [2, 3], "log-law", "the law of the wall over a flat bed, smooth or rough",
    source: "Issa 2004, Eq. 6.21–6.29; Reichardt 1951", cfg(not(test)))]
pub struct LogLawFlow {
    /// Friction velocity u*.
    #[parameter(unit: "m/s", above: 0.0)]
    pub friction_velocity: f64,
    /// Kinematic viscosity ν.
    #[parameter(unit: "m²/s", above: 0.0)]
    pub kinematic_viscosity: f64,
    /// Equivalent sand roughness k_s of the bed; 0 if it is smooth.
    #[parameter(default, unit: "m", min: 0.0)]
    pub roughness: f64,
    /// Height of the bed.
    #[parameter(default, unit: "m")]
    pub bottom: f64,
    /// Von Kármán's κ.
    #[parameter(default: WallLaw::default().karman, unit: "1", above: 0.0)]
    pub karman: f64,
    /// B of a smooth bed.
    #[parameter(default: WallLaw::default().smooth, unit: "1")]
    pub smooth_constant: f64,
    /// D of a fully rough bed.
    #[parameter(default: WallLaw::default().rough, unit: "1")]
    pub rough_constant: f64,
}

impl<const D: usize> Solution<D> for LogLawFlow {
    fn velocity(&self, position: &Vect<D>, _time: f64) -> Option<Vect<D>> {
        let law = WallLaw {
            karman: self.karman,
            smooth: self.smooth_constant,
            rough: self.rough_constant,
            roughness: self.roughness,
        };
        let height = position[D - 1] - self.bottom;
        let mut velocity = Vect::zeros();
        if height > law.least_distance() {
            velocity[0] = law.speed(self.friction_velocity, height, self.kinematic_viscosity);
        }
        Some(velocity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Page §4.5 and §4.7: 1.4677 and 0.8749 m/s at the surface of the smooth and the rough channel.
    #[test]
    fn surfaces_have_the_speeds_of_the_page() {
        let at = |roughness: f64, height: f64| {
            let table = "friction_velocity = 0.05\nkinematic_viscosity = 1e-6\nbottom = 0.1";
            let table = format!("{table}\nroughness = {roughness}");
            let flow: LogLawFlow = toml::from_str(&table).expect("a flow");
            let place = Vect::from([3.0, 0.1 + height]);
            Solution::<2>::velocity(&flow, &place, 0.0).expect("a velocity")
        };
        assert!((at(0.0, 0.4).x - 1.4677).abs() < 1e-4);
        assert!((at(0.01, 0.4).x - 0.8749).abs() < 1e-4);
        assert_eq!(at(0.01, 0.0).norm(), 0.0);
    }
}
