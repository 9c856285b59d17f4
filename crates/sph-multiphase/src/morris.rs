//! Morris's viscous operator with the wall term of Ghaïtanellis (2017).

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{Access, StepError, Vect, fields, register};
use sph_neighbours::{
    BoundTerm, Contact, Contacts, Elements, Interaction, Pair, PairTerm, Rates, Term, There, World,
};

use crate::viscosity::BoundViscosity;
use crate::{
    PerParticle, Uniform, Viscosity, ViscositySource, ViscousOperator, ViscousOperatorEntry,
};

/// L_a = 2/γ_a Σ_b θ_b V_b η̄_ab u_ab F_ab − 2κ_a/γ_a Σ_s η_a u_t,as/δr_as |∇γ_as|.
///
/// η̄ is the harmonic mean, u_t the tangential velocity relative to the wall, and
/// δr_as = max((r_a − r_s)·n_s, δr) + λ_s with the slip length λ_s of the wall. Conserves linear
/// momentum, not angular momentum. Explicitly stable for νΔt/h² ≤ 0.29 (h = 2δr, lattice).
///
/// # The wall term
/// For a linear velocity the sum over particles is 2u' Σ_b θ_b V_b F_ab r_ab, and the wall term
/// 2u' ∇γ_a: they cancel as far as the sum is −∇γ_a, which it is to 2 % in the first row of a
/// lattice. The rest, ε u'/h, shifts the wall by ε δr: the literal term is of first order. The
/// corrected one scales the wall's flux by κ_a = Σ θ V F r·G/|G|² with G = ∇γ_a, so that linear
/// velocities are exact whatever the arrangement of the particles; κ = 1 in the literal one.
/// On a curved wall the plane of an element some way off is farther than the wall: the corrected
/// term takes d/(n_s·n) with the distance d and the normal n of the nearest element for δr_as where
/// n_s·n > 0.7, and not less than δr/2; the literal one the height over each plane and not less
/// than δr.
///
/// Source: Ghaïtanellis 2017, Eq. 3.29–3.30 and 2.83–2.89.
///
/// ```toml
/// [viscous-operator.morris]
/// wall_term = "corrected"
/// ```
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Morris {
    /// Friction at walls.
    #[schemars(extend("source" = "Ghaïtanellis 2017, Eq. 2.83–2.89"))]
    pub wall_term: WallTerm,
}

/// Friction at semi-analytical walls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, serde::Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum WallTerm {
    /// Exact for linear velocities.
    #[default]
    Corrected,
    /// As printed: first order.
    Literal,
}

impl<const D: usize> ViscousOperator<D> for Morris {
    fn term(&self, viscosity: Viscosity) -> Box<dyn Interaction<D>> {
        let wall = self.wall_term;
        match viscosity {
            Viscosity::Uniform(eta) => Box::new(Term(MorrisTerm(Uniform(eta), wall))),
            Viscosity::PerParticle => Box::new(Term(MorrisTerm(PerParticle, wall))),
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
pub struct MorrisTerm<S>(pub S, pub WallTerm);

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
            wall_slip: &points.slip,
            elements: &world.walls.elements,
            contacts: &world.walls.contacts,
            corrected: self.1 == WallTerm::Corrected,
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
    wall_slip: &'a [(f64, Vect<D>)],
    elements: &'a Elements<D>,
    contacts: &'a Contacts<D>,
    corrected: bool,
    spacing: f64,
}

/// The particle's own values.
#[derive(Clone, Copy)]
pub struct Here<const D: usize> {
    velocity: Vect<D>,
    viscosity: f64,
    specific_volume: f64,
    /// Normal and distance of the nearest element, where the wall term is to be corrected.
    nearest: Option<(Vect<D>, f64)>,
}

/// Sums of one particle.
#[derive(Clone, Copy)]
pub struct Sum<const D: usize> {
    /// Σ θ V η̄ u_ab F.
    force: Vect<D>,
    /// Σ θ V F r_ab.
    discrete: Vect<D>,
    /// Σ η u_t/δr |∇γ_as|.
    flux: Vect<D>,
    /// Σ ∇γ_as.
    gradient: Vect<D>,
}

/// κ is left at 1 where |∇γ| δr is below this: opposite walls, or the edge of the support.
const FAINT: f64 = 1e-3;
/// Elements whose normals differ by less than 45° are one smooth wall.
const ONE_WALL: f64 = 0.7;
/// Least distance from a wall over the spacing, for stability.
const LEAST_DISTANCE: f64 = 0.5;
/// Bounds of κ.
const BOUNDS: [f64; 2] = [0.0, 4.0];

impl<const D: usize, S> Bound<'_, D, S> {
    /// Normal and distance of the element with the largest mean kernel, the nearest one.
    #[inline(always)]
    fn nearest(&self, i: usize) -> Option<(Vect<D>, f64)> {
        if !self.corrected {
            return None;
        }
        let mean = |c: &Contact<D>| {
            let measure = self.elements.measure[c.element as usize];
            c.gradient.norm_squared() / (measure * measure)
        };
        let mut nearest = None;
        let mut largest = 0.0;
        for contact in self.contacts.of(i) {
            let mean = mean(contact);
            if mean > largest {
                largest = mean;
                nearest = Some(contact);
            }
        }
        nearest.map(|c| (self.elements.normal[c.element as usize], c.distance))
    }

    /// Over which the velocity falls to that of an element.
    #[inline(always)]
    fn distance(&self, here: &Here<D>, contact: &Contact<D>, normal: &Vect<D>) -> f64 {
        let Some((nearest, distance)) = &here.nearest else {
            return contact.distance.max(self.spacing);
        };
        let cosine = normal.dot(nearest);
        let distance = match cosine > ONE_WALL {
            true => distance / cosine,
            false => contact.distance,
        };
        distance.max(LEAST_DISTANCE * self.spacing)
    }
}

impl<const D: usize, S: BoundViscosity> BoundTerm<D> for Bound<'_, D, S> {
    type Here = Here<D>;
    type Sum = Sum<D>;

    #[inline(always)]
    fn here(&self, i: usize) -> Here<D> {
        Here {
            velocity: self.velocity[i],
            viscosity: self.viscosity.at(i),
            specific_volume: 1.0 / self.density[i],
            nearest: self.nearest(i),
        }
    }

    #[inline(always)]
    fn zero(&self) -> Sum<D> {
        Sum {
            force: Vect::zeros(),
            discrete: Vect::zeros(),
            flux: Vect::zeros(),
            gradient: Vect::zeros(),
        }
    }

    #[inline(always)]
    fn free(&self, here: &Here<D>, j: usize, there: &There<D>, pair: &Pair<D>, sum: &mut Sum<D>) {
        let volume = there.volume * pair.factor;
        sum.force +=
            (here.velocity - there.velocity) * (volume * self.viscosity.mean(here.viscosity, j));
        if here.nearest.is_some() {
            sum.discrete += pair.separation * volume;
        }
    }

    #[inline(always)]
    fn wall(&self, here: &Here<D>, v: usize, pair: &Pair<D>, sum: &mut Sum<D>) {
        let volume = self.wall_share[v] * self.wall_volume[v] * pair.factor;
        let mut rubbing = volume * self.wall_grip[v];
        if let Some((slip, normal)) = self.wall_slip.get(v) {
            // At the wall the fluid goes with the share λ/(d + λ) of the velocity at d.
            let distance = pair.separation.dot(normal).max(self.spacing);
            rubbing *= distance / (distance + slip);
        }
        sum.force += (here.velocity - self.wall_velocity[v]) * (rubbing * here.viscosity);
        sum.discrete += pair.separation * volume;
    }

    #[inline(always)]
    fn element(&self, here: &Here<D>, contact: &Contact<D>, sum: &mut Sum<D>) {
        let s = contact.element as usize;
        let normal = &self.elements.normal[s];
        let relative = here.velocity - self.elements.velocity[s];
        let tangential = relative - normal * relative.dot(normal);
        let slip = self.elements.slip.get(s).copied().unwrap_or(0.0);
        let distance = self.distance(here, contact, normal) + slip;
        let weight = self.elements.grip[s] * here.viscosity * contact.gradient.norm() / distance;
        sum.flux += tangential * weight;
        sum.gradient += contact.gradient;
    }

    #[inline(always)]
    fn finish(&self, here: &Here<D>, sum: &Sum<D>, inverse_gamma: f64, rates: &mut Rates<D>) {
        let mut correction = 1.0;
        let squared = sum.gradient.norm_squared();
        if here.nearest.is_some() && squared * self.spacing * self.spacing > FAINT * FAINT {
            correction = (sum.discrete.dot(&sum.gradient) / squared).clamp(BOUNDS[0], BOUNDS[1]);
        }
        let total = sum.force - sum.flux * correction;
        rates.acceleration += total * (2.0 * here.specific_volume * inverse_gamma);
    }
}
