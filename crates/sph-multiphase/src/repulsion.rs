//! Forces that push phases apart: a weight per pair of particles of different phases.

use sph_core::{Vect, fields};
use sph_neighbours::{
    BoundTerm, Interaction, Lane, LanePair, Neighbourhood, PairSum, Particles, Rates, add_scaled,
    pair_term, unlike,
};

/// The weight P_ab of m_a a = −ε Σ_{b of other phases} P_ab ∇w_ab.
pub trait Repulsion: Copy + Send + Sync + 'static {
    /// Name in plans.
    const NAME: &'static str;
    /// P_ab = P_ba ≥ 0 from pressures and volumes here and there, Pa m^2d.
    fn weight<L: Lane>(pressure: L, volume: L, there: L, there_volume: L) -> L;
}

/// The term of a weight with its ε.
#[derive(Clone, Copy, Debug)]
pub struct Repelling<R> {
    strength: f64,
    weight: std::marker::PhantomData<R>,
}

impl<R: Repulsion> Repelling<R> {
    /// As a term of a sweep.
    pub fn boxed<const D: usize>(strength: f64) -> Box<dyn Interaction<D>> {
        Box::new(Repelling::<R> {
            strength,
            weight: std::marker::PhantomData,
        })
    }
}

/// [`Repelling`] with its columns.
#[pair_term(Repelling<R>, R::NAME)]
pub struct BoundRepulsion<'a, R: Repulsion> {
    #[value(self)]
    term: &'a Repelling<R>,
    #[both(fields::PRESSURE)]
    pressure: &'a [f64],
    #[both(fields::VOLUME)]
    volume: &'a [f64],
    #[here(fields::MASS)]
    mass: &'a [f64],
    #[both(fields::PHASE)]
    phase: &'a [u32],
}

impl<const D: usize, R: Repulsion> PairSum<D> for BoundRepulsion<'_, R> {
    /// Pressure, volume, phase.
    type Own<L: Lane> = [L; 3];
    type Sum<L: Lane> = [L; D];

    #[inline(always)]
    fn own<L: Lane>(&self, all: Particles) -> [L; 3] {
        let (pressure, volume) = (all.numbers(self.pressure), all.numbers(self.volume));
        [pressure, volume, all.phases(Some(self.phase))]
    }

    #[inline(always)]
    fn pair<L: Lane>(
        &self,
        [pressure, volume, phase]: &[L; 3],
        j: usize,
        pair: &LanePair<D, L>,
        sum: &mut [L; D],
    ) {
        let unlike = unlike(*phase, self.phase[j]);
        let zero = L::splat(0.0);
        // Most pairs are of one phase.
        if !zero.any_less(unlike) {
            return;
        }
        let there = (L::splat(self.pressure[j]), L::splat(self.volume[j]));
        let weight = R::weight(*pressure, *volume, there.0, there.1) * pair.factor;
        add_scaled(sum, &pair.separation, unlike.where_positive(weight, zero));
    }
}

impl<const D: usize, R: Repulsion> BoundTerm<D> for BoundRepulsion<'_, R> {
    /// Without 1/γ: the gain of one particle is the loss of another.
    #[inline(always)]
    fn finish(&self, sum: [f64; D], at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let inverse_mass = 1.0 / self.mass[at.particle];
        rates.acceleration -= Vect::from(sum) * (self.term.strength * inverse_mass);
    }
}
