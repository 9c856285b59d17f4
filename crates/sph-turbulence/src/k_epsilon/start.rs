//! k and ε at the start.

use sph_core::parameters;

use super::model::KEpsilonModel;

/// k = u*²/√C_μ (1 − z/H) and ε = u*³/(κz) (1 − z/H): where production balances dissipation in a wide open channel.
///
/// Source: Issa 2004, Eq. 5.33 with 6.24.
#[parameters]
pub struct ChannelStart {
    /// u*.
    #[parameter(unit: "m/s", above: 0.0)]
    pub friction_velocity: f64,
    /// Depth H.
    #[parameter(unit: "m", above: 0.0)]
    pub depth: f64,
    /// Height of the bed.
    #[parameter(default, unit: "m")]
    pub bottom: f64,
}

/// Nearer to bed and surface than this share of the depth, k and ε are those there, so that both are positive.
const LEAST_SHARE: f64 = 1e-3;

impl ChannelStart {
    /// k and ε at a height.
    pub fn at(&self, karman: f64, height: f64) -> [f64; 2] {
        let share = (height - self.bottom) / self.depth;
        let share = share.clamp(LEAST_SHARE, 1.0 - LEAST_SHARE);
        let at_wall = KEpsilonModel::at_wall(self.friction_velocity, share * self.depth, karman);
        at_wall.map(|value| value * (1.0 - share))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Page §3.7: ν_t = κu*z(1 − z/H).
    #[test]
    fn its_eddies_are_those_of_the_channel() {
        let start = ChannelStart {
            friction_velocity: 0.05,
            depth: 0.4,
            bottom: -1.0,
        };
        for z in [0.01, 0.2, 0.39] {
            let [k, e] = start.at(0.41, z - 1.0);
            let exact = 0.41 * 0.05 * z * (1.0 - z / 0.4);
            assert!((KEpsilonModel::eddy_viscosity(k, e) / exact - 1.0).abs() < 1e-12);
        }
        let [k, e] = start.at(0.41, 5.0);
        assert!(k > 0.0 && e > 0.0);
    }
}
