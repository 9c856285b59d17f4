//! A kind of plugin from outside: heat and salt that diffuse through a fluid, `[tracer.heat-and-salt]`.

use schemars::JsonSchema;
use serde::Deserialize;
use sph_contribution::{
    Contribution, Limiter, Offer, OwnColumn, Refusal, Report, Setting, StepHook, StepPhase,
    contribution_kind,
};
use sph_core::reexport::inventory;
use sph_core::{Access, Evolved, Field, Scalar, StepError, StepLimit, fields, register};
use sph_neighbours::{BoundTerm, FusionEntry, Pair, PairTerm, Rates, Term, There, World, fuse_two};

contribution_kind!(
    /// What diffuses through a fluid.
    pub TracerEntry, "tracer", Any, "what diffuses through the fluid", "none if left out"
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

struct BoundDiffusion<'a> {
    value: &'a [f64],
    twice: f64,
    slot: usize,
}

impl<const D: usize, const K: usize> PairTerm<D> for Diffusion<K> {
    type Bound<'a> = BoundDiffusion<'a>;
    fn name(&self) -> String {
        format!("diffusion of {}", VALUE[K].name)
    }
    fn access(&self) -> Access {
        let access = Access::none().both(VALUE[K]).writes(RATE[K]);
        access.neighbours(fields::VOLUME)
    }
    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Self::Bound<'a>, StepError> {
        Ok(BoundDiffusion {
            value: world.free.get(VALUE[K])?,
            twice: 2.0 * self.0,
            slot: world.slot(RATE[K])?,
        })
    }
}

impl<const D: usize> BoundTerm<D> for BoundDiffusion<'_> {
    type Here = f64;
    type Sum = f64;
    fn here(&self, i: usize) -> f64 {
        self.value[i]
    }
    fn zero(&self) -> f64 {
        0.0
    }
    #[inline(always)]
    fn free(&self, here: &f64, j: usize, there: &There<D>, pair: &Pair<D>, sum: &mut f64) {
        *sum += there.volume * (here - self.value[j]) * pair.factor;
    }
    fn finish(&self, _: &f64, sum: &f64, inverse_gamma: f64, rates: &mut Rates<D>) {
        rates.more[self.slot] += self.twice * sum * inverse_gamma;
    }
}

inventory::submit! {
    FusionEntry {
        terms: 2,
        fuse_2d: fuse_two::<2, Diffusion<0>, Diffusion<1>>,
        fuse_3d: fuse_two::<3, Diffusion<0>, Diffusion<1>>,
    }
}

/// Heat and salt, waves at the start.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct HeatAndSalt {
    /// Diffusivity of heat.
    #[schemars(range(min = 0.0), extend("unit" = "m²/s"))]
    heat: f64,
    /// Diffusivity of salt.
    #[schemars(range(min = 0.0), extend("unit" = "m²/s"))]
    salt: f64,
    /// Bound on the step: Δt ≤ limit · h²/κ.
    #[serde(default = "quarter")]
    limit: f64,
}

fn quarter() -> f64 {
    0.25
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
        offer.term(Term(Diffusion::<0>(self.heat)));
        offer.term(Term(Diffusion::<1>(self.salt)));
        offer.limiter(*self);
        offer.hook(Stirring);
        Ok(())
    }
}

/// No work at all, but something to say at the end.
struct Stirring;

impl<const D: usize> StepHook<D> for Stirring {
    fn name(&self) -> String {
        "stirring".into()
    }
    fn access(&self) -> Access {
        Access::none()
    }
    fn phases(&self) -> &'static [StepPhase] {
        &[]
    }
    fn report(&self, _: &World<D>) -> Report {
        Report {
            advice: vec!["stir it".into()],
            ..Report::default()
        }
    }
}

impl<const D: usize> Limiter<D> for HeatAndSalt {
    fn limit(&self, world: &World<D>) -> Result<StepLimit, StepError> {
        let h = world.kernel.smoothing_length();
        Ok(StepLimit::new(
            "tracer",
            self.limit * h * h / self.heat.max(self.salt),
        ))
    }
    fn formula(&self) -> String {
        "tracer: limit · h²/κ".into()
    }
}

register!(
    TracerEntry [2, 3],
    HeatAndSalt,
    "heat-and-salt",
    "heat and salt",
    "Fick 1855"
);
