//! The elastic force of a displacement.

use sph_core::{Symmetric, Vect, fields, plugin};
use sph_multiphase::viscosity::{EspanolRevenga, OnLattice, PairFriction};
use sph_neighbours::{
    Interaction, Lane, LanePair, Neighbourhood, Particles, Rates, WallSet, dot, minus, pair_sum,
    pair_term,
};

use crate::stress::divergence::Sum;
use crate::stress::{Blend, ElasticForce, ElasticForceEntry, LawInputs};

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
    source: "Ghaïtanellis 2017, Eq. 4.94–4.101", cfg(not(test)))]
#[derive(Copy)]
pub struct Displacement {
    /// Blended quantities where a soil yields.
    #[parameter(default, source: "Ghaïtanellis 2017, Eq. 4.104 (forces), 4.105 (stresses)")]
    pub blend: Blend,
    /// Scale of the operator on a lattice.
    #[parameter(default, source: "ours; literal: as printed")]
    pub on_lattice: OnLattice,
}

impl<const D: usize> ElasticForce<D> for Displacement {
    fn term(&self, law_inputs: &LawInputs) -> Box<dyn Interaction<D>> {
        let moduli = law_inputs.laws.iter();
        let moduli = moduli.map(|law| law.elastic().map_or(0.0, |e| e.shear_modulus()));
        Box::new(DisplacementForce {
            moduli: moduli.collect(),
            choice: *self,
        })
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

/// [`DisplacementForce`] with its columns.
#[pair_term(DisplacementForce, "elastic force of the displacement")]
pub struct BoundDisplacement<'a, const D: usize> {
    #[value(&self.moduli)]
    moduli: &'a [f64],
    #[value(self.choice.blend)]
    blend: Blend,
    #[both(fields::PHASE, if self.moduli.len() > 1)]
    phase: Option<&'a [u32]>,
    #[both(fields::SOLID_FRACTION)]
    share: &'a [f64],
    #[both(fields::ELASTIC_DISPLACEMENT)]
    displacement: &'a [Vect<D>],
    #[both(fields::STRESS_ROTATION)]
    turn: &'a [Symmetric],
    #[here(fields::YIELD_FACTOR)]
    held: &'a [f64],
    #[both(fields::VOLUME)]
    volume: &'a [f64],
    #[here(fields::MASS)]
    mass: &'a [f64],
    #[value(&world.walls)]
    walls: &'a WallSet<D>,
    #[value(self.choice.on_lattice.scale(EspanolRevenga::default(), world))]
    scale: f64,
    #[value(world.spacing)]
    spacing: f64,
}

/// The own values of a particle.
#[derive(Clone, Copy)]
pub struct Own<const D: usize, L> {
    modulus: L,
    stiffness: L,
    displacement: [L; D],
    turn: [L; 6],
    volume: L,
}

#[pair_sum]
impl<const D: usize> BoundDisplacement<'_, D> {
    /// 𝒢 of a particle, Pa, and the share of it that acts in the sums.
    fn solid(&self, i: usize) -> [f64; 2] {
        let share = match self.blend {
            Blend::Stresses => self.share[i],
            Blend::Forces => 1.0,
        };
        [self.moduli[self.phase.map_or(0, |p| p[i] as usize)], share]
    }

    fn own<L: Lane>(&self, all: Particles) -> Own<D, L> {
        let [modulus, stiffness] = all.each(|i| {
            let [modulus, share] = self.solid(i);
            [modulus, modulus * share]
        });
        Own {
            modulus,
            stiffness,
            displacement: all.vectors(self.displacement),
            turn: all.each(|i| (self.turn[i] * self.solid(i)[1]).0),
            volume: all.numbers(self.volume),
        }
    }

    fn pair<L: Lane>(&self, own: &Own<D, L>, j: usize, pair: &LanePair<D, L>, sum: &mut [L; D]) {
        let [modulus, share] = self.solid(j);
        let zero = L::splat(0.0);
        if modulus == 0.0 || !zero.any_less(own.modulus) {
            return;
        }
        let there = L::splat(modulus * share);
        // The harmonic mean, 0 if either is.
        let mean = L::splat(2.0) * own.stiffness * there / (own.stiffness + there);
        let mean = own
            .stiffness
            .where_positive(there.where_positive(mean, zero), zero);
        let apart = minus(&own.displacement, &self.displacement[j]);
        let volume = L::splat(self.volume[j]);
        let force = EspanolRevenga::default().forces(own.volume, volume, &apart, pair);
        let turn = self.turn[j] * share;
        for (k, (sum, force)) in sum.iter_mut().zip(force).enumerate() {
            let mut turned = [zero; D];
            for (turned, place) in turned.iter_mut().zip(Symmetric::PLACE[k]) {
                *turned = own.turn[place] - L::splat(turn.0[place]);
            }
            let turned = dot(&turned, &pair.separation) * (own.volume * pair.factor);
            let force = force * (L::splat(self.scale) * mean) - turned;
            *sum += own.modulus.where_positive(force, zero);
        }
    }

    fn finish(&self, sum: [f64; D], at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let i = at.particle;
        let (displacement, volume) = (self.displacement[i], self.volume[i]);
        let [modulus, share] = self.solid(i);
        let stiffness = modulus * share;
        let mut sum = Sum::new(sum);
        for (v, pair) in at.wall.pairs() {
            let points = &self.walls.points;
            let there = points.volume[v];
            let force = EspanolRevenga::default().force(volume, there, &displacement, &pair);
            let rubbing = points.share[v] * points.friction_factor[v];
            sum.force += force * (rubbing * self.scale * stiffness);
        }
        for contact in at.contacts {
            let friction_factor = self.walls.elements.friction_factor[contact.element as usize];
            let gradient = contact.gradient.norm();
            let stiffness = self.scale * stiffness * friction_factor;
            let distance = contact.distance.max(self.spacing);
            sum.force -= displacement * (2.0 * stiffness * gradient / distance);
            sum.normal += contact.gradient * (1.0 - friction_factor);
            sum.rubbing += gradient * friction_factor;
        }
        let factor = self.held[i] * volume / self.mass[i];
        rates.acceleration += sum.completed(at.inverse_renormalisation) * factor;
    }
}
