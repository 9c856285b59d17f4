//! The elastic force of a displacement.

use sph_core::{Access, StepError, Symmetric, Vect, fields, plugin};
use sph_neighbours::{
    BoundTerm, Contact, Elements, Interaction, Pair, PairTerm, Rates, Term, There, World,
};
use sph_viscosity::{OnLattice, PairFriction, WithTransposed};

use crate::divergence::Sum;
use crate::{Blend, ElasticForce, ElasticForceEntry, Felt};

/// f_a = min(1, τ_y/|τ|)_a [L^E{𝒢, X} + D{J}]_a: second differences of the displacement instead of a divergence.
///
/// L^E_a = 1/γ_a Σ_b θ_b V_b 𝒢̄_ab F_ab [(d + 2)(X_ab·e)e + X_ab] − 2/γ_a Σ_s 𝒢_a X_a |∇γ_as|/δr_as and
/// D_a = −V_a/γ_a Σ_b θ_b (J_a − J_b)·∇w_ab over the neighbours that are elastic.
///
/// Symbols: X way since the material was last liquid (m), 0 at walls; J = ∫(ωτ − τω)dt what turns have made of its stress
/// (Pa), at walls that of the particle; 𝒢̄ harmonic mean of the shear moduli (Pa), times 1 − ζ where stresses are blended
/// (J as well); δr_as distance from the wall, a spacing at least; τ = ∫(2𝒢D′ + ωτ − τω)dt is not cut.
///
/// The force is capped, not the stress, so that action is not reaction where τ > τ_y, nor in D{J}. A particle that was liquid
/// begins at X = 0 beside neighbours that did not: the step between them is a force of about 𝒢X/δr², which no cap of
/// stresses removes. X is small and turns are few: the operator is not invariant under rotation. div X is not zero in a
/// material that can be compressed, and the volume resists with 2𝒢 in place of 4𝒢/3. Walls must not move.
///
/// Source: Ghaïtanellis 2017, Eq. 4.94–4.101, 4.105 and 4.109–4.114 (4.99 with the sign of 4.69).
///
/// ```toml
/// [elastic-force.displacement]
/// blend = "forces"
/// ```
#[plugin(ElasticForceEntry [2, 3], "displacement",
    "second differences of the displacement since the material was last liquid",
    source: "Ghaïtanellis 2017, Eq. 4.94–4.101")]
#[derive(Copy)]
pub struct Displacement {
    /// What is blended where a soil yields.
    #[parameter(default, source: "Ghaïtanellis 2017, Eq. 4.104 (forces), 4.105 (stresses)")]
    pub blend: Blend,
    /// Scale of the operator on a lattice.
    #[parameter(default, source: "ours; literal: as printed")]
    pub on_lattice: OnLattice,
}

impl<const D: usize> ElasticForce<D> for Displacement {
    fn term(&self, felt: &Felt) -> Box<dyn Interaction<D>> {
        let moduli = felt.laws.iter();
        let moduli = moduli.map(|law| law.elastic().map_or(0.0, |e| e.shear_modulus()));
        Box::new(Term(DisplacementForce {
            moduli: moduli.collect(),
            choice: *self,
        }))
    }
    fn blend(&self) -> Blend {
        self.blend
    }
    fn displaced(&self) -> bool {
        true
    }
    /// Second differences are stiffer than nested first ones: h²λ is 12 at most, and not 2.7.
    fn stiffness(&self) -> f64 {
        4.0 / 3.0 * 12.0 / 2.7
    }
}

/// [`Displacement`] as a term.
#[derive(Clone, Debug)]
pub struct DisplacementForce {
    /// 𝒢 of every phase, Pa; 0 where it is not elastic.
    moduli: Vec<f64>,
    choice: Displacement,
}

impl<const D: usize> PairTerm<D> for DisplacementForce {
    type Bound<'a> = Bound<'a, D>;

    fn name(&self) -> String {
        "elastic force of the displacement".into()
    }

    fn access(&self) -> Access {
        let access = Access::none()
            .both(fields::ELASTIC_DISPLACEMENT)
            .both(fields::ELASTIC_TURN)
            .both(fields::SOLID_SHARE)
            .both(fields::VOLUME)
            .here(fields::HELD_SHARE)
            .here(fields::MASS);
        match self.moduli.len() {
            1 => access,
            _ => access.both(fields::PHASE),
        }
    }

    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Bound<'a, D>, StepError> {
        let phase = match self.moduli.len() {
            1 => None,
            _ => Some(world.free.get(fields::PHASE)?),
        };
        let shares = world.free.get(fields::SOLID_SHARE)?.iter().enumerate();
        let solids = shares.map(|(i, share)| Solid {
            modulus: self.moduli[phase.map_or(0, |p| p[i] as usize)],
            share: match self.choice.blend {
                Blend::Stresses => *share,
                Blend::Forces => 1.0,
            },
        });
        let points = &world.walls.points;
        Ok(Bound {
            solids: solids.collect(),
            displacement: world.free.get(fields::ELASTIC_DISPLACEMENT)?,
            turn: world.free.get(fields::ELASTIC_TURN)?,
            held: world.free.get(fields::HELD_SHARE)?,
            volume: world.free.get(fields::VOLUME)?,
            mass: world.free.get(fields::MASS)?,
            wall_volume: &points.volume,
            wall_share: &points.share,
            wall_grip: &points.grip,
            elements: &world.walls.elements,
            scale: self.choice.on_lattice.scale(WithTransposed, world),
            spacing: world.spacing,
        })
    }
}

/// What of a particle is elastic.
#[derive(Clone, Copy)]
struct Solid {
    /// 𝒢, Pa.
    modulus: f64,
    /// Share that acts in the sums.
    share: f64,
}

impl Solid {
    fn stiffness(self) -> f64 {
        self.modulus * self.share
    }

    /// 𝒢̄, Pa.
    fn mean(self, other: Solid) -> f64 {
        let (a, b) = (self.stiffness(), other.stiffness());
        match a > 0.0 && b > 0.0 {
            true => 2.0 * a * b / (a + b),
            false => 0.0,
        }
    }
}

/// [`DisplacementForce`] with its columns.
pub struct Bound<'a, const D: usize> {
    solids: Vec<Solid>,
    displacement: &'a [Vect<D>],
    turn: &'a [Symmetric],
    held: &'a [f64],
    volume: &'a [f64],
    mass: &'a [f64],
    wall_volume: &'a [f64],
    wall_share: &'a [f64],
    wall_grip: &'a [f64],
    elements: &'a Elements<D>,
    /// Of the operator.
    scale: f64,
    spacing: f64,
}

/// The particle's own values.
#[derive(Clone, Copy)]
pub struct Here<const D: usize> {
    solid: Solid,
    displacement: Vect<D>,
    turn: Symmetric,
    volume: f64,
    /// Force density to acceleration.
    factor: f64,
}

impl<const D: usize> BoundTerm<D> for Bound<'_, D> {
    type Here = Here<D>;
    type Sum = Sum<D>;

    #[inline(always)]
    fn here(&self, i: usize) -> Here<D> {
        let solid = self.solids[i];
        Here {
            solid,
            displacement: self.displacement[i],
            turn: self.turn[i] * solid.share,
            volume: self.volume[i],
            factor: self.held[i] * self.volume[i] / self.mass[i],
        }
    }

    #[inline(always)]
    fn zero(&self) -> Sum<D> {
        Sum::zero()
    }

    #[inline(always)]
    fn free(&self, here: &Here<D>, j: usize, there: &There<D>, pair: &Pair<D>, sum: &mut Sum<D>) {
        let solid = self.solids[j];
        if here.solid.modulus == 0.0 || solid.modulus == 0.0 {
            return;
        }
        let apart = here.displacement - self.displacement[j];
        let force = WithTransposed.force(here.volume, there.volume, &apart, pair);
        let turned = here.turn - self.turn[j] * solid.share;
        sum.force += force * (self.scale * here.solid.mean(solid))
            - turned.apply(&pair.separation) * (here.volume * pair.factor);
    }

    #[inline(always)]
    fn wall(&self, here: &Here<D>, v: usize, pair: &Pair<D>, sum: &mut Sum<D>) {
        let apart = &here.displacement;
        let force = WithTransposed.force(here.volume, self.wall_volume[v], apart, pair);
        let rubbing = self.wall_share[v] * self.wall_grip[v];
        sum.force += force * (rubbing * self.scale * here.solid.stiffness());
    }

    #[inline(always)]
    fn element(&self, here: &Here<D>, contact: &Contact<D>, sum: &mut Sum<D>) {
        let grip = self.elements.grip[contact.element as usize];
        let gradient = contact.gradient.norm();
        let stiffness = self.scale * here.solid.stiffness() * grip;
        let distance = contact.distance.max(self.spacing);
        sum.force -= here.displacement * (2.0 * stiffness * gradient / distance);
        sum.normal += contact.gradient * (1.0 - grip);
        sum.rubbing += gradient * grip;
    }

    #[inline(always)]
    fn finish(&self, here: &Here<D>, sum: &Sum<D>, inverse_gamma: f64, rates: &mut Rates<D>) {
        rates.acceleration += sum.completed(inverse_gamma) * here.factor;
    }
}
