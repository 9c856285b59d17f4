//! Grains that pass between particles.

use sph_core::{Access, StepError, fields};
use sph_neighbours::{Around, Neighbourhood, Values, World, walk};

use super::settling::HinderedSettling;
use crate::pores::PhaseMask;

/// Volume of grains that passes down from the upper of two particles per time, over their coupling 2 V_aV_b |F_ab|, m²/s·1:
///
/// min(demand above, supply below) Δz + D B(wΔz/D) (C above − C below), B(P) = P/(e^P − 1)
///
/// with Godunov's flux of grains that settle, and eddies that mix. Dilute grains have none where C ∝ exp(−wz/D), whatever
/// the places of the particles.
///
/// `drop` is the height Δz between the two, m, `diffusivity` D in m²/s, of two particles the logarithmic mean. Source: Scharfetter and Gummel 1969 for dilute grains;
/// the sum with Godunov's flux is ours.
pub fn pair_flux(
    settling: &HinderedSettling,
    [above, below]: [Carried; 2],
    drop: f64,
    diffusivity: f64,
) -> f64 {
    let settled = above.demand.min(below.supply) * drop;
    let peclet = settling.speed * drop / diffusivity;
    let mixing = match diffusivity > 0.0 {
        true if peclet > 0.0 => diffusivity * peclet / peclet.exp_m1(),
        true => diffusivity,
        false => 0.0,
    };
    settled + mixing * (above.concentration - below.concentration)
}

/// (b − a)/ln(b/a), the logarithmic mean of two diffusivities, m²/s: Δz over it is ∫dz/D where D is linear between them, as
/// near a wall, and C ∝ D^(−w/D') is in balance. Zero if one of them is.
fn log_mean(a: f64, b: f64) -> f64 {
    let (least, most) = (a.min(b), a.max(b));
    if least <= 0.0 || least == most {
        return least.max(0.0);
    }
    (most - least) / ((most - least) / least).ln_1p()
}

/// Grains of a particle, as others see them.
#[derive(Clone, Copy, Debug, Default)]
pub struct Carried {
    /// C.
    pub concentration: f64,
    /// The flux that they send down, m/s.
    pub demand: f64,
    /// The flux that they let in from above, m/s.
    pub supply: f64,
}

impl Carried {
    /// Those of a concentration.
    pub fn new(settling: &HinderedSettling, concentration: f64) -> Self {
        Carried {
            concentration,
            demand: settling.demand(concentration),
            supply: settling.supply(concentration),
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Transport {
    pub settling: HinderedSettling,
    /// Diffusivity without eddies, m²/s.
    pub diffusivity: f64,
    /// Viscosity of the eddies over the diffusivity of the grains; none without eddies.
    pub schmidt: Option<f64>,
    pub phase: PhaseMask,
    /// Reference density of the fluid, kg/m³.
    pub density: f64,
}

impl Transport {
    /// The columns that a step of grains reads and writes.
    pub fn access(&self) -> Access {
        let of_eddies = (fields::EDDY_VISCOSITY, fields::DENSITY);
        Access::none()
            .both((fields::POSITION, fields::CONCENTRATION, fields::VOLUME))
            .here(fields::MASS)
            .where_there(fields::RENORMALISATION)
            .remembers(fields::CONCENTRATION)
            .both(self.schmidt.map(|_| of_eddies))
            .both(self.phase.column())
    }

    /// D of a particle, m²/s.
    pub fn mixing<const D: usize>(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let Some(schmidt) = self.schmidt else {
            return Ok(vec![self.diffusivity; world.free.len()]);
        };
        let eddies = world.free.get(fields::EDDY_VISCOSITY)?.iter();
        let both = eddies.zip(world.free.get(fields::DENSITY)?);
        Ok(both
            .map(|(eddies, density)| self.diffusivity + eddies / (density * schmidt))
            .collect())
    }

    /// Concentrations after a step of `dt` seconds: C_a − Δt/V⁰_a Σ_b Φ_ab with V⁰ = m/ρ₀ and Φ_ab = −Φ_ba.
    pub fn step<const D: usize>(&self, world: &World<D>, dt: f64) -> Result<Vec<f64>, StepError> {
        let (concentration, volume) = world.free.all((fields::CONCENTRATION, fields::VOLUME))?;
        let mass = world.free.get(fields::MASS)?;
        let mixing = self.mixing(world)?;
        let carries = self.phase.test(world)?;
        let inverse = world.free.get(fields::RENORMALISATION).ok();
        let inverse = |i: usize| inverse.map_or(1.0, |gamma| 1.0 / gamma[i]);
        let carried = |c: &f64| Carried::new(&self.settling, *c);
        let grains: Vec<Carried> = concentration.iter().map(carried).collect();
        let gravity = world.gravity.norm();
        let down = world.gravity * if gravity > 0.0 { 1.0 / gravity } else { 0.0 };
        let leaving = |at: &Neighbourhood<'_, D>| -> f64 {
            let a = at.particle;
            let one = |(b, pair): (usize, sph_neighbours::Pair<D>)| {
                let none = grains[a].concentration == 0.0 && grains[b].concentration == 0.0;
                if none || !carries(b) {
                    return 0.0;
                }
                let drop = -pair.separation.dot(&down);
                let both = match drop >= 0.0 {
                    true => [grains[a], grains[b]],
                    false => [grains[b], grains[a]],
                };
                let diffusivity = log_mean(mixing[a], mixing[b]);
                let flux = pair_flux(&self.settling, both, drop.abs(), diffusivity);
                // 2 V_aV_b |F_ab| (1/γ_a + 1/γ_b)/2.
                let coupling = volume[a] * volume[b] * -pair.factor * (inverse(a) + inverse(b));
                coupling * if drop >= 0.0 { flux } else { -flux }
            };
            at.free.pairs().map(one).sum()
        };
        let next = |around: &Around<'_, D>| {
            let a = around.rows.particle;
            match carries(a) {
                true => concentration[a] - dt * self.density / mass[a] * leaving(&around.rows),
                false => 0.0,
            }
        };
        walk(world, Values::Gradient, next)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SETTLING: HinderedSettling = HinderedSettling {
        speed: 0.02,
        exponent: 0.0,
        packing: 0.6,
    };

    /// Grains at C ∝ exp(−wz/D) do not move, for any drop; those at rest side by side even out.
    #[test]
    fn settling_and_mixing_balance_exactly() {
        for (drop, mixing) in [(0.01, 1e-3), (0.03, 2e-4), (0.0, 1e-3)] {
            let above = 1e-3;
            let below = above * (SETTLING.speed * drop / mixing).exp();
            let both = [above, below].map(|c| Carried::new(&SETTLING, c));
            let flux = pair_flux(&SETTLING, both, drop, mixing);
            assert!(flux.abs() < 1e-15 * SETTLING.speed, "{drop}: {flux:e}");
        }
        let both = [0.2, 0.1].map(|c| Carried::new(&SETTLING, c));
        assert!((pair_flux(&SETTLING, both, 0.0, 1e-3) - 1e-4).abs() < 1e-18);
        assert_eq!(pair_flux(&SETTLING, both, 0.01, 0.0), 0.2 * 0.02 * 0.01);
    }

    /// Rouse's profile C ∝ z^(−Z), where D = κu*z, does not move, for any two heights.
    #[test]
    fn settling_and_mixing_by_a_wall_balance_exactly() {
        let shear = 0.41 * 0.05;
        for (lower, upper) in [(0.005, 0.015), (0.01, 0.0100001), (0.001, 0.1)] {
            let concentration = |z: f64| 1e-6 * z.powf(-SETTLING.speed / shear);
            let both = [upper, lower].map(|z| Carried::new(&SETTLING, concentration(z)));
            let mixing = log_mean(shear * lower, shear * upper);
            let flux = pair_flux(&SETTLING, both, upper - lower, mixing);
            let settled = both[0].demand * (upper - lower);
            assert!(flux.abs() < 1e-9 * settled, "{lower} {upper}: {flux:e}");
        }
        assert_eq!(log_mean(2.0, 2.0), 2.0);
        assert_eq!(log_mean(0.0, 2.0), 0.0);
        assert_eq!(log_mean(1.0, 3.0), log_mean(3.0, 1.0));
    }
}
