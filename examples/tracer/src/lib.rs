//! A kind of plugin from outside: heat and salt that diffuse through a fluid, `[tracer.heat-and-salt]`.

use sph_contribution::{
    Contribution, Limiter, Offer, OwnColumn, Refusal, Report, Setting, contribution_kind,
};
use sph_core::{Access, Evolved, Field, Scalar, StepError, StepLimit};
use sph_neighbours::World;
use sph_neighbours::prelude::*;

contribution_kind!(
    /// What diffuses through a fluid.
    pub TracerEntry, "tracer", Any, "what diffuses through the fluid"
);

const VALUE: [Field<Scalar>; 2] = [
    Field::new(
        "temperature",
        "K",
        "temperature over that of the surroundings",
    ),
    Field::new("salinity", "g/kg", "salt over mass"),
];
const RATE: [Field<Scalar>; 2] = [
    Field::new("temperature_rate", "K/s", "rate of the temperature"),
    Field::new("salinity_rate", "g/(kg s)", "rate of the salinity"),
];

/// dA/dt = 2κ Σ_b V_b (A_a − A_b) F_ab of the scalar number K (Morris 1997, for a scalar).
struct Diffusion<const K: usize>(f64);

#[pair_term(Diffusion<K>, format!("diffusion of {}", VALUE[K].name))]
struct BoundDiffusion<'a, const K: usize> {
    #[both(VALUE[K])]
    value: &'a [f64],
    #[neighbours(fields::VOLUME)]
    volume: &'a [f64],
    #[value(2.0 * self.0)]
    twice: f64,
    #[rate(RATE[K])]
    slot: usize,
}

#[pair_sum]
impl<const D: usize, const K: usize> BoundDiffusion<'_, K> {
    fn own<L: Lane>(&self, all: Particles) -> L {
        all.numbers(self.value)
    }
    fn pair<L: Lane>(&self, own: &L, j: usize, pair: &LanePair<D, L>, sum: &mut L) {
        *sum += L::splat(self.volume[j]) * (*own - L::splat(self.value[j])) * pair.factor;
    }
    fn finish(&self, sum: f64, at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        rates.more[self.slot] += self.twice * sum * at.inverse_renormalisation;
    }
}

/// Heat and salt, waves at the start.
#[plugin(TracerEntry [2, 3], "heat-and-salt", "heat and salt", source: "Fick 1855")]
struct HeatAndSalt {
    /// Diffusivity of heat.
    #[parameter(unit: "m²/s", min: 0.0)]
    heat: f64,
    /// Diffusivity of salt.
    #[parameter(unit: "m²/s", min: 0.0)]
    salt: f64,
    /// Bound on the step: Δt ≤ limit · h²/κ.
    #[parameter(default: 0.25)]
    limit: f64,
}

impl<const D: usize> Contribution<D> for HeatAndSalt {
    fn columns(&self) -> Vec<OwnColumn<D>> {
        let wave = |x: f64| (std::f64::consts::TAU * x).cos();
        vec![
            OwnColumn::scalar(VALUE[0], move |birth| wave(birth.position[0])),
            OwnColumn::scalar(VALUE[1], move |birth| 35.0 * wave(birth.position[1])),
        ]
    }
    fn offer(&mut self, _: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let both = VALUE.into_iter().zip(RATE);
        let both = both.map(|(value, rate)| Evolved { value, rate });
        offer.transported.extend(both);
        offer.term(Diffusion::<0>(self.heat));
        offer.term(Diffusion::<1>(self.salt));
        offer.limiter(*self);
        offer.report(Access::none(), |_| Report::advice("stir it"));
        Ok(())
    }
}

impl<const D: usize> Limiter<D> for HeatAndSalt {
    fn limit(&self, world: &World<D>) -> Result<StepLimit, StepError> {
        let h = world.kernel.smoothing_length();
        let dt = self.limit * h * h / self.heat.max(self.salt);
        Ok(StepLimit::new("tracer", dt))
    }
    fn formula(&self) -> String {
        "tracer: limit · h²/κ".into()
    }
}
