//! The equation of state of slightly compressible grains that dilate in shear.

use crate::plugin;
use crate::state::{BoundState, EquationOfState, Reference};

/// p = ρ₀c₀² u with the largest root of u (u + 1 − ρ/ρ₀)² = A (1 + u)², where
/// A = (γ̇d/c₀)² Δφ²/φ_max³; at rest p = c₀² max(ρ − ρ₀, 0).
///
/// The grains have ρ_s = ρ_s0 (1 + K_t p), their share of space is φ = φ_max − Δφ I with the inertial
/// number I = γ̇d√(ρ_s0/p), and ρ = φρ_s. The scene's phase gives what the source calls K_t and ρ_s0: the
/// reference density is that of grains at rest, ρ₀ = φ_max ρ_s0, and the speed of sound at rest
/// is c₀ = 1/√(K_t ρ₀). The pressure is never negative: a layer that has dilated to below ρ₀ has one only
/// while it shears.
///
/// Symbols: p pressure (Pa), u = K_t p, γ̇ magnitude of the strain rate (1/s), d grain diameter (m),
/// Δφ = φ_max − φ_min.
///
/// Limits: with A > 0 sound is slower than c₀, which is what the step is held against. Stiffer grains
/// (a larger c₀) make ∂p/∂γ̇ larger and short waves less stable. The diameter shrinks as in two
/// dimensions, d² ~ 1/ρ_s; in three the difference is of the order of u/3.
///
/// Source: Minatti & Paris 2015, Eq. 8, 9, 41–44 (its Eq. 44 prints ρ₀ for ρ_s0), factored; densities
/// and the root are ours.
///
/// ```toml
/// [phase.beads.equation-of-state.compressible-grains]
/// grain_diameter = "5 mm"
/// ```
#[plugin(crate::state::EquationOfStateEntry, "compressible-grains",
    "grains that dilate in shear, p from density and strain rate",
    source: "Minatti & Paris 2015, Eq. 8, 9, 41–44")]
pub struct CompressibleGrains {
    /// Grain diameter d without pressure.
    #[parameter(unit: "m", min: 0.0, source: "Minatti & Paris 2015, Eq. 6")]
    pub grain_diameter: f64,
    /// Share of space φ_max that the grains fill at rest.
    #[parameter(default: 0.6, unit: "1", above: 0.0, max: 1.0, source: "Minatti & Paris 2015, Eq. 8")]
    pub largest_fraction: f64,
    /// Share of space φ_min that they fill at an inertial number of one; not above φ_max, or they
    /// do not dilate.
    #[parameter(default: 0.5, unit: "1", min: 0.0, max: 1.0, source: "Minatti & Paris 2015, Eq. 8")]
    pub smallest_fraction: f64,
}

impl EquationOfState for CompressibleGrains {
    fn bind(&self, reference: Reference) -> Box<dyn BoundState> {
        let range = (self.largest_fraction - self.smallest_fraction).max(0.0);
        let dilatancy = range * range / self.largest_fraction.powi(3);
        Box::new(BoundGrains {
            reference,
            stiffness: reference.density * reference.sound_speed.powi(2),
            shear: (self.grain_diameter / reference.sound_speed).powi(2) * dilatancy,
        })
    }
}

#[derive(Debug)]
struct BoundGrains {
    reference: Reference,
    /// ρ₀c₀² = 1/K_t, Pa.
    stiffness: f64,
    /// A/γ̇², s².
    shear: f64,
}

impl BoundState for BoundGrains {
    fn pressure(&self, density: &[f64], pressure: &mut [f64]) {
        for (p, rho) in pressure.iter_mut().zip(density) {
            *p = self.stiffness * (rho / self.reference.density - 1.0).max(0.0);
        }
    }

    fn needs_strain_rate(&self) -> bool {
        self.shear > 0.0
    }

    fn sheared_pressure(&self, density: &[f64], strain_rate: &[f64], pressure: &mut [f64]) {
        if !self.needs_strain_rate() {
            return self.pressure(density, pressure);
        }
        let states = density.iter().zip(strain_rate);
        for (p, (rho, rate)) in pressure.iter_mut().zip(states) {
            let ratio = rho / self.reference.density;
            *p = self.stiffness * compression(ratio, self.shear * rate * rate).0;
        }
    }

    /// At rest; the least density there for pressures that are not positive.
    fn density(&self, pressure: f64) -> f64 {
        self.reference.density * (1.0 + pressure.max(0.0) / self.stiffness)
    }

    /// At rest: the largest at any strain rate.
    fn sound_speed(&self, _density: f64) -> f64 {
        self.reference.sound_speed
    }

    /// At rest; what shear adds is not stored.
    fn internal_energy(&self, density: f64) -> f64 {
        match density / self.reference.density {
            x if x > 1.0 => self.reference.sound_speed.powi(2) * (x.ln() + 1.0 / x - 1.0),
            _ => 0.0,
        }
    }

    fn reference(&self) -> Reference {
        self.reference
    }
}

/// The physical root u of u (u − β)² = A (1 + u)² with β = b − 1, and the number of steps taken.
///
/// It is the largest real root, the only one above max(0, β). Newton's steps on
/// √u (u − β) − √A (1 + u), halving where they leave the bracket. In u = x − 1 and not in x: the
/// pressure is a small difference from one.
fn compression(b: f64, a: f64) -> (f64, u32) {
    let b = b.max(0.0);
    let beta = b - 1.0;
    let (mut low, mut high) = (beta.max(0.0), 2.0 * b + a);
    if a <= 0.0 {
        return (low, 0);
    }
    let s = a.sqrt();
    let mut u = high.min(low + s * (1.0 + low) / (low + s).sqrt());
    for step in 1..=STEPS {
        let root = u.sqrt();
        let f = root * (u - beta) - s * (1.0 + u);
        let slope = (u - beta) / (2.0 * root) + root - s;
        match f > 0.0 {
            true => high = u,
            false => low = u,
        }
        let newton = u - f / slope;
        // Before the bracket is looked at: a last step of no length ends on its edge.
        if (newton - u).abs() <= 1e-15 * u {
            return (newton.max(low).min(high), step);
        }
        u = match slope > 0.0 && newton > low && newton < high {
            true => newton,
            false => 0.5 * (low + high),
        };
    }
    (u, STEPS)
}

/// More than halving a bracket of any two numbers down to neighbours would take in practice.
const STEPS: u32 = 100;

#[cfg(test)]
mod tests {
    use super::*;

    /// Roots computed independently with 40 digits.
    #[test]
    fn the_table_of_roots_is_met() {
        let table = [
            (0.98, 0.0, 0.0),
            (1.01, 0.0, 0.01),
            (0.9, 1e-3, 0.04936038082908671),
            (0.98, 1e-6, 0.002062846181679019),
            (1.0, 1e-6, 0.01006700123744853),
            (1.01, 1e-6, 0.01765822940443345),
            (1.02, 1e-4, 0.0625),
            (1.005, 1e-9, 0.005431415684311755),
            (1.01, 1e-12, 0.01001009500677729),
        ];
        let mut worst: f64 = 0.0;
        for (b, a, root) in table {
            let (u, _) = compression(b, a);
            worst = worst.max((u - root).abs() / root.max(1e-300));
        }
        assert!(worst < 1e-12, "{worst:e}");
    }

    /// 20 000 states: in its bracket, a root to rounding, the largest, in few steps.
    #[test]
    fn the_root_is_the_largest_at_random_states() {
        let mut seed = 1_u64;
        let mut random = || {
            seed ^= seed << 13;
            seed ^= seed >> 7;
            seed ^= seed << 17;
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        let (mut most, mut worst) = (0, 0.0_f64);
        for k in 0..20_000 {
            let b = match k % 3 {
                0 => 2.0 * random(),
                1 => 1.0 + 10_f64.powf(-8.0 * random() - 1.0),
                _ => 1.0 - 10_f64.powf(-8.0 * random() - 1.0),
            };
            let a = 10_f64.powf(-18.0 + 20.0 * random());
            let (u, steps) = compression(b, a);
            let beta = b - 1.0;
            let bracket = beta.max(0.0)..=2.0 * b + a;
            assert!(bracket.contains(&u) && u > 0.0, "{b} {a:e} {u}");
            // The residual as a change of u.
            let (root, s) = (u.sqrt(), a.sqrt());
            let slope = (u - beta) / (2.0 * root) + root - s;
            let f = root * (u - beta) - s * (1.0 + u);
            worst = worst.max((f / slope).abs() / (u + beta.abs()));
            assert!(slope > 0.0, "the largest root: {b} {a:e}");
            // More shear at the same density presses more.
            assert!(compression(b, 1.01 * a).0 >= u);
            most = most.max(steps);
        }
        assert!(worst < 1e-15 && most < STEPS, "{worst:e} {most}");
    }

    fn grains(grain_diameter: f64) -> CompressibleGrains {
        CompressibleGrains {
            grain_diameter,
            largest_fraction: 0.6,
            smallest_fraction: 0.5,
        }
    }

    /// Density and strain rate to pressure, computed independently for two materials.
    #[test]
    fn the_table_of_pressures_is_met() {
        let bound = |compressibility: f64, grain_density: f64, grain_diameter| {
            let density = 0.6 * grain_density;
            grains(grain_diameter).bind(Reference {
                density,
                sound_speed: 1.0 / (compressibility * density).sqrt(),
            })
        };
        let (beads, sand) = (bound(1.5e-5, 800.0, 5e-3), bound(4.1e-5, 2600.0, 0.32e-3));
        let table = [
            (&beads, 470.0, 10.0, 110.23178),
            (&beads, 480.5, 10.0, 678.7322),
            (&beads, 482.0, 0.1, 287.09161),
            (&sand, 1565.0, 1.0, 85.377426),
            (&sand, 1600.0, 20.0, 677.76254),
            (&sand, 1550.0, 5.0, 4.26515),
        ];
        for (law, rho, rate, pressure) in table {
            let mut p = [0.0];
            law.sheared_pressure(&[rho], &[rate], &mut p);
            assert!((p[0] / pressure - 1.0).abs() < 2e-7, "{} {pressure}", p[0]);
            assert!(law.needs_strain_rate());
        }
    }

    #[test]
    fn at_rest_density_inverts_pressure_and_energy_is_its_integral() {
        let reference = Reference {
            density: 480.0,
            sound_speed: 11.8,
        };
        let law = grains(5e-3).bind(reference);
        for rho in [400.0, 480.0, 480.01, 490.0, 530.0] {
            let (mut p, mut still) = ([0.0; 2], [0.0; 2]);
            law.pressure(&[rho, rho + 1e-3], &mut p);
            law.sheared_pressure(&[rho, rho + 1e-3], &[0.0; 2], &mut still);
            assert!((p[0] - still[0]).abs() < 1e-9);
            let energy = law.internal_energy(rho + 1e-4) - law.internal_energy(rho - 1e-4);
            let exact = p[0] / (rho * rho);
            assert!((energy / 2e-4 - exact).abs() < 1e-5 * exact + 1e-7, "{rho}");
            if rho > 480.0 {
                assert!((law.density(p[0]) / rho - 1.0).abs() < 1e-14);
                let c2 = (p[1] - p[0]) / 1e-3;
                assert!((c2.sqrt() / law.sound_speed(rho) - 1.0).abs() < 1e-8);
            }
        }
        assert_eq!(law.density(-5.0), 480.0);
        let rigid = CompressibleGrains {
            smallest_fraction: 0.7,
            ..grains(5e-3)
        };
        assert!(!rigid.bind(reference).needs_strain_rate());
    }
}
