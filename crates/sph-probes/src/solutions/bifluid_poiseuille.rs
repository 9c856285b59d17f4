//! Plane Poiseuille flow of two layered fluids.

use sph_core::{Vect, plugin};

use crate::{Solution, SolutionEntry, solutions::along};

/// u⁺ = α² − y⁺² + A (α + y⁺) below the interface, ω [(1−α)² − y⁺²] + λωA (y⁺ − (1−α)) above it,
/// with A = [(1−α)² ω − α²] / [(1−α) λω + α].
///
/// y⁺ = y/L counts from the interface, u⁺ = u/ũ with ũ = g L²/(2 ν₁); λ = ρ₁/ρ₂, ω = ν₁/ν₂,
/// ν = η/ρ; fluid 1 is the lower one, −αL ≤ y ≤ 0, fluid 2 lies in 0 ≤ y ≤ (1−α)L. The flow is
/// steady, which it is after t ≈ L²/ν₁ from rest; beyond the walls the parabolas go on.
///
/// Source: Ghaïtanellis 2017, Eq. 5.1–5.5.
///
/// ```toml
/// [reference.profile]
/// field = "velocity"
/// solution = "bifluid-poiseuille"
/// norm = "l2"
/// [reference.profile.parameters]
/// alpha = 0.5
/// length = 1.0
/// densities = [4000, 1000]
/// viscosities = [1.6, 0.1]
/// acceleration = 4e-7
/// ```
#[plugin(SolutionEntry [2, 3], "bifluid-poiseuille", "steady channel flow of two layered fluids",
    source: "Ghaïtanellis 2017, Eq. 5.1–5.5")]
pub struct BifluidPoiseuille {
    /// Share α of the height that the lower fluid fills.
    #[parameter(unit: "1", above: 0.0, below: 1.0)]
    pub alpha: f64,
    /// Height L of the channel.
    #[parameter(unit: "m", above: 0.0)]
    pub length: f64,
    /// Densities ρ₁ below and ρ₂ above.
    #[schemars(inner(range(min = 0.0)))]
    #[parameter(unit: "kg/m³")]
    pub densities: [f64; 2],
    /// Dynamic viscosities η₁ below and η₂ above.
    #[schemars(inner(range(min = 0.0)))]
    #[parameter(unit: "Pa s")]
    pub viscosities: [f64; 2],
    /// Driving acceleration g along x.
    #[parameter(unit: "m/s²")]
    pub acceleration: f64,
    /// Ordinate of the interface.
    #[parameter(default, unit: "m")]
    pub interface: f64,
}

impl BifluidPoiseuille {
    /// u⁺ at y⁺.
    fn scaled(&self, y: f64) -> f64 {
        let lambda = self.densities[0] / self.densities[1];
        let omega = self.viscosities[0] / self.viscosities[1] / lambda;
        let (alpha, above) = (self.alpha, 1.0 - self.alpha);
        let a = (above * above * omega - alpha * alpha) / (above * lambda * omega + alpha);
        match y <= 0.0 {
            true => alpha * alpha - y * y + a * (alpha + y),
            false => omega * (above * above - y * y) + lambda * omega * a * (y - above),
        }
    }
}

impl<const D: usize> Solution<D> for BifluidPoiseuille {
    fn velocity(&self, position: &Vect<D>, _time: f64) -> Option<Vect<D>> {
        let kinematic = self.viscosities[0] / self.densities[0];
        let scale = self.acceleration * self.length * self.length / (2.0 * kinematic);
        let y = (position[D - 1] - self.interface) / self.length;
        along(0, scale * self.scaled(y))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn thesis() -> BifluidPoiseuille {
        BifluidPoiseuille {
            alpha: 0.5,
            length: 1.0,
            densities: [4000.0, 1000.0],
            viscosities: [1.6, 0.1],
            acceleration: 4e-7,
            interface: 0.0,
        }
    }

    #[test]
    fn the_printed_values_are_met() {
        let flow = thesis();
        let places = [-0.4, -0.2, 0.0, 0.1, 3.0 / 17.0, 0.2, 0.3, 0.4];
        let speeds = [
            0.098824, 0.236471, 0.2941176, 0.395294, 0.4186851, 0.416471, 0.357647, 0.218824,
        ];
        for (y, u) in places.into_iter().zip(speeds) {
            assert!((flow.scaled(y) - u).abs() < 6e-7, "{y}: {}", flow.scaled(y));
        }
        let n = 1000;
        let middle = |k: i32| (f64::from(k) + 0.5) / f64::from(n) - 0.5;
        let mean: f64 = (0..n).map(|k| flow.scaled(middle(k))).sum::<f64>() / f64::from(n);
        // The integral is 0.2512255; a sum over coarse rows gives the 0.2512242 found elsewhere.
        assert!((mean - 0.251_225_5).abs() < 1e-6, "{mean}");
        // ũ = 5·10⁻⁴ m/s.
        let u = Solution::<2>::velocity(&flow, &Vect::from([3.0, 0.0]), 0.0).expect("a velocity");
        assert!((u.x - 5e-4 * 0.294_117_647).abs() < 1e-12 && u.y == 0.0);
    }

    #[test]
    fn stress_and_walls_are_right_for_unequal_layers() {
        let flow = BifluidPoiseuille {
            alpha: 0.3,
            viscosities: [0.02, 3.0],
            densities: [5.0, 800.0],
            interface: 0.7,
            length: 2.0,
            acceleration: 2.0,
        };
        let velocity = |y: f64| Solution::<2>::velocity(&flow, &[0.0, y].into(), 0.0);
        let u = |y| velocity(y).unwrap().x;
        let h = 1e-5;
        let size = u(0.6).abs();
        assert!((u(0.7 - 0.6) / size).abs() < 1e-9 && (u(0.7 + 1.4) / size).abs() < 1e-9);
        let below = 0.02 * (u(0.7) - u(0.7 - h)) / h;
        let above = 3.0 * (u(0.7 + h) - u(0.7)) / h;
        // One-sided differences err by η u″ h/2 = ρ g h/2 on either side.
        assert!((below - above).abs() < 1600.0 * h, "{below} {above}");
        let bend = 3.0 * (u(1.0 + 1e-3) - 2.0 * u(1.0) + u(1.0 - 1e-3)) / 1e-6;
        assert!((bend + 1600.0).abs() < 1e-2, "{bend}");
    }
}
