//! The force of a stress that particles carry, and the damping of motions that its velocity gradient does not see.

use nalgebra::SMatrix;
use sph_core::{Field, Symmetric, SymmetricTensor, Vect, fields, plugin};
use sph_neighbours::{
    Interaction, Lane, LanePair, Neighbourhood, Particles, Rates, WallSet, add_scaled,
    beyond_linear, dot, pair_sum, pair_term,
};

use crate::stress::{Blend, ElasticForce, ElasticForceEntry, LawInputs};

/// The divergence of the remembered stress, cut to the yield stress: nested first differences.
///
/// The force is that of [`StressDivergence`], or, with `adjoint = true` of the velocity gradient `renormalised`, that
/// of [`AdjointDivergence`](crate::stress::AdjointDivergence).
///
/// Source: Ghaïtanellis 2017, Eq. 4.92–4.93; Gray et al. 2001.
///
/// ```toml
/// [elastic-force.divergence]
/// blend = "stresses"
/// ```
#[plugin(ElasticForceEntry [2, 3], "divergence", "the divergence of the remembered stress",
    source: "Ghaïtanellis 2017, Eq. 4.92–4.93; Gray et al. 2001", cfg(not(test)))]
#[derive(Copy)]
pub struct Divergence {
    /// Blended quantities where a soil yields.
    #[parameter(default, source: "Ghaïtanellis 2017, Eq. 4.104 (forces), 4.84 and 4.105 (stresses)")]
    pub blend: Blend,
    /// Take the stress of the end of the step, so that elastic waves do not bound it: those that are faster than the
    /// step are damped. Needs an implicit viscosity with which it is solved for. A stiff soil that should fall may
    /// stand, and the run then fails at its end: take `sub_steps` for such.
    #[parameter(default, source: "ours")]
    pub implicit: bool,
    /// Take steps of its own within that of the flow, as long as elastic waves allow, while places, pressures and
    /// viscosities stay: for soils that are much stiffer than their water. With the integrator `symplectic-euler`.
    #[parameter(default, source: "ours, after Tuckerman et al. 1992, J. Chem. Phys. 97, 1990")]
    pub sub_steps: bool,
    /// Strength α of the damping of motions that the velocity gradient does not see: a viscosity α h √(𝒢ρ) of what
    /// neighbours move beyond it, times the solid fraction; 0.2 in soils, 0 in materials that do not yield, if left out.
    /// Without it solids beside walls rattle. Not with `implicit`, which damps them, nor with `sub_steps`.
    #[parameter(unit: "1", min: 0.0, max: 1.0, source: "ours, after Ganzenmüller 2015")]
    pub hourglass: Option<f64>,
}

/// Strength of the hourglass damping in materials that yield: kinetic energy beside walls falls to a hundredth or less.
const IN_SOILS: f64 = 0.2;

impl<const D: usize> ElasticForce<D> for Divergence {
    fn term(&self, _: &LawInputs) -> Box<dyn Interaction<D>> {
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
    fn hourglass(&self, yields: bool) -> f64 {
        if self.implicit || self.sub_steps {
            return 0.0;
        }
        let by_default = if yields { IN_SOILS } else { 0.0 };
        self.hourglass.unwrap_or(by_default)
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
        Box::new(StressDivergence { name, stress })
    }
}

/// [`StressDivergence`] with its columns.
#[pair_term(StressDivergence, self.name)]
pub struct BoundStressDivergence<'a, const D: usize> {
    #[both(self.stress)]
    stress: &'a [Symmetric],
    #[both(fields::VOLUME)]
    volume: &'a [f64],
    #[here(fields::MASS)]
    mass: &'a [f64],
    #[value(&world.walls)]
    walls: &'a WallSet<D>,
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
    #[inline(always)]
    pub(crate) fn new(force: [f64; D]) -> Self {
        Sum {
            force: force.into(),
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

#[pair_sum]
impl<const D: usize> BoundStressDivergence<'_, D> {
    /// τ V².
    fn weighted(&self, i: usize) -> [f64; 6] {
        (self.stress[i] * (self.volume[i] * self.volume[i])).0
    }

    fn own<L: Lane>(&self, all: Particles) -> [L; 6] {
        all.each(|i| self.weighted(i))
    }

    fn pair<L: Lane>(&self, own: &[L; 6], j: usize, pair: &LanePair<D, L>, sum: &mut [L; D]) {
        let other = self.weighted(j);
        for (force, places) in sum.iter_mut().zip(Symmetric::PLACE) {
            let mut row = [L::splat(0.0); D];
            for (entry, place) in row.iter_mut().zip(places) {
                *entry = own[place] + L::splat(other[place]);
            }
            *force += dot(&row, &pair.separation) * pair.factor;
        }
    }

    fn finish(&self, sum: [f64; D], at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let i = at.particle;
        let (stress, volume) = (self.stress[i], self.volume[i]);
        let mut sum = Sum::new(sum);
        for (v, pair) in at.wall.pairs() {
            let squares =
                volume * volume + self.walls.points.volume[v] * self.walls.points.volume[v];
            let weight = self.walls.points.share[v] * squares * pair.factor;
            let force = stress.apply(&pair.separation) * weight;
            let friction_factor = self.walls.points.friction_factor[v];
            sum.force += force * friction_factor;
            sum.slipping += force * (1.0 - friction_factor);
        }
        for contact in at.contacts {
            let s = contact.element as usize;
            let there = contact.volume;
            let squares = volume * volume + there * there;
            let force = stress.apply(&contact.gradient) * (squares / there);
            let friction_factor = self.walls.elements.friction_factor[s];
            sum.force -= force * friction_factor;
            sum.slipping -= force * (1.0 - friction_factor);
            sum.normal += contact.gradient * (1.0 - friction_factor);
            sum.rubbing += contact.gradient.norm() * friction_factor;
        }
        rates.acceleration += sum.completed(at.inverse_renormalisation) / self.mass[i];
    }
}

/// m_a a = 2 Σ_b θ_b μ_ab V_aV_b F_ab [u_ab − (G_a + G_b) r_ab/2] over neighbours that are elastic.
///
/// Symbols: G velocity gradient; F the kernel's gradient over the distance; μ = (1 − ζ) αρh√(𝒢/ρ), harmonic mean of
/// both, 1 − ζ the solid fraction. Motions of neighbours against each other have no gradient, so that no stress resists
/// them; walls, whose force is not the adjoint of the gradient, feed them. A velocity that is linear is not damped, one
/// of a wave with k in proportion to (kh)².
///
/// Ours, after Ganzenmüller 2015, Comput. Methods Appl. Mech. Eng. 286, 87.
#[derive(Clone, Debug)]
pub struct HourglassDamping {
    /// μ/h by phase number, Pa s/m; 0 where it is not elastic.
    pub strength: Vec<f64>,
}

/// [`HourglassDamping`] with its columns.
#[pair_term(HourglassDamping, "hourglass damping")]
pub struct BoundHourglassDamping<'a, const D: usize> {
    #[both(fields::VELOCITY)]
    velocity: &'a [Vect<D>],
    #[both(fields::VELOCITY_GRADIENT)]
    gradient: &'a [SMatrix<f64, D, D>],
    #[both(fields::VOLUME)]
    volume: &'a [f64],
    #[here(fields::MASS)]
    mass: &'a [f64],
    #[both(fields::SOLID_FRACTION)]
    solid: &'a [f64],
    #[where_there(fields::PHASE)]
    phase: Option<&'a [u32]>,
    #[value(&self.strength)]
    strength: &'a [f64],
    #[value(world.kernel.smoothing_length())]
    smoothing_length: f64,
}

/// u, G and μ of a particle.
#[derive(Clone, Copy)]
pub struct Motion<L: Lane, const D: usize> {
    velocity: [L; D],
    gradient: [[L; D]; D],
    viscosity: L,
}

#[pair_sum]
impl<const D: usize> BoundHourglassDamping<'_, D> {
    /// μ, Pa s.
    fn viscosity(&self, i: usize) -> f64 {
        let strength = self.strength[self.phase.map_or(0, |p| p[i] as usize)];
        self.smoothing_length * strength * self.solid[i]
    }

    fn own<L: Lane>(&self, all: Particles) -> Motion<L, D> {
        let [viscosity] = all.each(|i| [self.viscosity(i)]);
        Motion {
            velocity: all.vectors(self.velocity),
            gradient: all.matrices(self.gradient),
            viscosity,
        }
    }

    fn pair<L: Lane>(&self, own: &Motion<L, D>, j: usize, pair: &LanePair<D, L>, sum: &mut [L; D]) {
        let other = self.viscosity(j);
        if other == 0.0 {
            return;
        }
        let other = L::splat(other);
        // Twice the harmonic mean.
        let twice = own.viscosity * other * L::splat(4.0) / (own.viscosity + other);
        let weight = twice * L::splat(self.volume[j]) * pair.factor;
        let own = (&own.velocity, &own.gradient);
        let other = (&self.velocity[j], &self.gradient[j]);
        add_scaled(sum, &beyond_linear(own, other, &pair.separation), weight);
    }

    fn finish(&self, sum: [f64; D], at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let i = at.particle;
        rates.acceleration += Vect::from(sum) * (self.volume[i] / self.mass[i]);
    }
}
