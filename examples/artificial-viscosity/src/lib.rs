//! A pair force from outside, in lanes: `[term.artificial-viscosity]`.

use sph_neighbours::prelude::*;

/// a = α c h Σ_b m_b µ_ab/ρ̄ ∇w_ab where particles approach, µ_ab = u_ab·r_ab/(r² + h²/100); nothing at walls.
#[plugin(TermEntry [2, 3], "artificial-viscosity", "friction of particles that approach each other",
    source: "Monaghan 1992, Eq. 4.1 with β = 0")]
pub struct ArtificialViscosity {
    /// α c, a share of the speed of sound.
    #[parameter(unit: "m/s", min: 0.0)]
    pub speed: f64,
}

/// The term with its columns.
#[pair_term(ArtificialViscosity, "artificial viscosity")]
pub struct Bound<'a, const D: usize> {
    #[both(fields::VELOCITY)]
    velocity: &'a [Vect<D>],
    #[both(fields::DENSITY)]
    density: &'a [f64],
    #[neighbours(fields::VOLUME)]
    volume: &'a [f64],
    #[value(2.0 * self.speed * world.kernel.smoothing_length())]
    strength: f64,
    #[value(0.01 * world.kernel.smoothing_length().powi(2))]
    softening: f64,
}

#[pair_sum]
impl<const D: usize> Bound<'_, D> {
    fn own<L: Lane>(&self, all: Particles) -> ([L; D], L) {
        (all.vectors(self.velocity), all.numbers(self.density))
    }
    fn pair<L: Lane>(&self, own: &Self::Own<L>, j: usize, pair: &LanePair<D, L>, sum: &mut [L; D]) {
        let parting = dot(&minus(&own.0, &self.velocity[j]), &pair.separation);
        let approach = (-parting).where_positive(parting, L::splat(0.0));
        let rate = approach / (pair.distance2 + L::splat(self.softening));
        let mass = L::splat(self.strength * self.density[j] * self.volume[j]);
        let weight = mass / (own.1 + L::splat(self.density[j]));
        add_scaled(sum, &pair.separation, weight * rate * pair.factor);
    }
    fn finish(&self, sum: [f64; D], _: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        rates.acceleration += Vect::from(sum);
    }
}
