//! A pair force from outside, in lanes: `[term.artificial-viscosity]`.

use sph_core::{Access, StepError, Vect, fields, plugin};
use sph_neighbours::{
    BoundTerm, Lane, LanePair, LanePairTerm, LaneTerm, Lanewise, Pair, Rates, TermEntry, There,
    World, add_scaled, dot, minus, set, splat, vector,
};

/// a = α c h Σ_b m_b µ_ab/ρ̄ ∇w_ab where particles approach, µ_ab = u_ab·r_ab/(r² + h²/100); nothing at walls.
#[plugin(TermEntry [2, 3], "artificial-viscosity", "friction of particles that approach each other",
    source: "Monaghan 1992, Eq. 4.1 with β = 0", within: Lanewise)]
pub struct ArtificialViscosity {
    /// α c, a share of the speed of sound.
    #[parameter(unit: "m/s", min: 0.0)]
    pub speed: f64,
}

/// The term with its columns.
pub struct Bound<'a, const D: usize> {
    velocity: &'a [Vect<D>],
    density: &'a [f64],
    strength: f64,
    softening: f64,
}

impl<const D: usize> LanePairTerm<D> for ArtificialViscosity {
    type Bound<'a> = Bound<'a, D>;
    fn name(&self) -> String {
        "artificial viscosity".into()
    }
    fn access(&self) -> Access {
        let access = Access::none().both(fields::VELOCITY).both(fields::DENSITY);
        access.neighbours(fields::VOLUME)
    }
    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Bound<'a, D>, StepError> {
        let h = world.kernel.smoothing_length();
        Ok(Bound {
            velocity: world.free.get(fields::VELOCITY)?,
            density: world.free.get(fields::DENSITY)?,
            strength: 2.0 * self.speed * h,
            softening: 0.01 * h * h,
        })
    }
}

impl<const D: usize> LaneTerm<D> for Bound<'_, D> {
    type Side<L: Lane> = ([L; D], L);
    type Sums<L: Lane> = [L; D];

    #[inline(always)]
    fn side<L: Lane>(&self, here: &[(Vect<D>, f64)]) -> Self::Side<L> {
        let (mut velocity, mut density) = ([L::splat(0.0); D], L::splat(0.0));
        for (lane, own) in here.iter().enumerate() {
            set(&mut velocity, lane, &own.0);
            density.set(lane, own.1);
        }
        (velocity, density)
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
        here: &Self::Side<L>,
        _neighbour: usize,
        there: &There<D>,
        pair: &LanePair<D, L>,
        sums: &mut [L; D],
    ) {
        let parting = dot(&minus(&here.0, &there.velocity), &pair.separation);
        let zero = L::splat(0.0);
        let approach = (-parting).where_positive(parting, zero);
        let rate = approach / (pair.distance2 + L::splat(self.softening));
        let mass = L::splat(self.strength * there.density * there.volume);
        let weight = mass / (here.1 + L::splat(there.density));
        add_scaled(sums, &pair.separation, weight * rate * pair.factor);
    }
}

impl<const D: usize> BoundTerm<D> for Bound<'_, D> {
    /// Velocity and density.
    type Here = (Vect<D>, f64);
    type Sum = Vect<D>;
    #[inline(always)]
    fn here(&self, i: usize) -> Self::Here {
        (self.velocity[i], self.density[i])
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
        self.add_one(here, j, there, pair, sum);
    }
    #[inline(always)]
    fn finish(&self, _: &Self::Here, sum: &Vect<D>, _: f64, rates: &mut Rates<D>) {
        rates.acceleration += sum;
    }
}
