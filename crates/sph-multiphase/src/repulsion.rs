//! Forces that push phases apart: a weight per pair of particles of different phases.

use sph_core::{Access, StepError, Vect, fields};
use sph_neighbours::{
    BoundTerm, Interaction, Lane, LanePair, LanePairTerm, LaneTerm, Lanewise, Pair, Rates, There,
    World, add_scaled, splat, unlike, vector,
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
        Box::new(Lanewise(Repelling::<R> {
            strength,
            weight: std::marker::PhantomData,
        }))
    }
}

impl<const D: usize, R: Repulsion> LanePairTerm<D> for Repelling<R> {
    type Bound<'a> = Bound<'a, R>;

    fn name(&self) -> String {
        R::NAME.into()
    }

    fn access(&self) -> Access {
        Access::none()
            .both(fields::PRESSURE)
            .both(fields::VOLUME)
            .both(fields::PHASE)
            .here(fields::MASS)
    }

    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Bound<'a, R>, StepError> {
        Ok(Bound {
            term: self,
            pressure: world.free.get(fields::PRESSURE)?,
            volume: world.free.get(fields::VOLUME)?,
            mass: world.free.get(fields::MASS)?,
            phase: world.free.get(fields::PHASE)?,
        })
    }
}

/// [`Repelling`] with its columns.
pub struct Bound<'a, R> {
    term: &'a Repelling<R>,
    pressure: &'a [f64],
    volume: &'a [f64],
    mass: &'a [f64],
    phase: &'a [u32],
}

/// What is read once per particle.
#[derive(Clone, Copy)]
pub struct Own {
    pressure: f64,
    volume: f64,
    inverse_mass: f64,
    phase: u32,
}

impl<const D: usize, R: Repulsion> BoundTerm<D> for Bound<'_, R> {
    type Here = Own;
    type Sum = Vect<D>;

    #[inline(always)]
    fn here(&self, i: usize) -> Own {
        Own {
            pressure: self.pressure[i],
            volume: self.volume[i],
            inverse_mass: 1.0 / self.mass[i],
            phase: self.phase[i],
        }
    }

    #[inline(always)]
    fn zero(&self) -> Vect<D> {
        Vect::zeros()
    }

    #[inline(always)]
    fn free(&self, own: &Own, j: usize, there: &There<D>, pair: &Pair<D>, sum: &mut Vect<D>) {
        self.add_one(own, j, there, pair, sum);
    }

    /// Without 1/γ: what one particle gets, another loses.
    #[inline(always)]
    fn finish(&self, own: &Own, sum: &Vect<D>, _inverse_gamma: f64, rates: &mut Rates<D>) {
        rates.acceleration -= sum * (self.term.strength * own.inverse_mass);
    }
}

/// [`Own`] of several particles; phases are small whole numbers, exact as any.
#[derive(Clone, Copy)]
pub struct Side<L> {
    pressure: L,
    volume: L,
    phase: L,
}

impl<const D: usize, R: Repulsion> LaneTerm<D> for Bound<'_, R> {
    type Side<L: Lane> = Side<L>;
    type Sums<L: Lane> = [L; D];

    #[inline(always)]
    fn side<L: Lane>(&self, here: &[Own]) -> Side<L> {
        let zero = L::splat(0.0);
        let mut side = Side {
            pressure: zero,
            volume: zero,
            phase: zero,
        };
        for (lane, own) in here.iter().enumerate() {
            side.pressure.set(lane, own.pressure);
            side.volume.set(lane, own.volume);
            side.phase.set(lane, f64::from(own.phase));
        }
        side
    }

    #[inline(always)]
    fn sums<L: Lane>(&self, sum: &Vect<D>) -> [L; D] {
        splat(sum)
    }

    #[inline(always)]
    fn lane<L: Lane>(&self, sums: &[L; D], lane: usize) -> Vect<D> {
        vector(sums, lane)
    }

    #[inline(always)]
    fn add<L: Lane>(
        &self,
        own: &Side<L>,
        j: usize,
        there: &There<D>,
        pair: &LanePair<D, L>,
        sums: &mut [L; D],
    ) {
        let unlike = unlike(own.phase, self.phase[j]);
        let zero = L::splat(0.0);
        // Most pairs are of one phase.
        if !zero.any_less(unlike) {
            return;
        }
        let [pressure, volume] = [L::splat(there.pressure), L::splat(there.volume)];
        let weight = R::weight(own.pressure, own.volume, pressure, volume) * pair.factor;
        add_scaled(sums, &pair.separation, unlike.where_positive(weight, zero));
    }
}
