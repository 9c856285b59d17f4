//! The force of a stress that particles carry.

use sph_core::{Access, StepError, Symmetric, Vect, fields};
use sph_neighbours::{
    BoundTerm, Contact, Elements, Interaction, Pair, PairTerm, Rates, Term, There, World,
};

/// m_a a = 1/γ_a [Σ_b θ_b (V_a²τ_a + V_b²τ_b)·∇w_ab − Σ_s (V_a²τ_a + V_s²τ_s)/V_s·∇γ_as].
///
/// The counterpart of the pressure gradient of Hu and Adams: linear momentum is conserved, and the
/// work of the stress is that of the strain. A wall carries the stress of the particle that touches
/// it; one that does not rub carries what is normal to it, and along it sums are not divided by γ: what layers
/// do to each other would else leave a force on the whole.
///
/// Ours, after Ghaïtanellis 2017, Eq. 3.25; Gray et al. 2001.
#[derive(Clone, Copy, Debug)]
pub struct StressDivergence;

impl StressDivergence {
    /// As a term of a sweep.
    pub fn boxed<const D: usize>() -> Box<dyn Interaction<D>> {
        Box::new(Term(StressDivergence))
    }
}

impl<const D: usize> PairTerm<D> for StressDivergence {
    type Bound<'a> = Bound<'a, D>;

    fn name(&self) -> String {
        "stress divergence".into()
    }

    fn access(&self) -> Access {
        Access::none()
            .both(fields::CARRIED_STRESS)
            .both(fields::VOLUME)
            .here(fields::MASS)
    }

    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Bound<'a, D>, StepError> {
        let points = &world.walls.points;
        Ok(Bound {
            stress: world.free.get(fields::CARRIED_STRESS)?,
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
    force: Vect<D>,
    /// Force of walls that slip.
    slipping: Vect<D>,
    /// Σ ∇γ_as of walls that slip.
    normal: Vect<D>,
    /// Σ |∇γ_as| of walls that rub.
    rubbing: f64,
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
        Sum {
            force: Vect::zeros(),
            slipping: Vect::zeros(),
            normal: Vect::zeros(),
            rubbing: 0.0,
        }
    }

    #[inline(always)]
    fn free(&self, here: &Here, j: usize, there: &There<D>, pair: &Pair<D>, sum: &mut Sum<D>) {
        let both = here.stress * (here.volume * here.volume)
            + self.stress[j] * (there.volume * there.volume);
        sum.force += both.apply(&pair.separation) * pair.factor;
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
        let mut force = sum.force * inverse_gamma;
        let slipping = sum.normal.norm();
        if slipping > 0.0 {
            let normal = sum.normal / slipping;
            let across = normal * sum.force.dot(&normal);
            // Along a wall without traction nothing completes the sum, as at a free surface.
            let share = sum.rubbing / (sum.rubbing + slipping);
            let along = 1.0 + (inverse_gamma - 1.0) * share;
            let of_wall = normal * sum.slipping.dot(&normal);
            force = (across + of_wall) * inverse_gamma + (sum.force - across) * along;
        }
        rates.acceleration += force / here.mass;
    }
}
