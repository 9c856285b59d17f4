//! The Brezzi–Pitkäranta smoother.

use sph_core::{Vect, fields, plugin};
use sph_neighbours::{
    Lane, LanePair, Neighbourhood, Particles, Rates, dot, pair_sum, pair_term, splat,
};

use sph_contribution::{Contribution, Offer, Refusal, Setting};
use sph_rheology::state::Laws;

use crate::diffusion::contract::fastest;
use crate::diffusion::{Accelerated, SmootherEntry, Smoothing};

/// dρ_a/dt += δ (h/c) 2ρ_a/γ_a Σ_b V_b {[2(p_a − p_b) + (ρ_aA_a + ρ_bA_b)·r_ab]/(ρ_a + ρ_b) − g·r_ab} F_ab, free neighbours
/// only.
///
/// Symbols: δ strength; c speed of sound of the fastest phase (m/s); A the [mean acceleration](crate::diffusion::MeanAcceleration) of a
/// particle (m/s²). The source has a step, ΛΔt, in the place of δ h/c: a strength that goes with whatever limits the step. At
/// the sound's limit, Δt = 0.4 h/c, it is δ = 0.4 Λ.
///
/// The bracket vanishes for the pressure that balances gravity and the acceleration of the fluid, ∇p = ρ (g − A): at rest, in
/// a tank that is accelerated or turns, in a fall. Across a density jump it does so for pairs that are mirrored at the
/// interface; on a lattice 7 % of the unbalanced rate is left at a ratio of 2. The thesis prints other signs, with which the
/// term is anti-diffusive (a tank at rest blows up after 0.09 s).
///
/// Limits: where friction or elasticity bears a part of the weight, the bracket is not zero at rest, and pushes the material
/// on. [`DeltaSph`](crate::diffusion::DeltaSph) is the same diffusion less whatever gradient there is: take it for soils.
///
/// Source: Ghaïtanellis 2017, Eq. 2.92–2.95 and 2.99, corrected; A, which is 0 there, is ours.
#[plugin(SmootherEntry [2, 3], "brezzi-pitkaranta", "pressure diffusion with hydrostatic balance",
    source: "Ghaïtanellis 2017, Eq. 2.92–2.99")]
pub struct BrezziPitkaranta {
    /// Strength δ: the diffusivity of the density over h c. The source's 0.04 in most cases, 0.4 for tanks at rest and impacts.
    #[parameter(default: 0.1, unit: "1", min: 0.0, max: 4.0,
        source: "Antuono et al. 2010; Ghaïtanellis 2017, Eq. 2.100: 0.4 Λ")]
    pub strength: f64,
    /// True if the pressure that accelerates the fluid is left alone, as that of gravity is. If left out, so where all
    /// walls move, and where the fluid falls without any.
    #[parameter(default, source: "ours")]
    pub accelerations: Option<bool>,
}

impl<const D: usize> Contribution<D> for BrezziPitkaranta {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let accelerated = *self.accelerations.get_or_insert(setting.carried);
        let smoothing = Smoothing {
            term: Box::new(self.term(setting.laws)),
            strength: self.strength,
            accelerated: accelerated.then_some(Accelerated::Sweep),
            of_pressures: true,
        };
        smoothing.offer(setting, offer);
        Ok(())
    }
}

impl BrezziPitkaranta {
    /// Of this strength.
    pub fn with(strength: f64) -> Self {
        BrezziPitkaranta {
            strength,
            accelerations: None,
        }
    }

    /// Its term for the phases of a scene.
    pub fn term(&self, laws: &Laws) -> PressureDiffusion {
        PressureDiffusion {
            slowness: self.strength / fastest(laws),
            accelerated: self.accelerations == Some(true),
        }
    }
}

/// The term of [`BrezziPitkaranta`] and of [`RhieChow`](crate::diffusion::RhieChow).
#[derive(Clone, Copy, Debug)]
pub struct PressureDiffusion {
    /// δ/c, s/m.
    slowness: f64,
    /// True if the mean accelerations are known.
    accelerated: bool,
}

/// [`PressureDiffusion`] with its columns.
#[pair_term(PressureDiffusion, "Brezzi–Pitkäranta smoother")]
pub struct BoundPressureDiffusion<'a, const D: usize> {
    #[both(fields::PRESSURE)]
    pressure: &'a [f64],
    #[both(fields::DENSITY)]
    density: &'a [f64],
    #[neighbours(fields::VOLUME)]
    volume: &'a [f64],
    #[both(fields::MEAN_ACCELERATION, if self.accelerated)]
    acceleration: Option<&'a [Vect<D>]>,
    #[value(world.gravity)]
    gravity: Vect<D>,
    #[value(2.0 * self.slowness * world.kernel.smoothing_length())]
    weight: f64,
}

#[pair_sum]
impl<const D: usize> BoundPressureDiffusion<'_, D> {
    const SCALED: bool = true;

    /// Pressure, density, ρA.
    fn own<L: Lane>(&self, all: Particles) -> (L, L, [L; D]) {
        let inertia = match self.acceleration {
            Some(a) => all.each(|i| (a[i] * self.density[i]).into()),
            None => [L::splat(0.0); D],
        };
        let density = all.numbers(self.density);
        (all.numbers(self.pressure), density, inertia)
    }

    fn pair<L: Lane>(&self, own: &Self::Own<L>, j: usize, pair: &LanePair<D, L>, sum: &mut L) {
        let (pressure, density) = (L::splat(self.pressure[j]), L::splat(self.density[j]));
        let gravity = splat::<D, L>(&self.gravity);
        let both = own.1 + density;
        let mut bracket =
            L::splat(2.0) * (own.0 - pressure) / both - dot(&gravity, &pair.separation);
        if let Some(acceleration) = self.acceleration {
            let mut inertia = own.2;
            for (own, other) in inertia.iter_mut().zip(&acceleration[j]) {
                *own += density * L::splat(*other);
            }
            bracket += dot(&inertia, &pair.separation) / both;
        }
        *sum += L::splat(self.volume[j]) * bracket * pair.factor;
    }

    fn finish(&self, sum: f64, at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        rates.scalar += self.weight * self.density[at.particle] * sum * at.inverse_renormalisation;
    }
}
