//! Grains of one size in water, and the threshold of their motion on a slope.

/// Grains of one size in a fluid, as laws of transport know them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grains {
    /// Diameter d, m.
    pub diameter: f64,
    /// Their density over that of the fluid, s.
    pub relative_density: f64,
    /// Kinematic viscosity of the fluid ν, m²/s.
    pub viscosity: f64,
    /// Gravity g, m/s².
    pub gravity: f64,
}

impl Grains {
    /// (s − 1) g, m/s².
    fn submerged_gravity(&self) -> f64 {
        (self.relative_density - 1.0) * self.gravity
    }

    /// D* = d ((s − 1) g/ν²)^(1/3).
    pub fn dimensionless_diameter(&self) -> f64 {
        self.diameter * (self.submerged_gravity() / self.viscosity.powi(2)).cbrt()
    }

    /// Shields number θ = u*²/((s − 1) g d) of a friction velocity squared, m²/s².
    pub fn shields(&self, friction_velocity_squared: f64) -> f64 {
        friction_velocity_squared / (self.submerged_gravity() * self.diameter)
    }

    /// Shields number at which grains of a flat bed begin to move: 0.30/(1 + 1.2 D*) + 0.055 (1 − e^(−0.020 D*)).
    ///
    /// Source: Soulsby and Whitehouse 1997, Eq. 77 of Soulsby 1997.
    pub fn critical_shields(&self) -> f64 {
        let d = self.dimensionless_diameter();
        0.30 / (1.0 + 1.2 * d) + 0.055 * (1.0 - (-0.020 * d).exp())
    }

    /// Speed at which one grain settles in still fluid, m/s: ν/d (√(10.36² + 1.049 D*³) − 10.36).
    ///
    /// Source: Soulsby 1997, Eq. 102.
    pub fn settling_velocity(&self) -> f64 {
        let cube = self.dimensionless_diameter().powi(3);
        // Without cancellation for small grains.
        let root = (10.36_f64.powi(2) + 1.049 * cube).sqrt();
        self.viscosity / self.diameter * 1.049 * cube / (root + 10.36)
    }

    /// Speed at which a small sphere settles in still fluid, m/s: (s − 1) g d²/(18 ν).
    ///
    /// Source: Stokes 1851.
    pub fn stokes_velocity(&self) -> f64 {
        self.submerged_gravity() * self.diameter.powi(2) / (18.0 * self.viscosity)
    }

    /// √((s − 1) g d³), m²/s: the volume of grains per width and time at q* = 1.
    pub fn unit_transport(&self) -> f64 {
        (self.submerged_gravity() * self.diameter.powi(3)).sqrt()
    }
}

/// Critical Shields number on a slope over that of a flat bed:
///
/// (cos ψ sin β + √(cos²β tan²φ − sin²ψ sin²β))/tan φ
///
/// with the angle β of the slope, φ of repose, and ψ between the flow and the way up. 0 where grains slide without a flow.
///
/// `gradient` is ∇z, `direction` the unit vector of the flow in the plane, `repose` tan φ.
///
/// Source: Soulsby 1997, Eq. 80a.
pub fn critical_ratio(gradient: [f64; 2], direction: [f64; 2], repose: f64) -> f64 {
    let along = gradient[0] * direction[0] + gradient[1] * direction[1];
    let across = gradient[0] * direction[1] - gradient[1] * direction[0];
    let cosine = 1.0 / (1.0 + along * along + across * across).sqrt();
    // cos ψ sin β = ∇z·e cos β, sin ψ sin β = |∇z × e| cos β.
    let held = repose * repose - across * across;
    match held > 0.0 {
        true => (cosine * (along + held.sqrt()) / repose).max(0.0),
        false => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sand(diameter: f64) -> Grains {
        Grains {
            diameter,
            relative_density: 2.65,
            viscosity: 1.36e-6,
            gravity: 9.81,
        }
    }

    /// Small grains settle by Stokes's law, large ones by a constant drag; thresholds are 0.30 and 0.055.
    #[test]
    fn limits_are_those_of_theory() {
        // Small grains settle by Stokes's law, (s − 1) g d²/18ν: the formula has 1.049/(2·10.36) = 1/19.75.
        let small = sand(1e-6);
        let stokes = 1.65 * 9.81 * 1e-12 / 1.36e-6;
        assert!((small.settling_velocity() / stokes - 1.0 / 19.75).abs() < 1e-4);
        // Large ones with √(1.049 (s − 1) g d).
        let large = sand(0.1);
        let free = (1.049 * 1.65 * 9.81 * 0.1_f64).sqrt();
        assert!((large.settling_velocity() / free - 1.0).abs() < 1e-2);
        // Gravel moves at 0.055, and the threshold of fine grains is 0.30.
        assert!((large.critical_shields() - 0.055).abs() < 1e-3);
        assert!((small.critical_shields() - 0.30).abs() < 0.01);
    }

    /// θ of u* = 5 cm/s for sand of 0.5 mm: 0.0025/(1.65 · 9.81 · 0.0005).
    #[test]
    fn the_shields_number_is_shear_over_weight() {
        let grains = sand(5e-4);
        assert!((grains.shields(0.0025) - 0.308_896).abs() < 1e-5);
        assert!((grains.unit_transport() - (1.65 * 9.81 * 1.25e-10_f64).sqrt()).abs() < 1e-18);
        assert!((grains.dimensionless_diameter() - 10.304).abs() < 1e-2);
    }

    /// Up and down the slope sin(φ ± β)/sin φ, across it cos β √(1 − tan²β/tan²φ); 0 at the angle of repose.
    #[test]
    fn it_has_the_forms_along_and_across_a_slope() {
        let phi = 32_f64.to_radians();
        for degrees in [0.0, 5.0, 15.0, 31.0_f64] {
            let beta = degrees.to_radians();
            let slope = beta.tan();
            let ratio = |direction| critical_ratio([slope, 0.0], direction, phi.tan());
            assert!((ratio([1.0, 0.0]) - (phi + beta).sin() / phi.sin()).abs() < 1e-14);
            assert!((ratio([-1.0, 0.0]) - (phi - beta).sin() / phi.sin()).abs() < 1e-14);
            let across = beta.cos() * (1.0 - (slope / phi.tan()).powi(2)).sqrt();
            assert!((ratio([0.0, 1.0]) - across).abs() < 1e-14);
        }
        assert_eq!(critical_ratio([0.7, 0.0], [-1.0, 0.0], 0.6), 0.0);
        assert_eq!(critical_ratio([0.7, 0.0], [0.0, 1.0], 0.6), 0.0);
    }
}
