//! Morris's viscous operator with the wall term of Ghaïtanellis (2017).

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{Access, StepError, Vect, fields, register};
use sph_neighbours::{
    BoundTerm, Contact, Elements, Interaction, Pair, PairTerm, Rates, Term, There, World,
};

use crate::viscosity::BoundViscosity;
use crate::{
    PerParticle, Uniform, Viscosity, ViscositySource, ViscousOperator, ViscousOperatorEntry,
};

/// L_a = 2/γ_a Σ_b θ_b V_b η̄_ab u_ab F_ab − 2/γ_a Σ_s η_a u_t,as/δr_as |∇γ_as|.
///
/// η̄ is the harmonic mean, u_t the tangential velocity relative to the wall, and
/// δr_as = max((r_a − r_s)·n_s, δr). Conserves linear momentum, not angular momentum.
/// Explicitly stable for νΔt/h² ≤ 0.29 (h = 2δr, lattice).
///
/// Source: Ghaïtanellis 2017, Eq. 3.29–3.30 and 2.83–2.89.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Morris {}

impl<const D: usize> ViscousOperator<D> for Morris {
    fn term(&self, viscosity: Viscosity) -> Box<dyn Interaction<D>> {
        match viscosity {
            Viscosity::Uniform(eta) => Box::new(Term(MorrisTerm(Uniform(eta)))),
            Viscosity::PerParticle => Box::new(Term(MorrisTerm(PerParticle))),
        }
    }
    fn stiffness(&self) -> f64 {
        1.0
    }
}

register!(
    ViscousOperatorEntry [2, 3],
    Morris,
    "morris",
    "div(η grad u) by first differences of velocity; cheap and robust",
    "Ghaïtanellis 2017, Eq. 3.29; Morris et al. 1997"
);

/// The term of [`Morris`].
pub struct MorrisTerm<S>(pub S);

impl<const D: usize, S: ViscositySource> PairTerm<D> for MorrisTerm<S> {
    type Bound<'a> = Bound<'a, D, S::Bound<'a>>;

    fn name(&self) -> String {
        "Morris viscosity".into()
    }

    fn access(&self) -> Access {
        Access::none()
            .both(fields::VELOCITY)
            .neighbours(fields::VOLUME)
            .here(fields::DENSITY)
            .and(self.0.access())
    }

    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Self::Bound<'a>, StepError> {
        let points = &world.walls.points;
        Ok(Bound {
            velocity: world.free.get(fields::VELOCITY)?,
            density: world.free.get(fields::DENSITY)?,
            viscosity: self.0.bind(world)?,
            wall_velocity: &points.viscous_velocity,
            wall_volume: &points.volume,
            wall_share: &points.share,
            wall_grip: &points.grip,
            elements: &world.walls.elements,
            spacing: world.spacing,
        })
    }
}

/// [`MorrisTerm`] with its columns.
pub struct Bound<'a, const D: usize, S> {
    velocity: &'a [Vect<D>],
    density: &'a [f64],
    viscosity: S,
    wall_velocity: &'a [Vect<D>],
    wall_volume: &'a [f64],
    wall_share: &'a [f64],
    wall_grip: &'a [f64],
    elements: &'a Elements<D>,
    spacing: f64,
}

impl<const D: usize, S: BoundViscosity> BoundTerm<D> for Bound<'_, D, S> {
    type Here = (Vect<D>, f64, f64);
    type Sum = Vect<D>;

    #[inline(always)]
    fn here(&self, i: usize) -> Self::Here {
        (
            self.velocity[i],
            self.viscosity.at(i),
            1.0 / self.density[i],
        )
    }

    #[inline(always)]
    fn zero(&self) -> Vect<D> {
        Vect::zeros()
    }

    #[inline(always)]
    fn free(
        &self,
        here: &Self::Here,
        j: usize,
        there: &There<D>,
        pair: &Pair<D>,
        sum: &mut Vect<D>,
    ) {
        let weight = there.volume * self.viscosity.mean(here.1, j) * pair.factor;
        *sum += (here.0 - there.velocity) * weight;
    }

    #[inline(always)]
    fn wall(&self, here: &Self::Here, v: usize, pair: &Pair<D>, sum: &mut Vect<D>) {
        let volume = self.wall_share[v] * self.wall_volume[v] * self.wall_grip[v];
        *sum += (here.0 - self.wall_velocity[v]) * (volume * here.1 * pair.factor);
    }

    #[inline(always)]
    fn element(&self, here: &Self::Here, contact: &Contact<D>, sum: &mut Vect<D>) {
        let s = contact.element as usize;
        let normal = &self.elements.normal[s];
        let relative = here.0 - self.elements.velocity[s];
        let tangential = relative - normal * relative.dot(normal);
        let distance = contact.distance.max(self.spacing);
        let weight = self.elements.grip[s] * here.1 * contact.gradient.norm() / distance;
        *sum -= tangential * weight;
    }

    #[inline(always)]
    fn finish(&self, here: &Self::Here, sum: &Vect<D>, inverse_gamma: f64, rates: &mut Rates<D>) {
        rates.acceleration += sum * (2.0 * here.2 * inverse_gamma);
    }
}
