//! Change of density sums by shifts next to walls that scale the kernel.

use sph_core::{Vect, fields};
use sph_neighbours::{
    Lane, LanePair, Neighbourhood, Particles, Rates, dot, pair_sum, pair_term, splat,
};

/// dρ/dt −= m_a Σ_b s_a s_b [(s_a − s_b)·∇w_ab + w_ab (σ_a + σ_b)], b = a included, with σ = s·∇ln s of the shift velocity:
/// the change of ρ = K + m Σ s_a s_b w by a shift, which [`ShiftTransport`](crate::diffusion::ShiftTransport) takes back with γ where walls
/// do not scale the kernel. Within reach of a free surface no density is taken up. Ours.
#[derive(Clone, Copy, Debug)]
pub struct ShiftedSum;

/// [`ShiftedSum`] with its columns.
#[pair_term(ShiftedSum, "shifted density sum")]
pub struct BoundShiftedSum<'a, const D: usize> {
    #[both(fields::SHIFT_VELOCITY)]
    shift: &'a [Vect<D>],
    #[here(fields::VOID_FRACTION)]
    void_fraction: &'a [f64],
    #[here(fields::MASS)]
    mass: &'a [f64],
    #[where_there(fields::SCALE_SLOPE)]
    slope: Option<&'a [Vect<D>]>,
}

#[pair_sum]
impl<const D: usize> BoundShiftedSum<'_, D> {
    const SCALED: bool = true;

    /// Shift velocity and its part along ∇ ln s.
    fn own<L: Lane>(&self, all: Particles) -> ([L; D], L) {
        let [along] = all.each(|i| [self.scale_rate(i)]);
        (all.vectors(self.shift), along)
    }

    fn pair<L: Lane>(&self, own: &Self::Own<L>, j: usize, pair: &LanePair<D, L>, sum: &mut L) {
        let other = dot(&splat(&self.shift[j]), &pair.separation);
        *sum += (dot(&own.0, &pair.separation) - other) * pair.factor;
    }

    fn pair_at_walls<L: Lane>(
        &self,
        own: &Self::Own<L>,
        j: usize,
        pair: &LanePair<D, L>,
        sum: &mut L,
    ) {
        *sum += pair.value * (own.1 + L::splat(self.scale_rate(j)));
    }

    fn finish(&self, mut sum: f64, at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let i = at.particle;
        if self.void_fraction[i] == 0.0 {
            return;
        }
        if let Some(scale) = at.scale() {
            sum += 2.0 * scale.own_value * self.scale_rate(i);
        }
        rates.scalar -= self.mass[i] * sum;
    }

    /// s·∇ln s of a particle, 1/s.
    fn scale_rate(&self, i: usize) -> f64 {
        self.slope.map_or(0.0, |g| g[i].dot(&self.shift[i]))
    }
}
