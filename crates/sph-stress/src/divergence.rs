//! The force of a stress that particles carry.

use sph_core::{Access, Field, StepError, Symmetric, SymmetricTensor, Vect, fields, plugin};
use sph_neighbours::{
    BoundTerm, Contact, Elements, Interaction, Lane, LanePair, LanePairTerm, LaneTerm, Lanewise,
    Pair, Rates, There, World, dot, splat, vector,
};

use crate::{Blend, ElasticForce, ElasticForceEntry, Felt};

/// The divergence of the remembered stress, cut to the yield stress: nested first differences.
///
/// The force is that of [`StressDivergence`], or, with `adjoint = true` of the velocity gradient `renormalised`, that of
/// [`AdjointDivergence`](crate::AdjointDivergence).
///
/// Source: Ghaïtanellis 2017, Eq. 4.92–4.93; Gray et al. 2001.
///
/// ```toml
/// [elastic-force.divergence]
/// blend = "stresses"
/// ```
#[plugin(ElasticForceEntry [2, 3], "divergence", "the divergence of the remembered stress",
    source: "Ghaïtanellis 2017, Eq. 4.92–4.93; Gray et al. 2001")]
#[derive(Copy)]
pub struct Divergence {
    /// What is blended where a soil yields.
    #[parameter(default, source: "Ghaïtanellis 2017, Eq. 4.104 (forces), 4.84 and 4.105 (stresses)")]
    pub blend: Blend,
    /// Take the stress of the end of the step, so that elastic waves do not bound it: those that are faster than the step
    /// are damped. Needs an implicit viscosity with which it is solved for. A stiff soil that should fall may stand, and the run then fails at its end: take `sub_steps` for such.
    #[parameter(default, source: "ours")]
    pub implicit: bool,
    /// Take steps of its own within that of the flow, as long as elastic waves allow, while places, pressures and
    /// viscosities stay: for soils that are much stiffer than their water. With the integrator `symplectic-euler`.
    #[parameter(default, source: "ours, after Tuckerman et al. 1992, J. Chem. Phys. 97, 1990")]
    pub sub_steps: bool,
}

impl<const D: usize> ElasticForce<D> for Divergence {
    fn term(&self, _: &Felt) -> Box<dyn Interaction<D>> {
        StressDivergence::boxed()
    }
    fn blend(&self) -> Blend {
        self.blend
    }
    fn implicit(&self) -> bool {
        self.implicit
    }
    fn sub_steps(&self) -> bool {
        self.sub_steps
    }
}

/// m_a a = 1/γ_a [Σ_b θ_b (V_a²τ_a + V_b²τ_b)·∇w_ab − Σ_s (V_a²τ_a + V_s²τ_s)/V_s·∇γ_as].
///
/// The counterpart of the pressure gradient of Hu and Adams: linear momentum is conserved, and the
/// work of the stress is that of the strain. A wall carries the stress of the particle that touches
/// it; one that does not rub carries what is normal to it, and along it sums are not divided by γ: what layers
/// do to each other would else leave a force on the whole.
///
/// Ours, after Ghaïtanellis 2017, Eq. 3.25; Gray et al. 2001.
#[derive(Clone, Copy, Debug)]
pub struct StressDivergence {
    /// Name in plans.
    pub name: &'static str,
    /// The column of the stress τ, Pa, positive in tension.
    pub stress: Field<SymmetricTensor>,
}

impl StressDivergence {
    /// That of the stress of elastic materials, as a term of a sweep.
    pub fn boxed<const D: usize>() -> Box<dyn Interaction<D>> {
        let stress = fields::CARRIED_STRESS;
        let name = "stress divergence";
        Box::new(Lanewise(StressDivergence { name, stress }))
    }
}

impl<const D: usize> LanePairTerm<D> for StressDivergence {
    type Bound<'a> = Bound<'a, D>;

    fn name(&self) -> String {
        self.name.into()
    }

    fn access(&self) -> Access {
        Access::none()
            .both(self.stress)
            .both(fields::VOLUME)
            .here(fields::MASS)
    }

    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Bound<'a, D>, StepError> {
        let points = &world.walls.points;
        Ok(Bound {
            stress: world.free.get(self.stress)?,
            volume: world.free.get(fields::VOLUME)?,
            mass: world.free.get(fields::MASS)?,
            wall_volume: &points.volume,
            wall_share: &points.share,
            wall_grip: &points.grip,
            elements: &world.walls.elements,
        })
    }
}

/// [`StressDivergence`] with its columns.
pub struct Bound<'a, const D: usize> {
    stress: &'a [Symmetric],
    volume: &'a [f64],
    mass: &'a [f64],
    wall_volume: &'a [f64],
    wall_share: &'a [f64],
    wall_grip: &'a [f64],
    elements: &'a Elements<D>,
}

/// The particle's own values.
#[derive(Clone, Copy)]
pub struct Here {
    stress: Symmetric,
    volume: f64,
    mass: f64,
}

/// Sums of one particle.
#[derive(Clone, Copy)]
pub struct Sum<const D: usize> {
    /// Force of particles and of walls that rub.
    pub(crate) force: Vect<D>,
    /// Force of walls that slip.
    slipping: Vect<D>,
    /// Σ ∇γ_as of walls that slip.
    pub(crate) normal: Vect<D>,
    /// Σ |∇γ_as| of walls that rub.
    pub(crate) rubbing: f64,
}

impl<const D: usize> Sum<D> {
    pub(crate) fn zero() -> Self {
        Sum {
            force: Vect::zeros(),
            slipping: Vect::zeros(),
            normal: Vect::zeros(),
            rubbing: 0.0,
        }
    }

    /// The sums over γ, but for what is along walls that slip.
    #[inline(always)]
    pub(crate) fn completed(&self, inverse_gamma: f64) -> Vect<D> {
        let slipping = self.normal.norm();
        if slipping <= 0.0 {
            return self.force * inverse_gamma;
        }
        let normal = self.normal / slipping;
        let across = normal * self.force.dot(&normal);
        // Along a wall without traction nothing completes the sum, as at a free surface.
        let share = self.rubbing / (self.rubbing + slipping);
        let along = 1.0 + (inverse_gamma - 1.0) * share;
        let of_wall = normal * self.slipping.dot(&normal);
        (across + of_wall) * inverse_gamma + (self.force - across) * along
    }
}

impl<const D: usize> BoundTerm<D> for Bound<'_, D> {
    type Here = Here;
    type Sum = Sum<D>;

    #[inline(always)]
    fn here(&self, i: usize) -> Here {
        let volume = self.volume[i];
        Here {
            stress: self.stress[i],
            volume,
            mass: self.mass[i],
        }
    }

    #[inline(always)]
    fn zero(&self) -> Sum<D> {
        Sum::zero()
    }

    #[inline(always)]
    fn free(&self, here: &Here, j: usize, there: &There<D>, pair: &Pair<D>, sum: &mut Sum<D>) {
        self.add_one(here, j, there, pair, sum);
    }

    #[inline(always)]
    fn wall(&self, here: &Here, v: usize, pair: &Pair<D>, sum: &mut Sum<D>) {
        let squares = here.volume * here.volume + self.wall_volume[v] * self.wall_volume[v];
        let weight = self.wall_share[v] * squares * pair.factor;
        let force = here.stress.apply(&pair.separation) * weight;
        let grip = self.wall_grip[v];
        sum.force += force * grip;
        sum.slipping += force * (1.0 - grip);
    }

    #[inline(always)]
    fn element(&self, here: &Here, contact: &Contact<D>, sum: &mut Sum<D>) {
        let s = contact.element as usize;
        let there = self.elements.volume[s];
        let squares = here.volume * here.volume + there * there;
        let force = here.stress.apply(&contact.gradient) * (squares / there);
        let grip = self.elements.grip[s];
        sum.force -= force * grip;
        sum.slipping -= force * (1.0 - grip);
        sum.normal += contact.gradient * (1.0 - grip);
        sum.rubbing += contact.gradient.norm() * grip;
    }

    #[inline(always)]
    fn finish(&self, here: &Here, sum: &Sum<D>, inverse_gamma: f64, rates: &mut Rates<D>) {
        rates.acceleration += sum.completed(inverse_gamma) / here.mass;
    }
}

/// Where the components of a symmetric tensor stand.
const PLACE: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];

impl<const D: usize> LaneTerm<D> for Bound<'_, D> {
    /// τ V².
    type Side<L: Lane> = [L; 6];
    /// Forces, and what they started from.
    type Sums<L: Lane> = ([L; D], Sum<D>);

    #[inline(always)]
    fn side<L: Lane>(&self, here: &[Here]) -> [L; 6] {
        let mut side = [L::splat(0.0); 6];
        for (lane, own) in here.iter().enumerate() {
            let weighted = own.stress * (own.volume * own.volume);
            for (c, side) in side.iter_mut().enumerate() {
                side.set(lane, weighted.0[c]);
            }
        }
        side
    }

    #[inline(always)]
    fn sums<L: Lane>(&self, sum: &Sum<D>) -> Self::Sums<L> {
        (splat(&sum.force), *sum)
    }

    #[inline(always)]
    fn lane<L: Lane>(&self, sums: &Self::Sums<L>, lane: usize) -> Sum<D> {
        Sum {
            force: vector(&sums.0, lane),
            ..sums.1
        }
    }

    #[inline(always)]
    fn add<L: Lane>(
        &self,
        here: &[L; 6],
        j: usize,
        there: &There<D>,
        pair: &LanePair<D, L>,
        sums: &mut Self::Sums<L>,
    ) {
        let other = self.stress[j] * (there.volume * there.volume);
        for (force, places) in sums.0.iter_mut().zip(PLACE) {
            let mut row = [L::splat(0.0); D];
            for (entry, place) in row.iter_mut().zip(places) {
                *entry = here[place] + L::splat(other.0[place]);
            }
            *force += dot(&row, &pair.separation) * pair.factor;
        }
    }
}
