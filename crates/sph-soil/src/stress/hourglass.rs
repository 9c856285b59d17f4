//! Damping of motions of an elastic material that its velocity gradient does not see.

use nalgebra::SMatrix;
use sph_core::{Vect, fields};
use sph_neighbours::{
    BoundTerm, Lane, LanePair, Neighbourhood, PairSum, Particles, Rates, dot, pair_term,
};

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

impl<const D: usize> BoundHourglassDamping<'_, D> {
    /// μ, Pa s.
    #[inline(always)]
    fn viscosity(&self, i: usize) -> f64 {
        let strength = self.strength[self.phase.map_or(0, |p| p[i] as usize)];
        self.smoothing_length * strength * self.solid[i]
    }
}

/// u, G and μ of a particle.
#[derive(Clone, Copy)]
pub struct Motion<L: Lane, const D: usize> {
    velocity: [L; D],
    gradient: [[L; D]; D],
    viscosity: L,
}

impl<const D: usize> PairSum<D> for BoundHourglassDamping<'_, D> {
    type Own<L: Lane> = Motion<L, D>;
    type Sum<L: Lane> = [L; D];

    #[inline(always)]
    fn own<L: Lane>(&self, all: Particles) -> Motion<L, D> {
        let mut gradient = [[L::splat(0.0); D]; D];
        for (k, row) in gradient.iter_mut().enumerate() {
            *row = all.each(|i| self.gradient[i].row(k).transpose().data.0[0]);
        }
        let [viscosity] = all.each(|i| [self.viscosity(i)]);
        Motion {
            velocity: all.vectors(self.velocity),
            gradient,
            viscosity,
        }
    }

    #[inline(always)]
    fn pair<L: Lane>(&self, own: &Motion<L, D>, j: usize, pair: &LanePair<D, L>, sum: &mut [L; D]) {
        let other = self.viscosity(j);
        if other == 0.0 {
            return;
        }
        let other = L::splat(other);
        // Twice the harmonic mean.
        let twice = own.viscosity * other * L::splat(4.0) / (own.viscosity + other);
        let weight = twice * L::splat(self.volume[j]) * pair.factor;
        for (k, sum) in sum.iter_mut().enumerate() {
            let mut row = own.gradient[k];
            for (l, entry) in row.iter_mut().enumerate() {
                *entry = (*entry + L::splat(self.gradient[j][(k, l)])) * L::splat(0.5);
            }
            let linear = dot(&row, &pair.separation);
            *sum += (own.velocity[k] - L::splat(self.velocity[j][k]) - linear) * weight;
        }
    }
}

impl<const D: usize> BoundTerm<D> for BoundHourglassDamping<'_, D> {
    #[inline(always)]
    fn finish(&self, sum: [f64; D], at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let i = at.particle;
        rates.acceleration += Vect::from(sum) * (self.volume[i] / self.mass[i]);
    }
}
