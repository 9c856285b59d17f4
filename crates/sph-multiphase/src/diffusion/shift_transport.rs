//! Transport of quantities with shifted particles.

use sph_core::{Vect, fields};
use sph_neighbours::{
    Lane, LanePair, Neighbourhood, Particles, Rates, WallSet, add_scaled, dot, pair_sum, pair_term,
    splat, unlike,
};

/// du/dt += (s·∇)u and dρ/dt += s·∇ρ with the shift velocity s, the gradients from differences:
/// s·∇f = 1/γ_a [Σ_b θ_b V_b (f_b − f_a) s_a·∇w_ab − Σ_s (f_s − f_a) s_a·∇γ_as].
///
/// From neighbours of the same phase, u also from walls that rub: a heavy particle that took up the velocity of light
/// ones would take momentum from nowhere. Where the density is a sum over positions (ρ = (K + mΣθw)/γ), the move
/// changes the sum by 1/γ_a [m_a Σ_b θ_b (s_a − s_b)·∇w_ab − ρ_a s_a·Σ_s ∇γ_as], which is taken back.
///
/// A density that takes no notice of shifts counts what brings particles together and not the shifts that
/// part them again: it drifts, up to 5000 ρU² in a channel. It is therefore led back to that of the arrangement as
/// fast as this is rearranged, dρ/dt += −α ρ_a (1 − C_a) 1/γ_a Σ_b V_b |u_ab·r_ab| |F_ab|, which is 0 at rest
/// and in a rigid rotation. C is the concentration ΣθVw/γ. Within reach of a free surface, where C
/// says nothing, and of wall points, which rearrange what passes, no density is taken up.
///
/// Source: Sun et al. 2019, with differences instead of products; the sum and the way back are ours.
#[derive(Clone, Copy, Debug)]
pub struct ShiftTransport {
    /// True if the velocity is taken up, besides the density.
    pub velocity: bool,
    /// α.
    pub relaxation: f64,
    /// True if the density is a sum over positions.
    pub summed: bool,
}

/// [`ShiftTransport`] with its columns.
#[pair_term(ShiftTransport, "transport by shifting")]
pub struct BoundShiftTransport<'a, const D: usize> {
    #[value(*self)]
    which: ShiftTransport,
    #[both(fields::SHIFT_VELOCITY)]
    shift: &'a [Vect<D>],
    #[both(fields::VELOCITY)]
    velocity: &'a [Vect<D>],
    #[both(fields::DENSITY)]
    density: &'a [f64],
    #[here(fields::VOID_FRACTION)]
    void_fraction: &'a [f64],
    #[neighbours(fields::VOLUME)]
    volume: &'a [f64],
    #[here(fields::MASS)]
    mass: &'a [f64],
    #[where_there(fields::PHASE)]
    phase: Option<&'a [u32]>,
    #[value(&world.walls)]
    walls: &'a WallSet<D>,
}

/// The own values of a particle.
#[derive(Clone, Copy)]
pub struct Own<const D: usize, L> {
    shift: [L; D],
    velocity: [L; D],
    density: L,
    /// m where the density is a sum, 0 otherwise.
    summed: L,
    phase: L,
}

#[pair_sum]
impl<const D: usize> BoundShiftTransport<'_, D> {
    fn own<L: Lane>(&self, all: Particles) -> Own<D, L> {
        Own {
            shift: all.vectors(self.shift),
            velocity: all.vectors(self.velocity),
            density: all.numbers(self.density),
            summed: match self.which.summed {
                true => all.numbers(self.mass),
                false => L::splat(0.0),
            },
            phase: all.phases(self.phase),
        }
    }

    /// (s·∇)u, dρ/dt and ΣV|u·r||F|.
    fn pair<L: Lane>(
        &self,
        own: &Own<D, L>,
        j: usize,
        pair: &LanePair<D, L>,
        sums: &mut ([L; D], L, L),
    ) {
        let volume = L::splat(self.volume[j]);
        let along = dot(&own.shift, &pair.separation);
        let mut weight = volume * along * pair.factor;
        let mut relative = own.velocity;
        for (relative, other) in relative.iter_mut().zip(self.velocity[j].iter()) {
            *relative = L::splat(*other) - *relative;
        }
        sums.2 += volume * dot(&relative, &pair.separation).abs() * pair.factor.abs();
        if let Some(phase) = self.phase {
            weight = unlike(own.phase, phase[j]).where_positive(L::splat(0.0), weight);
        }
        add_scaled(&mut sums.0, &relative, weight);
        sums.1 += (L::splat(self.density[j]) - own.density) * weight;
        let nearer = along - dot(&splat(&self.shift[j]), &pair.separation);
        sums.1 -= own.summed * nearer * pair.factor;
    }

    fn finish(&self, sums: ([f64; D], f64, f64), at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let i = at.particle;
        let void_fraction = self.void_fraction[i];
        if void_fraction == 0.0 {
            return;
        }
        let (mut taken_up, mut rate, rearranged) = (Vect::from(sums.0), sums.1, sums.2);
        let (shift, velocity, density) = (self.shift[i], self.velocity[i], self.density[i]);
        let summed = if self.which.summed { self.mass[i] } else { 0.0 };
        for (v, pair) in at.wall.pairs() {
            let along = shift.dot(&pair.separation) * self.walls.points.share[v] * pair.factor;
            let apart = self.walls.points.velocity[v] - velocity;
            taken_up += apart
                * (self.walls.points.volume[v] * self.walls.points.friction_factor[v] * along);
            rate -= summed * along;
        }
        for contact in at.contacts {
            let s = contact.element as usize;
            let along = shift.dot(&contact.gradient);
            taken_up -= (self.walls.elements.velocity_at(&contact) - velocity)
                * (self.walls.elements.friction_factor[s] * along);
            if self.which.summed {
                rate += density * along;
            }
        }
        if self.which.velocity {
            rates.acceleration += taken_up * at.inverse_renormalisation;
        }
        let back = self.which.relaxation * density * void_fraction * rearranged;
        rates.scalar += (rate - back) * at.inverse_renormalisation;
    }
}

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
